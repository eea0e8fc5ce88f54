//! The nodes of a scene, and what is at them.

use super::container::{item, malformed};
use super::document::{self, Document, Node, Primitive};
use super::log::Log;
use super::material::{Known, Materials};
use super::source::{Source, entry};
use super::{camera, environment, glow, light, mesh};
use crate::build::{CameraDescription, EnvironmentDescription, Geometry, Mesh, Object};
use crate::light::AnyLight;
use crate::load::mesh::{Placement, place};
use crate::load::{LoadError, MeshError, Problem};
use glam::{DMat4, DQuat, DVec3};
use std::format;
use std::string::String;
use std::vec;
use std::vec::Vec;

/// Most triangles of a scene, those of a mesh counted wherever a node has it: 33 million.
const MAX_TRIANGLES: usize = 1 << 25;

/// The parts gathered so far.
#[derive(Debug, Default)]
pub(super) struct Parts {
    pub(super) camera: Option<(CameraDescription, u32)>,
    /// The node that has it.
    pub(super) camera_node: Option<usize>,
    pub(super) objects: Vec<Object>,
    pub(super) lights: Vec<AnyLight<'static>>,
    pub(super) environment: Option<EnvironmentDescription>,
    pub(super) materials: Materials,
    triangles: usize,
    lenient: bool,
}

impl Parts {
    /// Gathers what is at the nodes of the scene that is shown.
    ///
    /// * `lenient` – leaves out what is not supported
    pub(super) fn gather(source: &Source<'_>, log: &mut Log<'_>, lenient: bool) -> Result<Self, LoadError> {
        let mut parts = Self { lenient, ..Self::default() };
        let nodes = &source.document.nodes;
        let fail = |name: &str, problem| item(source.path, name, problem);
        let shown = shown(&source.document).map_err(|problem| fail("scenes", problem))?;
        let surrounding = environment::read(source, shown);
        parts.environment = surrounding.map_err(|problem| fail("EXT_lights_image_based", problem))?;
        let mut waiting = roots(&source.document, shown);
        let mut reached = vec![false; nodes.len()];
        while let Some((index, parent)) = waiting.pop() {
            let name = format!("nodes[{index}]");
            let node = entry(nodes, "nodes", index).map_err(|problem| fail("nodes", problem))?;
            if core::mem::replace(&mut reached[index], true) {
                let what = "it is reached twice; a node is the child of one other at most";
                return Err(fail(&name, malformed(what)));
            }
            let to_world = transform(node).map(|own| parent * own).map_err(|problem| fail(&name, problem))?;
            parts.visit(source, log, &name, node, &to_world)?;
            if parts.camera.is_some() {
                parts.camera_node.get_or_insert(index);
            }
            waiting.extend(node.children.iter().rev().map(|child| (*child, to_world)));
        }
        Ok(parts)
    }

    fn visit(
        &mut self,
        source: &Source<'_>,
        log: &mut Log<'_>,
        name: &str,
        node: &Node,
        to_world: &DMat4,
    ) -> Result<(), LoadError> {
        let document = &source.document;
        let fail = |problem| item(source.path, name, problem);
        if let Some(index) = node.camera {
            let written = entry(&document.cameras, "cameras", index).map_err(fail)?;
            if self.camera.is_some() {
                log.warn(name, "only the first camera is used");
            } else {
                self.camera = Some(camera::place(written, to_world).map_err(fail)?);
            }
        }
        if let Some(of) = &node.extensions.light {
            let lights = &document.extensions.lights.lights;
            let light = entry(lights, "lights", of.light).and_then(|l| light::place(l, to_world));
            self.lights.push(light.map_err(fail)?);
        }
        if let Some(index) = node.mesh {
            if node.skin.is_some() {
                log.warn(name, "its skin is left out; it stands as it was modelled");
            }
            let mesh = entry(&document.meshes, "meshes", index).map_err(fail)?;
            self.mesh(source, log, (index, mesh), node, to_world)?;
        }
        Ok(())
    }

