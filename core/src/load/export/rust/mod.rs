//! Writes a scene as Rust source: constants that a program without an allocator borrows.
//!
//! What is written has the narrowest types that the scene needs, so that a program links nothing else: a
//! scene of triangles is a `Scene<Triangle, …>`.

mod expression;
pub(super) mod narrow;

use super::{ExportError, write_whole};
use crate::build::{Description, SceneBuffers};
use crate::film::Film;
use crate::scene::AnyScene;
use expression::{camera, corner_normals, corner_uvs, film, node, object_space, surface};
use narrow::Narrow;
use std::fmt::Write as _;
use std::format;
use std::io::Write as _;
use std::path::Path;
use std::string::{String, ToString};
use std::vec::Vec;

/// The source of a Rust module that holds a scene, its camera and its film, built and checked. The same
/// pictures come from it, to the last bit.
///
/// It names nothing but `halflight`, `core` needs neither `build` nor `load` for it, and it can be a file of
/// a program or be included from the folder into which a build script has written it:
///
/// ```no_run
/// // build.rs, with halflight and its feature `load` among the build-dependencies.
/// use halflight::load::{builtin::builtin, rust_source};
///
/// fn main() -> Result<(), Box<dyn std::error::Error>> {
///     let mut room = builtin("cornell").ok_or("no such scene")?;
///     (room.width, room.height) = (64, 48);
///     let folder = std::env::var("OUT_DIR")?;
///     std::fs::write(format!("{folder}/room.rs"), rust_source(&room)?)?;
///     Ok(())
/// }
/// ```
///
/// # Errors
/// When the scene cannot be built, or holds what is not written: textures and pictures of surroundings.
pub fn rust_source(description: &Description) -> Result<String, ExportError> {
    let buffers = SceneBuffers::new(description).map_err(|e| build_error(&e))?;
    let camera_of = |d: &Description| d.camera.camera(d.width, d.height);
    let view = camera_of(description).map_err(|e| build_error(&e))?;
    let raster = Film::new(description.width, description.height, description.filter);
    let raster = raster.map_err(|e| build_error(&e))?;
    let bound = buffers.bind();
    let mut source = module(&description.name, &bound.scene())?;
    let power = buffers.power_table();
    if let Some(power) = power.filter(|_| bound.scene().lights().len() > 1) {
        let shares = power.as_slice().iter().map(|share| format!("{share:?}"));
        item(&mut source, "Cumulative shares of the lights in all power.", "POWER", "f32", shares.collect());
    }
    camera(&mut source, &description.camera, &view);
    film(&mut source, &raster);
    Ok(source)
}

/// Writes the source of [`rust_source`] to a file, whole or not at all.
///
/// # Errors
/// As [`rust_source`], and when the file cannot be written.
pub fn export_rust(description: &Description, path: &Path) -> Result<(), ExportError> {
    let source = rust_source(description)?;
    write_whole(path, |out| out.write_all(source.as_bytes()))
}

fn build_error(source: &dyn core::error::Error) -> ExportError {
    ExportError::Scene { message: source.to_string() }
}

/// The tables, and what makes a scene of them.
fn module(name: &str, scene: &AnyScene<'_>) -> Result<String, ExportError> {
    let narrow = Narrow::new(scene)?;
    let tables = scene.tables();
    let shape = narrow.shape();
    let mut source = head(name, &narrow, scene);
    let out = &mut source;
    let nodes = scene.bvh().nodes();
    item(out, "The tree over the surfaces.", "NODES", "Node", nodes.iter().map(node).collect());
    let surfaces = tables.surfaces.iter().map(|s| surface(s, &narrow.shape_of(&s.shape)));
    item(out, "What rays meet.", "SURFACES", &format!("Surface<{shape}>"), surfaces.collect());
    let normals = tables.normals.iter().map(corner_normals).collect();
    item(out, "Shading normals of triangles.", "NORMALS", "CornerNormals", normals);
    let uvs = tables.uvs.iter().map(corner_uvs).collect();
    item(out, "Texture coordinates of triangles.", "UVS", "CornerUvs", uvs);
    let spaces = tables.object_spaces.iter().map(object_space).collect();
    item(out, "Texture coordinates of other shapes.", "OBJECT_SPACES", "ObjectSpace", spaces);
    let lights = tables.lights.iter().map(|l| narrow.light_of(l)).collect::<Result<_, _>>()?;
    item(out, "The lights; those around the scene come last.", "LIGHTS", "Light", lights);
    let materials = tables.materials.iter().map(|m| narrow.material_of(m)).collect::<Result<_, _>>()?;
    item(out, "What surfaces are made of.", "MATERIALS", "Material", materials);
    out.push_str(SCENE);
    Ok(source)
}

/// What the module is, what it uses, and its types.
fn head(name: &str, narrow: &Narrow, scene: &AnyScene<'_>) -> String {
    let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let one_line = name.replace(char::is_control, " ");
    format!(
        "// The scene \"{one_line}\": {}, {}, {}.\n// Written by halflight; to change it, change the scene and \
         write it again.\n\n{IMPORTS}\n\
         /// What emits here.\npub type Light = {};\n/// What surfaces are made of here.\npub type Material = {};\n\
         /// The scene.\npub type Baked = Scene<'static, {}, Light, Material>;\n",
        count(scene.surfaces().len(), "surface"),
        count(scene.lights().len(), "light"),
        count(scene.materials().len(), "material"),
        narrow.light(),
        narrow.material(),
        narrow.shape(),
    )
}

/// A static table, one entry a line.
fn item(out: &mut String, about: &str, name: &str, kind: &str, entries: Vec<String>) {
    // Writing to a string does not fail.
    let _ = write!(out, "\n/// {about}\npub static {name}: [{kind}; {}] = [", entries.len());
    for entry in &entries {
        let _ = write!(out, "\n    {entry},");
    }
    out.push_str(if entries.is_empty() { "];\n" } else { "\n];\n" });
}

/// Every name that any scene uses.
const IMPORTS: &str = "\
#[allow(unused_imports)]
use halflight::{
    bsdf::{AnyBsdf, GgxConductor, Lambert, MetallicRoughness, Phong, RoughPlastic, TwoSided},
    bvh::{Child, Node},
    camera::View,
    film::Filter,
    geom::Aabb,
    glam::{Mat3, Vec2, Vec3},
    light::{AnyLight, AreaLight, Constant, Directional, DistantDisk, Point, Sides, Spot},
    scene::{BakedError, CornerNormals, CornerUvs, NONE, Surface, Tables},
    shape::{AnyShape, Cylinder, Disk, Rectangle, Sphere, Triangle},
    texture::ObjectSpace,
    Camera, Film, Rgb, Scene,
};
";

/// Makes the scene.
const SCENE: &str = "
/// The scene, after a check that takes time linear in it: do this once.
///
/// # Errors
/// When the constants have been changed to what halflight does not accept.
pub fn scene() -> Result<Baked, BakedError> {
    let tables = Tables {
        surfaces: &SURFACES,
        normals: &NORMALS,
        uvs: &UVS,
        object_spaces: &OBJECT_SPACES,
        lights: &LIGHTS,
        materials: &MATERIALS,
    };
    Scene::baked(&NODES, tables)
}
";
