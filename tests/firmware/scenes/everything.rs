// The scene "everything": 46 surfaces, 12 lights, 8 materials.
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
pub type Light = AnyLight<'static>;
/// What surfaces are made of here.
pub type Material = TwoSided<AnyBsdf>;
/// The scene.
pub type Baked = Scene<'static, AnyShape, Light, Material>;

/// The tree over the surfaces.
pub static NODES: [Node; 12] = [
    Node::EMPTY
        .with_child(0, Child::Node(1), Aabb { min: Vec3::new(0.26500002, 0.0, 0.0), max: Vec3::new(0.55600005, 0.5488, 0.55920005) })
        .with_child(1, Child::Leaf { first: 0, count: 2 }, Aabb { min: Vec3::new(0.0, 0.0, 0.55920005), max: Vec3::new(0.55600005, 0.5488, 0.55920005) })
        .with_child(2, Child::Leaf { first: 2, count: 2 }, Aabb { min: Vec3::new(0.0, 0.5488, 0.0), max: Vec3::new(0.55600005, 0.5488, 0.55920005) })
        .with_child(3, Child::Node(2), Aabb { min: Vec3::new(0.0, 0.0, 0.0), max: Vec3::new(0.5528, 0.5488, 0.55920005) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 42, count: 2 }, Aabb { min: Vec3::new(0.5496, 0.0, 0.0), max: Vec3::new(0.55600005, 0.5488, 0.55920005) })
        .with_child(1, Child::Leaf { first: 44, count: 2 }, Aabb { min: Vec3::new(0.26500002, 0.33, 0.24700001), max: Vec3::new(0.47200003, 0.33, 0.45600003) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 4, count: 2 }, Aabb { min: Vec3::new(0.0, 0.0, 0.0), max: Vec3::new(0.0, 0.5488, 0.55920005) })
        .with_child(1, Child::Leaf { first: 6, count: 2 }, Aabb { min: Vec3::new(0.0, 0.0, 0.0), max: Vec3::new(0.5528, 0.0, 0.55920005) })
        .with_child(2, Child::Node(3), Aabb { min: Vec3::new(0.21299987, 0.0, 0.06999994), max: Vec3::new(0.48000023, 0.54860026, 0.45600003) })
        .with_child(3, Child::Node(4), Aabb { min: Vec3::new(0.06999994, 0.0, 0.065000005), max: Vec3::new(0.29000002, 0.42000002, 0.272) }),
    Node::EMPTY
        .with_child(0, Child::Node(8), Aabb { min: Vec3::new(0.26500002, 0.0, 0.24700001), max: Vec3::new(0.47200003, 0.33, 0.45600003) })
        .with_child(1, Child::Leaf { first: 25, count: 1 }, Aabb { min: Vec3::new(0.21299987, 0.5485998, 0.22699983), max: Vec3::new(0.34300017, 0.54860026, 0.33200017) })
        .with_child(2, Child::Node(9), Aabb { min: Vec3::new(0.26500002, 0.0, 0.09999996), max: Vec3::new(0.43000022, 0.33, 0.296) })
        .with_child(3, Child::Node(10), Aabb { min: Vec3::new(0.3, 0.2899998, 0.06999994), max: Vec3::new(0.48000023, 0.37, 0.13000005) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 8, count: 1 }, Aabb { min: Vec3::new(0.1, 0.32, 0.1), max: Vec3::new(0.2, 0.42000002, 0.1) })
        .with_child(1, Child::Node(5), Aabb { min: Vec3::new(0.082, 0.0, 0.065000005), max: Vec3::new(0.29000002, 0.165, 0.272) })
        .with_child(2, Child::Node(6), Aabb { min: Vec3::new(0.06999994, 0.0, 0.065000005), max: Vec3::new(0.29000002, 0.2737141, 0.13000005) })
        .with_child(3, Child::Leaf { first: 9, count: 2 }, Aabb { min: Vec3::new(0.082, 0.0, 0.065000005), max: Vec3::new(0.13000001, 0.165, 0.22500001) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 17, count: 2 }, Aabb { min: Vec3::new(0.082, 0.165, 0.065000005), max: Vec3::new(0.29000002, 0.165, 0.272) })
        .with_child(1, Child::Leaf { first: 19, count: 2 }, Aabb { min: Vec3::new(0.082, 0.0, 0.065000005), max: Vec3::new(0.29000002, 0.0, 0.272) })
        .with_child(2, Child::Leaf { first: 21, count: 2 }, Aabb { min: Vec3::new(0.082, 0.0, 0.22500001), max: Vec3::new(0.24000001, 0.165, 0.272) })
        .with_child(3, Child::Leaf { first: 23, count: 2 }, Aabb { min: Vec3::new(0.24000001, 0.0, 0.11400001), max: Vec3::new(0.29000002, 0.165, 0.272) }),
    Node::EMPTY
        .with_child(0, Child::Node(7), Aabb { min: Vec3::new(0.09071516, 0.21628593, 0.08999994), max: Vec3::new(0.2292849, 0.2737141, 0.11000007) })
        .with_child(1, Child::Leaf { first: 11, count: 2 }, Aabb { min: Vec3::new(0.13000001, 0.0, 0.065000005), max: Vec3::new(0.29000002, 0.165, 0.11400001) })
        .with_child(2, Child::Leaf { first: 13, count: 1 }, Aabb { min: Vec3::new(0.1699999, 0.08999992, 0.06999994), max: Vec3::new(0.23000011, 0.15000007, 0.13000005) })
        .with_child(3, Child::Leaf { first: 14, count: 1 }, Aabb { min: Vec3::new(0.06999994, 0.08999992, 0.06999994), max: Vec3::new(0.13000005, 0.15000007, 0.13000005) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 15, count: 1 }, Aabb { min: Vec3::new(0.1907151, 0.21628593, 0.08999994), max: Vec3::new(0.2292849, 0.2737141, 0.11000007) })
        .with_child(1, Child::Leaf { first: 16, count: 1 }, Aabb { min: Vec3::new(0.09071516, 0.21628593, 0.08999994), max: Vec3::new(0.12928484, 0.2737141, 0.11000007) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 34, count: 2 }, Aabb { min: Vec3::new(0.314, 0.0, 0.40600002), max: Vec3::new(0.47200003, 0.33, 0.45600003) })
        .with_child(1, Child::Leaf { first: 36, count: 2 }, Aabb { min: Vec3::new(0.26500002, 0.0, 0.24700001), max: Vec3::new(0.47200003, 0.0, 0.45600003) })
        .with_child(2, Child::Leaf { first: 38, count: 2 }, Aabb { min: Vec3::new(0.26500002, 0.0, 0.296), max: Vec3::new(0.314, 0.33, 0.45600003) })
        .with_child(3, Child::Leaf { first: 40, count: 2 }, Aabb { min: Vec3::new(0.423, 0.0, 0.24700001), max: Vec3::new(0.47200003, 0.33, 0.40600002) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 28, count: 2 }, Aabb { min: Vec3::new(0.26500002, 0.0, 0.24700001), max: Vec3::new(0.423, 0.33, 0.296) })
        .with_child(1, Child::Leaf { first: 30, count: 1 }, Aabb { min: Vec3::new(0.3799998, 0.18999988, 0.09999996), max: Vec3::new(0.42000023, 0.25000012, 0.100000046) })
        .with_child(2, Child::Node(11), Aabb { min: Vec3::new(0.26999986, 0.09999993, 0.09999996), max: Vec3::new(0.43000022, 0.14000006, 0.100000046) })
        .with_child(3, Child::Leaf { first: 31, count: 1 }, Aabb { min: Vec3::new(0.27999985, 0.18999988, 0.09999996), max: Vec3::new(0.32000017, 0.25000012, 0.100000046) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 26, count: 1 }, Aabb { min: Vec3::new(0.41999975, 0.2899998, 0.06999994), max: Vec3::new(0.48000023, 0.35000017, 0.13000005) })
        .with_child(1, Child::Leaf { first: 27, count: 1 }, Aabb { min: Vec3::new(0.3, 0.32, 0.1), max: Vec3::new(0.35, 0.37, 0.1) }),
    Node::EMPTY
        .with_child(0, Child::Leaf { first: 32, count: 1 }, Aabb { min: Vec3::new(0.3699998, 0.09999993, 0.09999996), max: Vec3::new(0.43000022, 0.14000006, 0.100000046) })
        .with_child(1, Child::Leaf { first: 33, count: 1 }, Aabb { min: Vec3::new(0.26999986, 0.09999993, 0.09999996), max: Vec3::new(0.33000016, 0.14000006, 0.100000046) }),
];

