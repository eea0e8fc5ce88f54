//! Random scenes over the whole range of sizes, shapes, materials and lights, for programs that run long.

use crate::random::Uniforms;
use crate::scenes::Stage;
use halflight::Rgb;
use halflight::bsdf::{AnyBsdf, GgxConductor, Lambert, MetallicRoughness, Phong, RoughPlastic, TwoSided};
use halflight::build::{
    Description, Emission, EnvironmentDescription, Geometry, Image, Material, Mesh, Object,
};
use halflight::camera::View;
use halflight::glam::{Mat3, Vec3};
use halflight::light::{AnyLight, Constant, Directional, Point, Spot};
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Sphere, Triangle};

/// The scene that belongs to a seed: up to 8 objects and 3 lights, from a millimetre to a kilometre, of
/// every kind of material, with shapes from round to a needle.
#[must_use]
pub fn scene(seed: u64) -> Description {
    let mut u = Uniforms::new(seed);
    let mut scene = Stage::empty().0;
    let size = power(&mut u, -3.0, 3.0);
    scene.name = format!("seed-{seed}");
    (scene.width, scene.height) = (32, 24);
    let eye = u.direction() * size * u.between(1.5, 8.0);
    if let Ok(view) = View::look_at(eye, u.in_cube() * size * 0.3, u.direction()) {
        scene.camera.view = view;
    }
    scene.materials = (0..3).filter_map(|i| Some(material(i, bsdf(&mut u)?))).collect();
    if scene.materials.is_empty() {
        scene.materials = Stage::empty().0.materials;
    }
    for i in 0..=u.below(8) {
        let geometry = if u.below(3) == 0 { Some(mesh(&mut u, size)) } else { shape(&mut u, size) };
        let Some(geometry) = geometry else { continue };
        // Meshes of many lights are slow, and no other case than small ones.
        let emits = i == 0 || u.below(4) == 0;
        let radiance = colour(&mut u) * power(&mut u, -6.0, 6.0);
        let emission = emits.then(|| Emission { radiance, texture: None, two_sided: u.below(2) == 0 });
        let material = u.below(scene.materials.len());
        let name = format!("object-{i}");
        scene.objects.push(Object { name, geometry, material, emission, object_space: None });
    }
    scene.lights.extend((0..u.below(3)).filter_map(|_| light(&mut u, size)));
    // One light at most is all around.
    let is_around = |light: &AnyLight<'_>| matches!(light, AnyLight::Constant(_));
    let is_surrounded = scene.lights.iter().any(is_around);
    if scene.lights.iter().all(is_around) {
        scene.lights.truncate(1);
    }
    if !is_surrounded && u.below(3) == 0 {
        scene.environments.push(environment(&mut u));
    }
    scene
}

/// Log-uniform between powers of ten.
fn power(u: &mut Uniforms, low: f32, high: f32) -> f32 {
    10.0_f32.powf(u.between(low, high))
}

/// Each channel up to 1, sometimes 0.
fn colour(u: &mut Uniforms) -> Rgb {
    let mut channel = || if u.below(6) == 0 { 0.0 } else { u.one() };
    Rgb::new(channel(), channel(), channel())
}

fn material(i: usize, bsdf: AnyBsdf) -> Material {
    Material { name: format!("material-{i}"), bsdf: TwoSided::both(bsdf), textures: Default::default() }
}

fn bsdf(u: &mut Uniforms) -> Option<AnyBsdf> {
    let (c, roughness) = (colour(u), u.between(0.02, 1.0));
    Some(match u.below(5) {
        0 => AnyBsdf::Lambert(Lambert::new(c).ok()?),
        1 => AnyBsdf::Phong(Phong::new(c * 0.5, colour(u) * 0.5, power(u, 0.0, 4.0)).ok()?),
        2 => AnyBsdf::GgxConductor(GgxConductor::new(c, roughness).ok()?),
        3 => AnyBsdf::RoughPlastic(RoughPlastic::new(roughness, u.between(1.1, 2.0)).ok()?),
        _ => AnyBsdf::MetallicRoughness(MetallicRoughness::new(c, u.one(), roughness).ok()?),
    })
}

/// A shape somewhere in the scene.
fn shape(u: &mut Uniforms, size: f32) -> Option<Geometry> {
    let (centre, long) = (u.in_cube() * size, size * power(u, -3.0, 0.3));
    let (along, across) = (u.direction() * long, u.direction());
    let across = (across - along.normalize() * across.dot(along.normalize())).try_normalize()?;
    let across = across * long * power(u, -3.0, 0.0);
    Some(Geometry::Shape(match u.below(5) {
        0 => AnyShape::Rectangle(Rectangle::new(centre, along, across).ok()?),
        1 => AnyShape::Disk(Disk::new(centre, along, across).ok()?),
        2 => AnyShape::Triangle(Triangle::new(centre, centre + along, centre + across).ok()?),
        3 => AnyShape::Cylinder(Cylinder::new(centre, along, across.length()).ok()?),
        _ => AnyShape::Sphere(Sphere::new(centre, long).ok()?),
    }))
}

/// Triangles between random corners, some of them without area.
fn mesh(u: &mut Uniforms, size: f32) -> Geometry {
    let (centre, extent) = (u.in_cube() * size, size * power(u, -2.0, 0.0));
    let positions: Vec<Vec3> = (0..3 + u.below(12)).map(|_| centre + u.in_cube() * extent).collect();
    let count = positions.len();
    let mut corner = || u.below(count) as u32;
    let random = (0..count).map(|_| [corner(), corner(), corner()]);
    // One has an area: a mesh without any is refused.
    let triangles = [[0, 1, 2]].into_iter().chain(random).collect();
    Geometry::Mesh(Mesh { positions, triangles, ..Mesh::default() })
}

/// A light without a surface.
fn light(u: &mut Uniforms, size: f32) -> Option<AnyLight<'static>> {
    let (at, strength) = (u.in_cube() * 2.0 * size, colour(u) * power(u, -3.0, 3.0));
    Some(match u.below(4) {
        0 => AnyLight::Point(Point::new(at, strength * size * size).ok()?),
        1 => {
            let (wide, narrow) = (u.between(0.1, 1.5), u.one());
            AnyLight::Spot(Spot::new(at, -at, strength * size * size, wide * narrow, wide).ok()?)
        }
        2 => AnyLight::Directional(Directional::new(u.direction(), strength).ok()?),
        _ => AnyLight::Constant(Constant::new(strength).ok()?),
    })
}

/// A picture of the sky with a few bright texels.
fn environment(u: &mut Uniforms) -> EnvironmentDescription {
    let (width, height) = (2 + u.below(14) as u32, 1 + u.below(8) as u32);
    let texel = |u: &mut Uniforms| colour(u) * if u.below(16) == 0 { power(u, 0.0, 5.0) } else { 1.0 };
    let texels = (0..width * height).map(|_| texel(u)).collect();
    let to_world = Mat3::from_axis_angle(u.direction(), u.between(-3.0, 3.0));
    EnvironmentDescription::new(Image { width, height, texels }, to_world)
}
