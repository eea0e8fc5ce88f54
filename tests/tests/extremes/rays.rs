//! Rays, boxes and trees.

use super::METHODS;
use crate::{bvh, shapes};
use halflight::bvh::{Bvh, Child, Node, STACK};
use halflight::choose::LightChoice;
use halflight::estimate::Direct;
use halflight::geom::{Aabb, PreparedRay, Ray, offset_origin};
use halflight::glam::Vec3;
use halflight::shape::{AnyShape, Rectangle, Shape, Sphere, SurfacePoint, Triangle};
use halflight_tests::random::Uniforms;
use halflight_tests::scenes::{Stage, seen};
use halflight_tests::shapes::{random_point, random_shape};
use halflight_tests::{Verdict, ensure};

/// One box as a tree of one leaf.
fn one_box(min: Vec3, max: Vec3) -> [Node; 1] {
    [Node::EMPTY.with_child(0, Child::Leaf { first: 0, count: 1 }, Aabb { min, max })]
}

/// Whether a ray enters the only box of a tree, asked of both queries.
#[track_caller]
fn enters(nodes: &[Node], origin: Vec3, direction: Vec3) -> bool {
    let tree = Bvh::new(nodes, 1).unwrap();
    let ray = PreparedRay::new(Ray::new(origin, direction));
    let any = tree.any_hit(&ray, f32::INFINITY, |_| true);
    let closest = tree.closest_hit(&ray, f32::INFINITY, |_, _| Some((1.0, ()))).is_some();
    assert_eq!(any, closest, "{origin} {direction}");
    any
}

/// 0 · ∞ in the slab test: a ray along the face of a box misses what is on the face.
#[test]
fn row_41_rays_in_the_faces_of_a_box_enter_it() {
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    for corner in [Vec3::ONE, Vec3::new(0.3, 1e3, 1e-6), Vec3::new(0.0, 2.0, 0.1)] {
        let nodes = one_box(-corner, corner);
        for (i, axis) in axes.into_iter().enumerate() {
            let other = axes[(i + 1) % 3];
            for side in [-1.0_f32, 1.0] {
                for along in [axis, -axis] {
                    let on_face = other * other.dot(corner) * side;
                    let on_edge = (corner - axis * axis.dot(corner)) * side;
                    for place in [on_face, on_edge] {
                        let origin = place - along * (along.abs().dot(corner) + 1.0);
                        assert!(enters(&nodes, origin, along), "{origin} {along} {corner}");
                    }
                }
            }
        }
    }
    bvh::agrees_along_the_faces_of_flat_boxes();
}

/// The reciprocal of a zero of either sign, or of a subnormal: the wrong octant, or an overflow.
#[test]
fn row_42_components_that_are_almost_zero_count_as_zero() {
    let mut random = Uniforms::new(141);
    for _ in 0..20_000 {
        let (a, b) = (random.in_cube(), random.in_cube());
        let nodes = one_box(a.min(b), a.max(b));
        let (origin, d) = (random.in_cube() * 2.0, random.direction());
        let zero = enters(&nodes, origin, Vec3::new(d.x, 0.0, d.z));
        for tiny in [-0.0, 1e-40, -1e-40, 1e-45, 1e-38, -1e-38, 1e-37, -1.5e-37] {
            assert_eq!(enters(&nodes, origin, Vec3::new(d.x, tiny, d.z)), zero, "{origin} {d} {tiny:e}");
        }
        let axial = enters(&nodes, origin, Vec3::X * d.x.signum());
        for tiny in [-0.0, 1e-40, -1e-39] {
            assert_eq!(
                enters(&nodes, origin, Vec3::new(d.x.signum(), tiny, -tiny)),
                axial,
                "{origin} {tiny:e}"
            );
        }
    }
}