/// What rays meet.
pub static SURFACES: [Surface<AnyShape>; 46] = [
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.5496, 0.0, 0.55920005), Vec3::new(0.0, 0.5488, 0.55920005), Vec3::new(0.55600005, 0.5488, 0.55920005)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.5496, 0.0, 0.55920005), Vec3::new(0.0, 0.0, 0.55920005), Vec3::new(0.0, 0.5488, 0.55920005)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.55600005, 0.5488, 0.0), Vec3::new(0.0, 0.5488, 0.55920005), Vec3::new(0.0, 0.5488, 0.0)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.55600005, 0.5488, 0.0), Vec3::new(0.55600005, 0.5488, 0.55920005), Vec3::new(0.0, 0.5488, 0.55920005)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.0, 0.0, 0.55920005), Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.5488, 0.0)])), material: 1, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.0, 0.0, 0.55920005), Vec3::new(0.0, 0.5488, 0.0), Vec3::new(0.0, 0.5488, 0.55920005)])), material: 1, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.5528, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.55920005)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.5528, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.55920005), Vec3::new(0.5496, 0.0, 0.55920005)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.1, 0.32, 0.1), Vec3::new(0.1, 0.42000002, 0.1), Vec3::new(0.2, 0.32, 0.1)])), material: 6, light: 9, normals: 0, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.13000001, 0.0, 0.065000005), Vec3::new(0.082, 0.165, 0.22500001), Vec3::new(0.13000001, 0.165, 0.065000005)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.13000001, 0.0, 0.065000005), Vec3::new(0.082, 0.0, 0.22500001), Vec3::new(0.082, 0.165, 0.22500001)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.29000002, 0.0, 0.11400001), Vec3::new(0.13000001, 0.165, 0.065000005), Vec3::new(0.29000002, 0.165, 0.11400001)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.29000002, 0.0, 0.11400001), Vec3::new(0.13000001, 0.0, 0.065000005), Vec3::new(0.13000001, 0.165, 0.065000005)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Sphere(Sphere::baked(Vec3::new(0.2, 0.12, 0.1), 0.03)), material: 5, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Sphere(Sphere::baked(Vec3::new(0.1, 0.12, 0.1), 0.03)), material: 4, light: 4, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Cylinder(Cylinder::baked(Vec3::new(0.2, 0.22, 0.1), Vec3::new(0.02, 0.05, 0.0), 0.01)), material: 5, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Cylinder(Cylinder::baked(Vec3::new(0.1, 0.22, 0.1), Vec3::new(0.02, 0.05, 0.0), 0.01)), material: 4, light: 6, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.13000001, 0.165, 0.065000005), Vec3::new(0.24000001, 0.165, 0.272), Vec3::new(0.29000002, 0.165, 0.11400001)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.13000001, 0.165, 0.065000005), Vec3::new(0.082, 0.165, 0.22500001), Vec3::new(0.24000001, 0.165, 0.272)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.29000002, 0.0, 0.11400001), Vec3::new(0.24000001, 0.0, 0.272), Vec3::new(0.082, 0.0, 0.22500001)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.29000002, 0.0, 0.11400001), Vec3::new(0.082, 0.0, 0.22500001), Vec3::new(0.13000001, 0.0, 0.065000005)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.082, 0.0, 0.22500001), Vec3::new(0.24000001, 0.165, 0.272), Vec3::new(0.082, 0.165, 0.22500001)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.082, 0.0, 0.22500001), Vec3::new(0.24000001, 0.0, 0.272), Vec3::new(0.24000001, 0.165, 0.272)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.24000001, 0.0, 0.272), Vec3::new(0.29000002, 0.165, 0.11400001), Vec3::new(0.24000001, 0.165, 0.272)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.24000001, 0.0, 0.272), Vec3::new(0.29000002, 0.0, 0.11400001), Vec3::new(0.29000002, 0.165, 0.11400001)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Rectangle(Rectangle::baked(Vec3::new(0.27800003, 0.5486, 0.2795), Vec3::new(0.065000005, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.052500002))), material: 3, light: 3, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Sphere(Sphere::baked(Vec3::new(0.45, 0.32, 0.1), 0.03).flipped()), material: 5, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.3, 0.32, 0.1), Vec3::new(0.3, 0.37, 0.1), Vec3::new(0.35, 0.32, 0.1)])), material: 4, light: 8, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.423, 0.0, 0.24700001), Vec3::new(0.26500002, 0.33, 0.296), Vec3::new(0.423, 0.33, 0.24700001)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.423, 0.0, 0.24700001), Vec3::new(0.26500002, 0.0, 0.296), Vec3::new(0.26500002, 0.33, 0.296)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Rectangle(Rectangle::baked(Vec3::new(0.4, 0.22, 0.1), Vec3::new(0.02, 0.0, 0.0), Vec3::new(0.0, 0.03, 0.0))), material: 7, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Rectangle(Rectangle::baked(Vec3::new(0.3, 0.22, 0.1), Vec3::new(0.02, 0.0, 0.0), Vec3::new(0.0, 0.03, 0.0))), material: 6, light: 7, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Disk(Disk::baked(Vec3::new(0.4, 0.12, 0.1), Vec3::new(0.03, 0.0, 0.0), Vec3::new(0.0, 0.02, 0.0))), material: 7, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Disk(Disk::baked(Vec3::new(0.3, 0.12, 0.1), Vec3::new(0.03, 0.0, 0.0), Vec3::new(0.0, 0.02, 0.0))), material: 6, light: 5, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.314, 0.0, 0.45600003), Vec3::new(0.47200003, 0.33, 0.40600002), Vec3::new(0.314, 0.33, 0.45600003)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.314, 0.0, 0.45600003), Vec3::new(0.47200003, 0.0, 0.40600002), Vec3::new(0.47200003, 0.33, 0.40600002)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.47200003, 0.0, 0.40600002), Vec3::new(0.314, 0.0, 0.45600003), Vec3::new(0.26500002, 0.0, 0.296)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.47200003, 0.0, 0.40600002), Vec3::new(0.26500002, 0.0, 0.296), Vec3::new(0.423, 0.0, 0.24700001)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.26500002, 0.0, 0.296), Vec3::new(0.314, 0.0, 0.45600003), Vec3::new(0.314, 0.33, 0.45600003)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.26500002, 0.0, 0.296), Vec3::new(0.314, 0.33, 0.45600003), Vec3::new(0.26500002, 0.33, 0.296)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.47200003, 0.0, 0.40600002), Vec3::new(0.423, 0.33, 0.24700001), Vec3::new(0.47200003, 0.33, 0.40600002)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.47200003, 0.0, 0.40600002), Vec3::new(0.423, 0.0, 0.24700001), Vec3::new(0.423, 0.33, 0.24700001)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.5528, 0.0, 0.0), Vec3::new(0.55600005, 0.5488, 0.55920005), Vec3::new(0.55600005, 0.5488, 0.0)])), material: 2, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.5528, 0.0, 0.0), Vec3::new(0.5496, 0.0, 0.55920005), Vec3::new(0.55600005, 0.5488, 0.55920005)])), material: 2, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.423, 0.33, 0.24700001), Vec3::new(0.314, 0.33, 0.45600003), Vec3::new(0.47200003, 0.33, 0.40600002)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
    Surface { shape: AnyShape::Triangle(Triangle::baked([Vec3::new(0.423, 0.33, 0.24700001), Vec3::new(0.26500002, 0.33, 0.296), Vec3::new(0.314, 0.33, 0.45600003)])), material: 0, light: NONE, normals: NONE, uvs: NONE },
];

