// The scene "cornell under a sky": 34 surfaces, 1 light, 4 materials.
// Written by halflight; to change it, change the scene and write it again.

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

/// What emits here.
pub type Light = Constant;
/// What surfaces are made of here.
pub type Material = TwoSided<Lambert>;
/// The scene.
pub type Baked = Scene<'static, Triangle, Light, Material>;

/// The tree over the surfaces.
pub static NODES: [Node; 8] = [
    Node::EMPTY
        .with_child(0, Child::Node(1), Aabb { min: Vec3::new(0.26500002, 0.0, 0.0), max: Vec3::new(0.55600005, 0.5488, 0.55920005) })
        .with_child(1, Child::Leaf { first: 0, count: 2 }, Aabb { min: Vec3::new(0.0, 0.0, 0.55920005), max: Vec3::new(0.55600005, 0.5488, 0.55920005) })
        .with_child(2, Child::Leaf { first: 2, count: 2 }, Aabb { min: Vec3::new(0.0, 0.5488, 0.0), max: Vec3::new(0.55600005, 0.5488, 0.55920005) })
        .with_child(3, Child::Node(2), Aabb { min: Vec3::new(0.0, 0.0, 0.0), max: Vec3::new(0.5528, 0.5488, 0.55920005) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 30, count: 2 }, Aabb { min: Vec3::new(0.5496, 0.0, 0.0), max: Vec3::new(0.55600005, 0.5488, 0.55920005) })
        .with_child(1, Child::Leaf { first: 32, count: 2 }, Aabb { min: Vec3::new(0.26500002, 0.33, 0.24700001), max: Vec3::new(0.47200003, 0.33, 0.45600003) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 4, count: 2 }, Aabb { min: Vec3::new(0.0, 0.0, 0.0), max: Vec3::new(0.0, 0.5488, 0.55920005) })
        .with_child(1, Child::Node(3), Aabb { min: Vec3::new(0.26500002, 0.0, 0.24700001), max: Vec3::new(0.47200003, 0.33, 0.45600003) })
        .with_child(2, Child::Leaf { first: 6, count: 2 }, Aabb { min: Vec3::new(0.0, 0.0, 0.0), max: Vec3::new(0.5528, 0.0, 0.55920005) })
        .with_child(3, Child::Node(4), Aabb { min: Vec3::new(0.082, 0.0, 0.065000005), max: Vec3::new(0.29000002, 0.165, 0.272) }),
    Node::EMPTY
        .with_child(0, Child::Node(7), Aabb { min: Vec3::new(0.314, 0.0, 0.24700001), max: Vec3::new(0.47200003, 0.33, 0.45600003) })
        .with_child(1, Child::Leaf { first: 20, count: 2 }, Aabb { min: Vec3::new(0.26500002, 0.0, 0.24700001), max: Vec3::new(0.423, 0.33, 0.296) })
        .with_child(2, Child::Leaf { first: 22, count: 2 }, Aabb { min: Vec3::new(0.26500002, 0.0, 0.24700001), max: Vec3::new(0.47200003, 0.0, 0.45600003) })
        .with_child(3, Child::Leaf { first: 24, count: 2 }, Aabb { min: Vec3::new(0.26500002, 0.0, 0.296), max: Vec3::new(0.314, 0.33, 0.45600003) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 8, count: 2 }, Aabb { min: Vec3::new(0.082, 0.165, 0.065000005), max: Vec3::new(0.29000002, 0.165, 0.272) })
        .with_child(1, Child::Node(5), Aabb { min: Vec3::new(0.082, 0.0, 0.065000005), max: Vec3::new(0.29000002, 0.165, 0.22500001) })
        .with_child(2, Child::Leaf { first: 10, count: 2 }, Aabb { min: Vec3::new(0.082, 0.0, 0.065000005), max: Vec3::new(0.29000002, 0.0, 0.272) })
        .with_child(3, Child::Node(6), Aabb { min: Vec3::new(0.082, 0.0, 0.11400001), max: Vec3::new(0.29000002, 0.165, 0.272) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 16, count: 2 }, Aabb { min: Vec3::new(0.082, 0.0, 0.065000005), max: Vec3::new(0.13000001, 0.165, 0.22500001) })
        .with_child(1, Child::Leaf { first: 18, count: 2 }, Aabb { min: Vec3::new(0.13000001, 0.0, 0.065000005), max: Vec3::new(0.29000002, 0.165, 0.11400001) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 12, count: 2 }, Aabb { min: Vec3::new(0.082, 0.0, 0.22500001), max: Vec3::new(0.24000001, 0.165, 0.272) })
        .with_child(1, Child::Leaf { first: 14, count: 2 }, Aabb { min: Vec3::new(0.24000001, 0.0, 0.11400001), max: Vec3::new(0.29000002, 0.165, 0.272) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 26, count: 2 }, Aabb { min: Vec3::new(0.314, 0.0, 0.40600002), max: Vec3::new(0.47200003, 0.33, 0.45600003) })
        .with_child(1, Child::Leaf { first: 28, count: 2 }, Aabb { min: Vec3::new(0.423, 0.0, 0.24700001), max: Vec3::new(0.47200003, 0.33, 0.40600002) }),
];