/// Slabs that round apart: pinholes where two boxes meet.
#[test]
fn row_43_no_box_is_left_out_by_rounding() {
    let mut random = Uniforms::new(142);
    for i in 0..1_000_000_u32 {
        let scale = 10.0_f32.powi(i as i32 % 13 - 6);
        let triangle = |random: &mut Uniforms| [0; 3].map(|_| random.in_cube() * scale);
        let [a, b, c] = triangle(&mut random);
        let Ok(shape) = Triangle::new(a, b, c) else { continue };
        // Aimed at an edge or a corner, which are where its box ends.
        let target = if i % 2 == 0 { a } else { b + (c - b) * random.one() };
        let origin = target + random.direction() * (scale * 10.0_f32.powf(random.between(-1.0, 3.0)));
        let ray = PreparedRay::new(Ray::new(origin, (target - origin).normalize()));
        let Some(hit) = shape.intersect(&ray, f32::INFINITY) else { continue };
        let bounds = shape.bounds();
        let nodes = one_box(bounds.min, bounds.max);
        let tree = Bvh::new(&nodes, 1).unwrap();
        let found =
            tree.closest_hit(&ray, f32::INFINITY, |_, t| shape.intersect(&ray, t).map(|h| (h.t, h.t)));
        assert_eq!(found, Some(hit.t), "{shape:?} {ray:?}");
    }
    bvh::no_ray_is_lost_at_the_edges_of_a_mesh();
}

/// Edges tested by each triangle in its own way: light shines through closed meshes.
#[test]
fn row_44_closed_meshes_are_closed() {
    shapes::every_ray_from_inside_a_closed_mesh_meets_it();
}

/// A stack of fixed size and a tree of any depth: a panic, or geometry that is silently missing.
#[test]
fn row_45_trees_that_are_too_deep_are_refused_and_unlucky_scenes_are_built() {
    bvh::is_refused::one_that_is_too_deep_for_the_stack_and_no_other();
    bvh::a_chain_of_ever_smaller_shapes_still_builds();
    // Coincident centres, which no plane divides.
    let same: Vec<Aabb> =
        (1..3000).map(|i| Aabb { min: Vec3::splat(-(i as f32)), max: Vec3::splat(i as f32) }).collect();
    let tree = halflight::build::build_tree(&same).unwrap();
    assert!(Bvh::new(&tree.nodes, same.len()).unwrap().stack_needed() <= STACK);
}

/// A stack for any tree there is: slow where memory is scarce. A scene needs a fraction of it.
#[test]
fn row_46_the_stack_is_small_and_scenes_need_a_fraction_of_it() {
    const ENTRY: usize = 8;
    const { assert!(STACK * ENTRY <= 512, "a query takes more than half a KiB of stack") };
    let mut random = Uniforms::new(143);
    let boxes: Vec<Aabb> = (0..100_000).map(|_| random_shape(&mut random, 1.0, 0.01).bounds()).collect();
    let tree = halflight::build::build_tree(&boxes).unwrap();
    let needed = Bvh::new(&tree.nodes, boxes.len()).unwrap().stack_needed();
    assert!(needed <= STACK * 3 / 4, "{needed} entries for {} shapes", boxes.len());
}

/// A ray of NaN walks the whole tree, or for ever.
#[test]
fn row_47_rays_that_are_not_numbers_meet_nothing() {
    bvh::rays_that_are_not_numbers_meet_nothing();
    shapes::rays_that_are_not_numbers_meet_nothing();
}

/// A fixed offset: acne far from the origin, light under a lamp's foot near it.
#[test]
fn row_48_no_self_intersection_far_from_the_origin_and_contact_shadows_stay() {
    let mut random = Uniforms::new(144);
    // How far beside the point of contact there is a gap that the coordinates can hold.
    for (far, aside) in [(0.0_f32, 0.05), (1e3, 0.05), (1e5, 0.6)] {
        let gap = 1.0 - (1.0_f32 - aside * aside).sqrt();
        let centre = Vec3::new(0.6, -0.7, 0.8) * far;
        let ball = AnyShape::Sphere(Sphere::new(centre, 1.0).unwrap());
        let floor = Rectangle::new(centre - Vec3::Y, Vec3::X * 5.0, Vec3::NEG_Z * 5.0).unwrap();
        for _ in 0..20_000 {
            let at = random_point(&ball, &mut random);
            let d = random.direction();
            let out = if d.dot(at.normal) < 0.0 { -d } else { d };
            if out.dot(at.normal) > 1e-6 {
                let ray = Ray::new(offset_origin(at.point, at.error, at.normal, out), out);
                assert!(ball.intersect(&PreparedRay::new(ray), f32::INFINITY).is_none(), "{far}: {ray:?}");
            }
            let beside = Vec3::new(d.x, 0.0, d.z).normalize_or(Vec3::X) * aside;
            let foot = floor.point(beside.x / 5.0, beside.z / -5.0);
            let ray = Ray::new(offset_origin(foot.point, foot.error, foot.normal, Vec3::Y), Vec3::Y);
            let met = ball.intersect(&PreparedRay::new(ray), f32::INFINITY).map(|h| h.t);
            assert!(met.is_some_and(|t| t < 2.0 * gap), "{far}: the contact shadow is gone, {met:?}");
        }
    }
}