/// Shading normals of triangles.
pub static NORMALS: [CornerNormals; 1] = [
    CornerNormals([Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.0, 0.6, -0.8), Vec3::new(0.6, 0.0, -0.8)]),
];

/// Texture coordinates of triangles.
pub static UVS: [CornerUvs; 0] = [];

/// Texture coordinates of other shapes.
pub static OBJECT_SPACES: [ObjectSpace; 0] = [];

/// The lights; those around the scene come last.
pub static LIGHTS: [Light; 12] = [
    AnyLight::Point(Point::baked(Vec3::new(0.2, 0.4, 0.1), Rgb::new(0.1, 0.1, 0.1))),
    AnyLight::Spot(Spot::baked(Vec3::new(0.2, 0.4, 0.1), Vec3::new(0.28221625, -0.94072086, 0.18814416), Rgb::new(0.2, 0.2, 0.2), 0.2, 0.6)),
    AnyLight::Directional(Directional::baked(Vec3::new(0.18814416, -0.28221625, 0.94072086), Rgb::new(0.5, 0.5, 0.5))),
    AnyLight::Rectangle(AreaLight::baked(Rectangle::baked(Vec3::new(0.27800003, 0.5486, 0.2795), Vec3::new(0.065000005, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.052500002)), Rgb::new(62.0, 54.0, 42.0), Sides::Front)),
    AnyLight::Sphere(AreaLight::baked(Sphere::baked(Vec3::new(0.1, 0.12, 0.1), 0.03), Rgb::new(5.0, 4.0, 3.0), Sides::Both)),
    AnyLight::Disk(AreaLight::baked(Disk::baked(Vec3::new(0.3, 0.12, 0.1), Vec3::new(0.03, 0.0, 0.0), Vec3::new(0.0, 0.02, 0.0)), Rgb::new(5.0, 6.0, 3.0), Sides::Front)),
    AnyLight::Cylinder(AreaLight::baked(Cylinder::baked(Vec3::new(0.1, 0.22, 0.1), Vec3::new(0.02, 0.05, 0.0), 0.01), Rgb::new(5.0, 8.0, 3.0), Sides::Front)),
    AnyLight::Rectangle(AreaLight::baked(Rectangle::baked(Vec3::new(0.3, 0.22, 0.1), Vec3::new(0.02, 0.0, 0.0), Vec3::new(0.0, 0.03, 0.0)), Rgb::new(5.0, 10.0, 3.0), Sides::Front)),
    AnyLight::Triangle(AreaLight::baked(Triangle::baked([Vec3::new(0.3, 0.32, 0.1), Vec3::new(0.3, 0.37, 0.1), Vec3::new(0.35, 0.32, 0.1)]), Rgb::new(5.0, 12.0, 3.0), Sides::Front)),
    AnyLight::Triangle(AreaLight::baked(Triangle::baked([Vec3::new(0.1, 0.32, 0.1), Vec3::new(0.1, 0.42000002, 0.1), Vec3::new(0.2, 0.32, 0.1)]), Rgb::new(5.0, 14.0, 3.0), Sides::Front)),
    AnyLight::DistantDisk(DistantDisk::baked(Vec3::new(0.26832816, 0.3577709, -0.8944272), 0.009966712, Rgb::new(20.0, 20.0, 20.0))),
    AnyLight::Constant(Constant::baked(Rgb::new(0.2, 0.2, 0.2))),
];

