//! What is taken of each element.

use glam::{Vec2, Vec3};
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};
use std::vec::Vec;

/// The properties of a vertex that are used.
#[derive(Debug, Default)]
pub(super) struct Vertex {
    pub(super) position: Vec3,
    pub(super) normal: Vec3,
    pub(super) uv: Vec2,
}

impl Vertex {
    fn set(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        let place = match name {
            "x" => &mut self.position.x,
            "y" => &mut self.position.y,
            "z" => &mut self.position.z,
            "nx" => &mut self.normal.x,
            "ny" => &mut self.normal.y,
            "nz" => &mut self.normal.z,
            "u" | "s" => &mut self.uv.x,
            "v" | "t" => &mut self.uv.y,
            _ => return PropertyAccessResult::Ignored,
        };
        *place = value;
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        match property.to_f32_lossy() {
            Some(value) => self.set(name, value),
            None => PropertyAccessResult::Ignored,
        }
    }

    fn set_float(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        self.set(name, value)
    }
}

/// The list of a face's corners, as it is stored.
#[derive(Debug)]
pub(super) struct Face {
    corners: Property,
}

impl Face {
    pub(super) fn len(&self) -> usize {
        match &self.corners {
            Property::ListChar(v) => v.len(),
            Property::ListUChar(v) => v.len(),
            Property::ListShort(v) => v.len(),
            Property::ListUShort(v) => v.len(),
            Property::ListInt(v) => v.len(),
            Property::ListUInt(v) => v.len(),
            _ => 0,
        }
    }

    /// A corner's index; −1 when there is none.
    pub(super) fn corner(&self, k: usize) -> i64 {
        let index = match &self.corners {
            Property::ListChar(v) => v.get(k).map(|i| i64::from(*i)),
            Property::ListUChar(v) => v.get(k).map(|i| i64::from(*i)),
            Property::ListShort(v) => v.get(k).map(|i| i64::from(*i)),
            Property::ListUShort(v) => v.get(k).map(|i| i64::from(*i)),
            Property::ListInt(v) => v.get(k).map(|i| i64::from(*i)),
            Property::ListUInt(v) => v.get(k).map(|i| i64::from(*i)),
            _ => None,
        };
        index.unwrap_or(-1)
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self { corners: Property::ListInt(Vec::new()) }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !matches!(name, "vertex_indices" | "vertex_index") {
            return PropertyAccessResult::Ignored;
        }
        self.corners = property;
        PropertyAccessResult::Set
    }
}

/// An element that is read only to get past it.
#[derive(Debug)]
pub(super) struct Ignored;

impl PropertyAccess for Ignored {
    fn new() -> Self {
        Self
    }
}