/// What rays meet.
pub static SURFACES: [Surface<Triangle>; 34] = [
    Surface { shape: Triangle::baked([Vec3::new(0.5496, 0.0, 0.55920005), Vec3::new(0.0, 0.5488, 0.55920005), Vec3::new(0.55600005, 0.5488, 0.55920005)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.5496, 0.0, 0.55920005), Vec3::new(0.0, 0.0, 0.55920005), Vec3::new(0.0, 0.5488, 0.55920005)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.55600005, 0.5488, 0.0), Vec3::new(0.0, 0.5488, 0.55920005), Vec3::new(0.0, 0.5488, 0.0)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.55600005, 0.5488, 0.0), Vec3::new(0.55600005, 0.5488, 0.55920005), Vec3::new(0.0, 0.5488, 0.55920005)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.0, 0.0, 0.55920005), Vec3::new(0.0, 0.5488, 0.0), Vec3::new(0.0, 0.5488, 0.55920005)]), material: 1, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.0, 0.0, 0.55920005), Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.5488, 0.0)]), material: 1, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.5528, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.55920005), Vec3::new(0.5496, 0.0, 0.55920005)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.5528, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.55920005)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.13000001, 0.165, 0.065000005), Vec3::new(0.24000001, 0.165, 0.272), Vec3::new(0.29000002, 0.165, 0.11400001)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.13000001, 0.165, 0.065000005), Vec3::new(0.082, 0.165, 0.22500001), Vec3::new(0.24000001, 0.165, 0.272)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.29000002, 0.0, 0.11400001), Vec3::new(0.24000001, 0.0, 0.272), Vec3::new(0.082, 0.0, 0.22500001)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.29000002, 0.0, 0.11400001), Vec3::new(0.082, 0.0, 0.22500001), Vec3::new(0.13000001, 0.0, 0.065000005)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.082, 0.0, 0.22500001), Vec3::new(0.24000001, 0.165, 0.272), Vec3::new(0.082, 0.165, 0.22500001)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.082, 0.0, 0.22500001), Vec3::new(0.24000001, 0.0, 0.272), Vec3::new(0.24000001, 0.165, 0.272)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.24000001, 0.0, 0.272), Vec3::new(0.29000002, 0.165, 0.11400001), Vec3::new(0.24000001, 0.165, 0.272)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.24000001, 0.0, 0.272), Vec3::new(0.29000002, 0.0, 0.11400001), Vec3::new(0.29000002, 0.165, 0.11400001)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.13000001, 0.0, 0.065000005), Vec3::new(0.082, 0.165, 0.22500001), Vec3::new(0.13000001, 0.165, 0.065000005)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.13000001, 0.0, 0.065000005), Vec3::new(0.082, 0.0, 0.22500001), Vec3::new(0.082, 0.165, 0.22500001)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.29000002, 0.0, 0.11400001), Vec3::new(0.13000001, 0.165, 0.065000005), Vec3::new(0.29000002, 0.165, 0.11400001)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.29000002, 0.0, 0.11400001), Vec3::new(0.13000001, 0.0, 0.065000005), Vec3::new(0.13000001, 0.165, 0.065000005)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.423, 0.0, 0.24700001), Vec3::new(0.26500002, 0.0, 0.296), Vec3::new(0.26500002, 0.33, 0.296)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.423, 0.0, 0.24700001), Vec3::new(0.26500002, 0.33, 0.296), Vec3::new(0.423, 0.33, 0.24700001)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.47200003, 0.0, 0.40600002), Vec3::new(0.314, 0.0, 0.45600003), Vec3::new(0.26500002, 0.0, 0.296)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.47200003, 0.0, 0.40600002), Vec3::new(0.26500002, 0.0, 0.296), Vec3::new(0.423, 0.0, 0.24700001)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.26500002, 0.0, 0.296), Vec3::new(0.314, 0.33, 0.45600003), Vec3::new(0.26500002, 0.33, 0.296)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.26500002, 0.0, 0.296), Vec3::new(0.314, 0.0, 0.45600003), Vec3::new(0.314, 0.33, 0.45600003)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.314, 0.0, 0.45600003), Vec3::new(0.47200003, 0.33, 0.40600002), Vec3::new(0.314, 0.33, 0.45600003)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.314, 0.0, 0.45600003), Vec3::new(0.47200003, 0.0, 0.40600002), Vec3::new(0.47200003, 0.33, 0.40600002)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.47200003, 0.0, 0.40600002), Vec3::new(0.423, 0.33, 0.24700001), Vec3::new(0.47200003, 0.33, 0.40600002)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.47200003, 0.0, 0.40600002), Vec3::new(0.423, 0.0, 0.24700001), Vec3::new(0.423, 0.33, 0.24700001)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.5528, 0.0, 0.0), Vec3::new(0.55600005, 0.5488, 0.55920005), Vec3::new(0.55600005, 0.5488, 0.0)]), material: 2, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.5528, 0.0, 0.0), Vec3::new(0.5496, 0.0, 0.55920005), Vec3::new(0.55600005, 0.5488, 0.55920005)]), material: 2, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.423, 0.33, 0.24700001), Vec3::new(0.314, 0.33, 0.45600003), Vec3::new(0.47200003, 0.33, 0.40600002)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: Triangle::baked([Vec3::new(0.423, 0.33, 0.24700001), Vec3::new(0.26500002, 0.33, 0.296), Vec3::new(0.314, 0.33, 0.45600003)]), material: 0, light: NONE, normals: NONE, uvs: NONE },
];