/// What surfaces are made of.
pub static MATERIALS: [Material; 8] = [
    TwoSided::both(AnyBsdf::Lambert(Lambert::baked(Rgb::new(0.74, 0.742, 0.734)))),
    TwoSided::both(AnyBsdf::Lambert(Lambert::baked(Rgb::new(0.159, 0.366, 0.087)))),
    TwoSided::both(AnyBsdf::Lambert(Lambert::baked(Rgb::new(0.571, 0.043, 0.044)))),
    TwoSided::both(AnyBsdf::Lambert(Lambert::baked(Rgb::new(0.0, 0.0, 0.0)))),
    TwoSided { front: AnyBsdf::Phong(Phong::baked(Rgb::new(0.3, 0.3, 0.3), Rgb::new(0.5, 0.4, 0.3), 20.0, 0.57142866)), back: Some(AnyBsdf::Lambert(Lambert::baked(Rgb::new(0.1, 0.7, 0.3)))) },
    TwoSided::both(AnyBsdf::GgxConductor(GgxConductor::baked(Rgb::new(1.0, 1.0, 1.0), [0.2, 0.4], Some((Rgb::new(0.2, 0.92, 1.1), Rgb::new(3.9, 2.45, 2.14)))))),
    TwoSided { front: AnyBsdf::RoughPlastic(RoughPlastic::baked([0.6, 0.2, 0.1, 1.0, 1.0, 1.0, 0.1, 1.5, 1.0, 0.12690005, 0.031804428, 0.014973403, 0.5518439, 0.040000003, 0.7692308, 0.1, 1.3797296, 0.57188797, -0.12566687, 0.21457033, -0.06963266, -1.1715865, 12.338036, -30.894037, 15.233644, 23.467793, -19.118814])), back: Some(AnyBsdf::MetallicRoughness(MetallicRoughness::baked(Rgb::new(0.7, 0.5, 0.2), 0.4, 0.3))) },
    TwoSided::both(AnyBsdf::Lambert(Lambert::baked(Rgb::new(0.1, 0.7, 0.3)))),
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

/// Cumulative shares of the lights in all power.
pub static POWER: [f32; 12] = [
    0.18396091,
    0.20186007,
    0.25492263,
    0.5855464,
    0.62715733,
    0.63120294,
    0.63950217,
    0.64612484,
    0.6499573,
    0.6668204,
    0.73327875,
    1.0,
];

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
pub const FILM: Film = match Film::new(16, 12, Filter::Box { radius: 0.5 }) {
    Ok(film) => film,
    Err(_) => panic!("not a film"),
};