/// The end of a shadow ray on the light itself: lights that shadow themselves.
#[test]
fn row_49_nothing_shadows_a_light_in_an_empty_scene() {
    let mut random = Uniforms::new(145);
    for _ in 0..1_000 {
        let shape = random_shape(&mut random, 1.0, 0.5);
        let stage = Stage::empty().lit(shape, 1.0).build();
        let bound = stage.bind();
        let scene = bound.scene();
        for i in 0..64 {
            let at = random.direction() * 10.0_f32.powf(random.between(0.6, 4.0));
            let from = halflight::light::Receiver { point: at, normal: -at.normalize() };
            let light = &scene.lights()[0];
            use halflight::light::Emitter;
            let Some(sample) = light.sample(&from, METHODS[i % 4], random.two()) else { continue };
            let eye = SurfacePoint { point: at, error: Vec3::ZERO, normal: from.normal };
            // A tube has no closed form of what it hides: at its rim rounding decides.
            if !matches!(shape, AnyShape::Cylinder(_)) {
                assert!(
                    scene.light_visible(&eye, sample.wi, sample.distance, 0),
                    "{shape:?} hides itself: {sample:?}"
                );
            }
        }
    }
}

/// Lengths in the code: a scene in millimetres or in light years becomes another picture.
#[test]
fn row_51_the_unit_of_length_does_not_change_the_picture() -> Verdict {
    let stage = |k: f32| {
        let panel = Rectangle::new(Vec3::new(0.3, 2.0, -0.5) * k, Vec3::X * (0.5 * k), Vec3::Z * (0.4 * k));
        let mut stage = Stage::empty();
        let floor = Rectangle::new(Vec3::ZERO, Vec3::X * (20.0 * k), Vec3::NEG_Z * (20.0 * k)).unwrap();
        stage = stage.with(AnyShape::Rectangle(floor), 2);
        stage = stage.lit(AnyShape::Rectangle(panel.unwrap()), 4.0);
        stage =
            stage.lit(AnyShape::Sphere(Sphere::new(Vec3::new(-1.0, 1.5, -1.0) * k, 0.4 * k).unwrap()), 3.0);
        stage.with(AnyShape::Sphere(Sphere::new(Vec3::new(0.2, 0.9, -0.2) * k, 0.2 * k).unwrap()), 1).build()
    };
    let look = |k: f32, direct: &Direct<'_>| {
        let eye = Vec3::new(0.4, 0.8, 1.0).normalize();
        seen(&stage(k), direct, &Ray::new(eye * (0.1 * k), -eye), 4096).mean()
    };
    for surface in METHODS {
        for choice in [LightChoice::All, LightChoice::Uniform] {
            let direct = Direct { surface, choice, ..Direct::default() };
            // The same uniforms: the same picture to a few roundings, and at powers of two to the bit.
            let one = look(1.0, &direct);
            ensure!(one > 0.0, "the scene is dark");
            for k in [1e-6_f32, 1e-3, 1e3, 1e6] {
                let scaled = look(k, &direct);
                ensure!((scaled / one - 1.0).abs() < 1e-3, "{surface:?} at {k:e}: {scaled} instead of {one}");
            }
        }
    }
    Ok(())
}