/// Shading normals of triangles.
pub static NORMALS: [CornerNormals; 0] = [];

/// Texture coordinates of triangles.
pub static UVS: [CornerUvs; 0] = [];

/// Texture coordinates of other shapes.
pub static OBJECT_SPACES: [ObjectSpace; 0] = [];

/// The lights; those around the scene come last.
pub static LIGHTS: [Light; 1] = [
    Constant::baked(Rgb::new(1.0, 1.25, 1.5)),
];

/// What surfaces are made of.
pub static MATERIALS: [Material; 4] = [
    TwoSided::both(Lambert::baked(Rgb::new(0.74, 0.742, 0.734))),
    TwoSided::both(Lambert::baked(Rgb::new(0.159, 0.366, 0.087))),
    TwoSided::both(Lambert::baked(Rgb::new(0.571, 0.043, 0.044))),
    TwoSided::both(Lambert::baked(Rgb::new(0.0, 0.0, 0.0))),
];

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

const VIEW: View = View { origin: Vec3::new(0.27800003, 0.273, -0.8), right: Vec3::new(-1.0, 0.0, 0.0), up: Vec3::new(0.0, 1.0, -0.0), forward: Vec3::new(0.0, 0.0, 1.0) };

/// The camera before anything is clipped away.
pub const UNCLIPPED: Camera = match Camera::perspective(VIEW, 0.3570676, 0.2678007) {
    Ok(camera) => camera,
    Err(_) => panic!("not a camera"),
};

/// What looks at the scene.
pub const CAMERA: Camera = match UNCLIPPED.with_clip(0.01, 10000.0) {
    Ok(camera) => camera,
    Err(_) => panic!("not a camera"),
};

/// The picture's raster.
pub const FILM: Film = match Film::new(64, 48, Filter::Box { radius: 0.5 }) {
    Ok(film) => film,
    Err(_) => panic!("not a film"),
};
