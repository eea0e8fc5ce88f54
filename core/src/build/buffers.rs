//! The tables of a scene, owned.

use super::painted::{Emitted, PaintedBuffer};
use super::primitives::{Primitive, list};
use super::surroundings::EnvironmentBuffer;
use super::tree::build_tree_of;
use super::{BoundScene, BuildError, Description, LightTreeBuffers, Material};
use crate::bvh::{Bvh, Node};
use crate::choose::{LightTree, PowerTable};
use crate::geom::Aabb;
use crate::light::{AnyLight, Emitter, Portal};
use crate::material::AnyMaterial;
use crate::scene::{CornerNormals, CornerUvs, NONE, Surface};
use crate::shape::AnyShape;
use crate::texture::ObjectSpace;
use core::mem::size_of_val;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::vec;
use std::vec::Vec;

/// Everything that a [`Scene`](crate::Scene) borrows.
#[derive(Debug, Clone)]
pub struct SceneBuffers {
    pub(super) nodes: Vec<Node>,
    pub(super) surfaces: Vec<Surface<AnyShape>>,
    pub(super) normals: Vec<CornerNormals>,
    pub(super) uvs: Vec<CornerUvs>,
    pub(super) object_spaces: Vec<ObjectSpace>,
    pub(super) lights: Vec<AnyLight<'static>>,
    pub(super) painted: Vec<PaintedBuffer>,
    pub(super) environments: Vec<EnvironmentBuffer>,
    pub(super) portals: Vec<Portal>,
    pub(super) materials: Vec<AnyMaterial<'static>>,
    /// Those that have textures, each with its index.
    pub(super) textured: Vec<(usize, Material)>,
    pub(super) power: Vec<f32>,
    pub(super) light_tree: LightTreeBuffers,
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

/// The materials that have textures.
fn textured(materials: &[Material]) -> Vec<(usize, Material)> {
    materials.iter().enumerate().filter(|(_, m)| !m.is_plain()).map(|(i, m)| (i, m.clone())).collect()
}

/// Adds an entry to a table; its index, or [`NONE`] when there is none.
fn entry<T>(table: &mut Vec<T>, value: Option<T>) -> u32 {
    let Some(value) = value else { return NONE };
    table.push(value);
    table.len() as u32 - 1
}

impl SceneBuffers {
    /// Builds the tree and the tables of a description.
    ///
    /// # Errors
    /// When the description contradicts itself; see [`BuildError`].
    pub fn new(description: &Description) -> Result<Self, BuildError> {
        let (primitives, degenerate) = list(description)?;
        let environments =
            description.environments.iter().map(EnvironmentBuffer::new).collect::<Result<_, _>>()?;
        let tree = build_tree_of(primitives.len(), &|i| primitives[i as usize].bounds(description))?;
        let bounds = tree.nodes.first().map_or(Aabb::EMPTY, Node::bounds);
        let mut buffers = Self {
            nodes: tree.nodes,
            surfaces: Vec::with_capacity(primitives.len()),
            normals: Vec::new(),
            uvs: Vec::new(),
            object_spaces: Vec::new(),
            lights: Vec::new(),
            painted: Vec::new(),
            environments,
            portals: description.portals.clone(),
            materials: description.materials.iter().map(|m| AnyMaterial::Plain(m.bsdf)).collect(),
            textured: textured(&description.materials),
            power: Vec::new(),
            light_tree: LightTreeBuffers::default(),
            degenerate,
            stack: 0,
        };
        buffers.place(description, &primitives, &tree.order)?;
        buffers.stack = BoundScene::checked(&buffers)?.scene().bvh().stack_needed();
        buffers.prepare_choices(0.5 * bounds.diagonal())?;
        Ok(buffers)
    }

    /// Lists the lights in the order of the description, but for those around the scene, which come
    /// last; the light that each primitive is, or [`NONE`].
    pub(super) fn list_lights(
        &mut self,
        description: &Description,
        primitives: &[Primitive],
    ) -> Result<Vec<u32>, BuildError> {
        let (around, mut lights): (Vec<_>, Vec<_>) =
            description.lights.iter().partition::<Vec<AnyLight<'static>>, _>(|l| l.is_environment());
        let mut light_of = vec![NONE; primitives.len()];
        // Primitives of one object follow one another.
        let mut picture = (u32::MAX, None);
        for (primitive, light) in primitives.iter().zip(&mut light_of) {
            let object = &description.objects[primitive.object as usize];
            if object.emission.is_none() {
                continue;
            }
            let Some(shape) = primitive.shape(description) else { continue };
            if picture.0 != primitive.object {
                picture = (primitive.object, Emitted::new(object)?);
            }
            if let Some(emitted) = &picture.1 {
                let uvs = primitive.surface_uvs(description);
                let Some(painted) = PaintedBuffer::new(lights.len(), emitted, shape, uvs)? else { continue };
                self.painted.push(painted);
            }
            // Of a light with a picture this keeps the place only.
            if let Some(l) = primitive.light(description, shape)? {
                *light = lights.len() as u32;
                lights.push(l);
            }
        }
        lights.extend(around);
        self.lights = lights;
        Ok(light_of)
    }

