//! The scenes that are kept as Rust source.

use glam::Vec3;
use halflight::Rgb;
use halflight::bsdf::{AnyBsdf, GgxConductor, Lambert, MetallicRoughness, Phong, RoughPlastic, TwoSided};
use halflight::build::{Description, Emission, Geometry, Material, MaterialTextures, Mesh, Object};
use halflight::light::{AnyLight, Constant, Directional, DistantDisk, Point, Spot};
use halflight::load::builtin::builtin;
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Sphere, Triangle};

/// The Cornell box, small enough for a microcontroller's patience.
pub(crate) fn cornell() -> Description {
    let mut scene = builtin("cornell").unwrap();
    (scene.width, scene.height) = (64, 48);
    scene
}

/// The same walls and blocks; light comes in through the open front.
pub(crate) fn sky() -> Description {
    let mut scene = cornell();
    scene.objects.retain(|object| object.emission.is_none());
    scene.lights = vec![AnyLight::Constant(Constant::new(Rgb::new(1.0, 1.25, 1.5)).unwrap())];
    scene.name = "cornell under a sky".into();
    scene
}

/// Every shape, light and BSDF that is written, in a heap.
pub(crate) fn everything() -> Description {
    let mut scene = cornell();
    scene.name = "everything".into();
    (scene.width, scene.height) = (16, 12);
    scene.materials.extend(models().map(|bsdf| Material {
        name: String::new(),
        bsdf,
        textures: <[MaterialTextures; 2]>::default(),
    }));
    let shapes = shapes();
    let first = scene.materials.len() - 4;
    for (index, shape) in shapes.into_iter().enumerate() {
        let radiance = Rgb::new(5.0, 4.0 + index as f32, 3.0);
        let emission = |two_sided| Emission { radiance, texture: None, two_sided };
        scene.objects.push(Object {
            name: String::new(),
            geometry: shape,
            material: first + index % 4,
            emission: (index % 2 == 0).then(|| emission(index == 0)),
            object_space: None,
        });
    }
    scene.lights = lights();
    scene
}

fn models() -> [TwoSided<AnyBsdf>; 4] {
    let matte = AnyBsdf::Lambert(Lambert::new(Rgb::new(0.1, 0.7, 0.3)).unwrap());
    let phong = Phong::new(Rgb::splat(0.3), Rgb::new(0.5, 0.4, 0.3), 20.0).unwrap();
    let copper = GgxConductor::anisotropic(Rgb::WHITE, [0.2, 0.4]).unwrap();
    let copper = copper.with_index(Rgb::new(0.2, 0.92, 1.1), Rgb::new(3.9, 2.45, 2.14)).unwrap();
    let plastic = RoughPlastic::new(0.1, 1.5).unwrap().with_diffuse(Rgb::new(0.6, 0.2, 0.1)).unwrap();
    let painted = MetallicRoughness::new(Rgb::new(0.7, 0.5, 0.2), 0.4, 0.3).unwrap();
    let painted = AnyBsdf::MetallicRoughness(painted);
    [
        TwoSided { front: AnyBsdf::Phong(phong), back: Some(matte) },
        TwoSided::both(AnyBsdf::GgxConductor(copper)),
        TwoSided { front: AnyBsdf::RoughPlastic(plastic.with_nonlinear(true)), back: Some(painted) },
        TwoSided::both(matte),
    ]
}

fn shapes() -> Vec<Geometry> {
    let at = |x: f32, y: f32| Vec3::new(0.1 + 0.1 * x, 0.12 + 0.1 * y, 0.1);
    let ball = |x, y| AnyShape::Sphere(Sphere::new(at(x, y), 0.03).unwrap());
    let disk = |x, y| AnyShape::Disk(Disk::new(at(x, y), Vec3::X * 0.03, Vec3::Y * 0.02).unwrap());
    let tube = |x, y| AnyShape::Cylinder(Cylinder::new(at(x, y), Vec3::new(0.02, 0.05, 0.0), 0.01).unwrap());
    let tile = |x, y| AnyShape::Rectangle(Rectangle::new(at(x, y), Vec3::X * 0.02, Vec3::Y * 0.03).unwrap());
    let [a, b, c] = [at(2.0, 2.0), at(2.5, 2.0), at(2.0, 2.5)];
    let triangle = AnyShape::Triangle(Triangle::new(a, c, b).unwrap());
    let inward = AnyShape::Sphere(Sphere::new(at(3.5, 2.0), 0.03).unwrap().flipped());
    let all =
        [ball(0.0, 0.0), ball(1.0, 0.0), disk(2.0, 0.0), disk(3.0, 0.0), tube(0.0, 1.0), tube(1.0, 1.0)];
    let more = [tile(2.0, 1.0), tile(3.0, 1.0), triangle, inward];
    let mesh = Mesh {
        positions: vec![at(0.0, 2.0), at(1.0, 2.0), at(0.0, 3.0)],
        normals: vec![Vec3::NEG_Z, Vec3::new(0.6, 0.0, -0.8), Vec3::new(0.0, 0.6, -0.8)],
        triangles: vec![[0, 2, 1]],
        ..Mesh::default()
    };
    all.into_iter().chain(more).map(Geometry::Shape).chain([Geometry::Mesh(mesh)]).collect()
}

fn lights() -> Vec<AnyLight<'static>> {
    let place = Vec3::new(0.2, 0.4, 0.1);
    vec![
        AnyLight::Point(Point::new(place, Rgb::splat(0.1)).unwrap()),
        AnyLight::Spot(Spot::new(place, Vec3::new(0.3, -1.0, 0.2), Rgb::splat(0.2), 0.2, 0.6).unwrap()),
        AnyLight::Directional(Directional::new(Vec3::new(0.2, -0.3, 1.0), Rgb::splat(0.5)).unwrap()),
        AnyLight::DistantDisk(DistantDisk::new(Vec3::new(0.3, 0.4, -1.0), 0.1, Rgb::splat(20.0)).unwrap()),
        AnyLight::Constant(Constant::new(Rgb::splat(0.2)).unwrap()),
    ]
}
