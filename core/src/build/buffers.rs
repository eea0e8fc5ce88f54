//! The tables of a scene, owned.

use super::primitives::{Primitive, list};
use super::{BuildError, Description, build_tree};
use crate::bsdf::{AnyBsdf, TwoSided};
use crate::bvh::{Bvh, Node};
use crate::choose::PowerTable;
use crate::geom::Aabb;
use crate::light::{AnyLight, Emitter};
use crate::scene::{AnyScene, CornerNormals, NONE, Scene, Surface};
use crate::shape::{AnyShape, Shape};
use core::mem::size_of_val;
use std::vec;
use std::vec::Vec;

/// Everything that a [`Scene`] borrows.
#[derive(Debug, Clone)]
pub struct SceneBuffers {
    nodes: Vec<Node>,
    surfaces: Vec<Surface<AnyShape>>,
    normals: Vec<CornerNormals>,
    lights: Vec<AnyLight>,
    bsdfs: Vec<TwoSided<AnyBsdf>>,
    power: Vec<f32>,
    degenerate: usize,
}

/// What a scene holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SceneStats {
    /// Triangles.
    pub triangles: usize,
    /// Triangles that were left out because they have no area.
    pub degenerate: usize,
    /// Rectangles, disks, spheres and cylinders.
    pub analytic: usize,
    /// Lights, counting each emitting triangle.
    pub lights: usize,
    /// BSDFs.
    pub bsdfs: usize,
    /// Nodes of the tree.
    pub nodes: usize,
    /// Stack entries that the worst ray needs.
    pub stack: usize,
    /// Bytes of all tables.
    pub bytes: usize,
}

impl SceneBuffers {
    /// Builds the tree and the tables of a description.
    ///
    /// # Errors
    /// When the description contradicts itself; see [`BuildError`].
    pub fn new(description: &Description) -> Result<Self, BuildError> {
        let (primitives, degenerate) = list(description)?;
        let boxes: Vec<Aabb> =
            primitives.iter().map(|p| p.shape(description).map_or(Aabb::EMPTY, |s| s.bounds())).collect();
        let tree = build_tree(&boxes)?;
        let bounds = boxes.iter().fold(Aabb::EMPTY, |a, b| a.union(*b));
        drop(boxes);
        let mut buffers = Self {
            nodes: tree.nodes,
            surfaces: Vec::with_capacity(primitives.len()),
            normals: Vec::new(),
            lights: description.lights.clone(),
            bsdfs: description.materials.iter().map(|m| m.bsdf).collect(),
            power: Vec::new(),
            degenerate,
        };
        buffers.place(description, &primitives, &tree.order)?;
        buffers.share_power(0.5 * bounds.diagonal());
        buffers.try_scene()?;
        Ok(buffers)
    }

    /// Puts the surfaces where the tree looks for them; lights keep the order of the description.
    fn place(
        &mut self,
        description: &Description,
        primitives: &[Primitive],
        order: &[u32],
    ) -> Result<(), BuildError> {
        let mut light_of = vec![NONE; primitives.len()];
        for (primitive, light) in primitives.iter().zip(&mut light_of) {
            if description.objects[primitive.object as usize].emission.is_none() {
                continue;
            }
            let Some(shape) = primitive.shape(description) else { continue };
            if let Some(l) = primitive.light(description, shape)? {
                *light = self.lights.len() as u32;
                self.lights.push(l);
            }
        }
        for &index in order {
            let primitive = &primitives[index as usize];
            let Some(shape) = primitive.shape(description) else { continue };
            let normals = match primitive.normals(description) {
                Some(n) => {
                    self.normals.push(n);
                    self.normals.len() as u32 - 1
                }
                None => NONE,
            };
            let bsdf = description.objects[primitive.object as usize].material as u32;
            self.surfaces.push(Surface { shape, bsdf, light: light_of[index as usize], normals });
        }
        Ok(())
    }

    /// Fills the table of cumulative powers; it stays empty where there is no power.
    fn share_power(&mut self, scene_radius: f32) {
        let mut table = vec![0.0; self.lights.len()];
        if PowerTable::fill(&mut table, |i| self.lights[i].power(scene_radius)) {
            self.power = table;
        }
    }

    fn try_scene(&self) -> Result<AnyScene<'_>, BuildError> {
        let bvh = Bvh::new(&self.nodes, self.surfaces.len())?;
        Ok(Scene::new(bvh, &self.surfaces, &self.normals, &self.lights, &self.bsdfs)?)
    }

    /// The scene, borrowed.
    ///
    /// # Panics
    /// Never: [`SceneBuffers::new`] has made this very scene once, and nothing has changed since.
    #[must_use]
    pub fn scene(&self) -> AnyScene<'_> {
        self.try_scene().expect("checked when the buffers were made")
    }

    /// Powers of the lights for choosing among them; `None` when no light has any.
    #[must_use]
    pub fn power_table(&self) -> Option<PowerTable<'_>> {
        PowerTable::new(&self.power)
    }

    /// What the scene holds.
    #[must_use]
    pub fn stats(&self) -> SceneStats {
        let triangles = self.surfaces.iter().filter(|s| matches!(s.shape, AnyShape::Triangle(_))).count();
        let scene = self.scene();
        SceneStats {
            triangles,
            degenerate: self.degenerate,
            analytic: self.surfaces.len() - triangles,
            lights: self.lights.len(),
            bsdfs: self.bsdfs.len(),
            nodes: self.nodes.len(),
            stack: scene.bvh().stack_needed(),
            bytes: size_of_val(&*self.nodes)
                + size_of_val(&*self.surfaces)
                + size_of_val(&*self.normals)
                + size_of_val(&*self.lights)
                + size_of_val(&*self.bsdfs)
                + size_of_val(&*self.power),
        }
    }
}