    fn mesh(
        &mut self,
        source: &Source<'_>,
        log: &mut Log<'_>,
        (index, mesh): (usize, &document::Mesh),
        node: &Node,
        to_world: &DMat4,
    ) -> Result<(), LoadError> {
        let own = node.name.as_deref().or(mesh.name.as_deref()).filter(|name| !name.is_empty());
        let name = own.map_or_else(|| format!("mesh {index}"), String::from);
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let at = format!("meshes[{index}].primitives[{number}]");
            if !mesh::is_surface(primitive) {
                log.warn(&at, "points and lines are left out");
                continue;
            }
            match self.primitive(source, log, &at, &name, primitive, to_world) {
                Err(problem) if self.lenient && problem.can_be_left_out() => {
                    log.warn(&at, &format!("{problem}; left out"));
                }
                result => result.map_err(|problem| item(source.path, &at, problem))?,
            }
        }
        Ok(())
    }

    fn primitive(
        &mut self,
        source: &Source<'_>,
        log: &mut Log<'_>,
        at: &str,
        name: &str,
        primitive: &Primitive,
        to_world: &DMat4,
    ) -> Result<(), Problem> {
        let material = self.materials.get(source, log, primitive.material)?;
        if !primitive.targets.is_empty() {
            log.warn(at, "its morph targets are left out");
        }
        if primitive.attributes.contains_key("COLOR_0") {
            log.warn(at, "the colours of its vertices are left out");
        }
        let mesh = mesh::read(source, primitive, material.uv_set)?;
        self.triangles += mesh.triangles.len();
        if self.triangles > MAX_TRIANGLES {
            return Err(Problem::TooLarge { what: "triangles", limit: MAX_TRIANGLES });
        }
        let face_normals = mesh.normals.is_empty();
        // Flat triangles that are mirrored still face outward.
        let flip_normals = face_normals && to_world.determinant() < 0.0;
        let placement = Placement { to_world: *to_world, face_normals, flip_normals };
        match place(mesh, &placement) {
            _ if !(to_world.determinant().abs() > 0.0) => log.warn(at, "its node has no volume; left out"),
            Err(MeshError::Empty) => log.warn(at, "no triangle has an area; left out"),
            Err(other) => return Err(malformed(format!("{other}"))),
            Ok((mesh, _)) => self.add(name, mesh, &material),
        }
        Ok(())
    }

    /// Adds a surface, in two parts when only some of it emits.
    fn add(&mut self, name: &str, mesh: Mesh, material: &Known) {
        let texture = material.emission.as_ref().and_then(|emission| emission.texture.as_ref());
        let [glowing, dark] = match texture {
            Some(texture) => glow::split(mesh, texture),
            None => [Some(mesh), None],
        };
        for (mesh, emission) in [(glowing, material.emission.clone()), (dark, None)] {
            let Some(mesh) = mesh else { continue };
            let geometry = Geometry::Mesh(mesh);
            let (name, material) = (name.into(), material.index);
            self.objects.push(Object { name, geometry, material, emission, object_space: None });
        }
    }
}

/// The scene that the file wants shown, or its first one; `None` when it has none.
fn shown(document: &Document) -> Result<Option<&document::Scene>, Problem> {
    match document.scene {
        Some(index) => entry(&document.scenes, "scenes", index).map(Some),
        None => Ok(document.scenes.first()),
    }
}

/// The nodes to begin with, the last one first: those of a scene, or those that are no node's child.
fn roots(document: &Document, shown: Option<&document::Scene>) -> Vec<(usize, DMat4)> {
    let mut roots: Vec<usize> = match shown {
        Some(scene) => scene.nodes.clone(),
        None => {
            let mut is_root = vec![true; document.nodes.len()];
            for child in document.nodes.iter().flat_map(|node| &node.children) {
                if let Some(root) = is_root.get_mut(*child) {
                    *root = false;
                }
            }
            (0..is_root.len()).filter(|index| is_root[*index]).collect()
        }
    };
    roots.reverse();
    roots.into_iter().map(|index| (index, DMat4::IDENTITY)).collect()
}

/// From the space of a node to that of its parent.
pub(super) fn transform(node: &Node) -> Result<DMat4, Problem> {
    let m = match node.matrix {
        Some(matrix) => DMat4::from_cols_array(&matrix),
        None => {
            let rotation = DQuat::from_array(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
            if !(rotation.length_squared() > 0.0) {
                return Err(malformed("its rotation has no length"));
            }
            DMat4::from_scale_rotation_translation(
                DVec3::from_array(node.scale.unwrap_or([1.0; 3])),
                rotation.normalize(),
                DVec3::from_array(node.translation.unwrap_or_default()),
            )
        }
    };
    if m.is_finite() { Ok(m) } else { Err(malformed("its transform is not finite")) }
}