    /// Puts the surfaces where the tree looks for them.
    fn place(
        &mut self,
        description: &Description,
        primitives: &[Primitive],
        order: &[u32],
    ) -> Result<(), BuildError> {
        let light_of = self.list_lights(description, primitives)?;
        for &index in order {
            let primitive = &primitives[index as usize];
            let Some(shape) = primitive.shape(description) else { continue };
            let material = description.objects[primitive.object as usize].material;
            self.surfaces.push(Surface {
                shape,
                material: material as u32,
                light: light_of[index as usize],
                normals: entry(&mut self.normals, primitive.normals(description)),
                uvs: NONE,
            });
        }
        if description.materials.iter().any(Material::needs_uvs) {
            self.lay_out(description, primitives, order);
        }
        Ok(())
    }

    /// Gives texture coordinates to the surfaces whose material needs them.
    fn lay_out(&mut self, description: &Description, primitives: &[Primitive], order: &[u32]) {
        let needs_uvs = |p: &Primitive| {
            description.materials[description.objects[p.object as usize].material].needs_uvs()
        };
        let of = |index: &u32| Some(&primitives[*index as usize]).filter(|p| needs_uvs(p));
        for (surface, primitive) in self.surfaces.iter_mut().zip(order.iter().map(of)) {
            surface.uvs = entry(&mut self.uvs, primitive.and_then(|p| p.uvs(description)));
        }
        let corners = self.uvs.len() as u32;
        for (surface, primitive) in self.surfaces.iter_mut().zip(order.iter().map(of)) {
            let space = primitive.and_then(|p| p.object_space(description));
            if space.is_some() {
                surface.uvs = corners + entry(&mut self.object_spaces, space);
            }
        }
    }

    /// Fills the table of cumulative powers, which stays empty where there is no power, and builds the
    /// tree of lights.
    pub(super) fn prepare_choices(&mut self, scene_radius: f32) -> Result<(), BuildError> {
        let bound = self.bind();
        let lights = bound.scene().lights();
        let light_tree = LightTreeBuffers::new(lights);
        light_tree.tree()?;
        let mut table = vec![0.0; lights.len()];
        let has_power = PowerTable::fill(&mut table, |i| lights[i].power(scene_radius));
        self.power = if has_power { table } else { Vec::new() };
        self.light_tree = light_tree;
        Ok(())
    }

    /// Binds the tables to one another: what a scene borrows from.
    ///
    /// # Panics
    /// Never: [`SceneBuffers::new`] has checked this very thing, and nothing has changed since.
    #[must_use]
    pub fn bind(&self) -> BoundScene<'_> {
        let bvh = Bvh::known_to_fit(&self.nodes, self.stack);
        BoundScene::new(self, bvh).expect("checked when the buffers were made")
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

    /// Bytes of the textures' texels; shared ones count once.
    fn texel_bytes(&self) -> usize {
        let textures = self.textured.iter().flat_map(|(_, m)| &m.textures).flat_map(|t| t.iter());
        let of_lights = self.painted.iter().filter_map(PaintedBuffer::texels);
        let buffers = textures.filter_map(|t| t.texels.as_ref()).chain(of_lights);
        let distinct: BTreeMap<_, _> = buffers.map(|b| (Arc::as_ptr(b), b.bytes())).collect();
        distinct.values().sum()
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
                + size_of_val(&*self.uvs)
                + size_of_val(&*self.object_spaces)
                + self.texel_bytes()
                + self.painted.iter().map(PaintedBuffer::bytes).sum::<usize>()
                + size_of_val(&*self.lights)
                + size_of_val(&*self.portals)
                + size_of_val(&*self.materials)
                + size_of_val(&*self.power)
                + self.environments.iter().map(EnvironmentBuffer::bytes).sum::<usize>()
                + self.light_tree.bytes(),
        }
    }
}
