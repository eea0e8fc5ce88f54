//! The tables of a scene, owned.

use super::primitives::{Primitive, list};
use super::{BoundScene, BuildError, Description, EnvironmentDescription, LightTreeBuffers, build_tree};
use crate::bsdf::{AnyBsdf, TwoSided};
use crate::bvh::Node;
use crate::choose::{LightTree, PowerTable};
use crate::geom::Aabb;
use crate::light::{AnyLight, Emitter};
use crate::scene::{CornerNormals, NONE, Surface};
use crate::shape::{AnyShape, Shape};
use core::mem::size_of_val;
use std::vec;
use std::vec::Vec;

/// Everything that a [`Scene`] borrows.
#[derive(Debug, Clone)]
pub struct SceneBuffers {
    pub(super) nodes: Vec<Node>,
    pub(super) surfaces: Vec<Surface<AnyShape>>,
    pub(super) normals: Vec<CornerNormals>,
    pub(super) lights: Vec<AnyLight<'static>>,
    pub(super) environments: Vec<EnvironmentDescription>,
    pub(super) materials: Vec<TwoSided<AnyBsdf>>,
    power: Vec<f32>,
    light_tree: LightTreeBuffers,
    degenerate: usize,
    stack: usize,
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
    /// Materials.
    pub materials: usize,
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
            lights: Vec::new(),
            environments: description.environments.clone(),
            materials: description.materials.iter().map(|m| m.bsdf).collect(),
            power: Vec::new(),
            light_tree: LightTreeBuffers::default(),
            degenerate,
            stack: 0,
        };
        buffers.place(description, &primitives, &tree.order)?;
        buffers.prepare_choices(0.5 * bounds.diagonal())?;
        Ok(buffers)
    }

    /// Puts the surfaces where the tree looks for them; lights keep the order of the description, but
    /// for those around the scene, which come last.
    fn place(
        &mut self,
        description: &Description,
        primitives: &[Primitive],
        order: &[u32],
    ) -> Result<(), BuildError> {
        let (around, mut lights): (Vec<_>, Vec<_>) =
            description.lights.iter().partition::<Vec<AnyLight<'static>>, _>(|l| l.is_environment());
        let mut light_of = vec![NONE; primitives.len()];
        for (primitive, light) in primitives.iter().zip(&mut light_of) {
            if description.objects[primitive.object as usize].emission.is_none() {
                continue;
            }
            let Some(shape) = primitive.shape(description) else { continue };
            if let Some(l) = primitive.light(description, shape)? {
                *light = lights.len() as u32;
                lights.push(l);
            }
        }
        lights.extend(around);
        self.lights = lights;
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
            let material = description.objects[primitive.object as usize].material as u32;
            self.surfaces.push(Surface {
                shape,
                material,
                light: light_of[index as usize],
                normals,
                uvs: NONE,
            });
        }
        Ok(())
    }

    /// Fills the table of cumulative powers, which stays empty where there is no power, and builds the
    /// tree of lights.
    fn prepare_choices(&mut self, scene_radius: f32) -> Result<(), BuildError> {
        let bound = BoundScene::new(self)?;
        let lights = bound.scene().lights();
        let stack = bound.scene().bvh().stack_needed();
        let light_tree = LightTreeBuffers::new(lights);
        light_tree.tree()?;
        let mut table = vec![0.0; lights.len()];
        if PowerTable::fill(&mut table, |i| lights[i].power(scene_radius)) {
            self.power = table;
        }
        self.light_tree = light_tree;
        self.stack = stack;
        Ok(())
    }

    /// Binds the tables to one another: what a scene borrows from.
    ///
    /// # Panics
    /// Never: [`SceneBuffers::new`] has done this very thing once, and nothing has changed since.
    #[must_use]
    pub fn bind(&self) -> BoundScene<'_> {
        BoundScene::new(self).expect("checked when the buffers were made")
    }

    /// Powers of the lights for choosing among them; `None` when no light has any.
    #[must_use]
    pub fn power_table(&self) -> Option<PowerTable<'_>> {
        PowerTable::new(&self.power)
    }

    /// The tree of the lights, for choosing among them.
    ///
    /// # Panics
    /// Never: this very tree was checked when the buffers were made.
    #[must_use]
    pub fn light_tree(&self) -> LightTree<'_> {
        self.light_tree.tree().expect("checked when the buffers were made")
    }

    /// What the scene holds.
    #[must_use]
    pub fn stats(&self) -> SceneStats {
        let triangles = self.surfaces.iter().filter(|s| matches!(s.shape, AnyShape::Triangle(_))).count();
        SceneStats {
            triangles,
            degenerate: self.degenerate,
            analytic: self.surfaces.len() - triangles,
            lights: self.lights.len() + self.environments.len(),
            materials: self.materials.len(),
            nodes: self.nodes.len(),
            stack: self.stack,
            bytes: size_of_val(&*self.nodes)
                + size_of_val(&*self.surfaces)
                + size_of_val(&*self.normals)
                + size_of_val(&*self.lights)
                + size_of_val(&*self.materials)
                + size_of_val(&*self.power)
                + self.light_tree.bytes(),
        }
    }
}
