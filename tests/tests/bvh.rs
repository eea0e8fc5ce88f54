//! The tree against a loop over everything, and what it refuses.

use halflight::build::{Tree, build_tree};
use halflight::bvh::{Bvh, BvhError, Child, MAX_LEAF, Node};
use halflight::geom::{Aabb, PreparedRay, Ray};
use halflight::glam::Vec3;
use halflight::shape::{AnyShape, Rectangle, Shape, Sphere, Triangle};
use halflight_tests::random::Uniforms;
use halflight_tests::shapes::{brute_force, random_shape};

/// A tree with the shapes in its order.
struct Forest {
    tree: Tree,
    shapes: Vec<AnyShape>,
}

impl Forest {
    fn new(shapes: &[AnyShape]) -> Self {
        let boxes: Vec<Aabb> = shapes.iter().map(Shape::bounds).collect();
        let tree = build_tree(&boxes).unwrap();
        let mut named = tree.order.clone();
        named.sort_unstable();
        assert!(named.into_iter().eq(0..shapes.len() as u32), "each primitive is in the tree once");
        let shapes = tree.order.iter().map(|&i| shapes[i as usize]).collect();
        Self { tree, shapes }
    }

    fn closest(&self, ray: &PreparedRay, t_max: f32) -> Option<f32> {
        let bvh = Bvh::new(&self.tree.nodes, self.shapes.len()).unwrap();
        bvh.closest_hit(ray, t_max, |i, t| self.shapes[i as usize].intersect(ray, t).map(|h| (h.t, h.t)))
    }

    fn any(&self, ray: &PreparedRay, t_max: f32) -> bool {
        let bvh = Bvh::new(&self.tree.nodes, self.shapes.len()).unwrap();
        bvh.any_hit(ray, t_max, |i| self.shapes[i as usize].intersect(ray, t_max).is_some())
    }

    #[track_caller]
    fn agrees(&self, origin: Vec3, direction: Vec3, t_max: f32) {
        let ray = PreparedRay::new(Ray::new(origin, direction));
        let truth = brute_force(&self.shapes, &ray, t_max).map(|(t, _)| t);
        assert_eq!(self.closest(&ray, t_max), truth, "{origin} {direction} {t_max}");
        assert_eq!(self.any(&ray, t_max), truth.is_some(), "{origin} {direction} {t_max}");
    }
}

/// Rays of every kind through a cube of half-edge `spread`.
fn compare(forest: &Forest, spread: f32, rays: usize) {
    let mut random = Uniforms::new(91);
    let axes = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    for i in 0..rays {
        let origin = random.in_cube() * (2.0 * spread);
        let direction = match i % 4 {
            0 => axes[random.below(6)],
            1 => {
                // In an axis-aligned plane, with a zero of either sign.
                let d = random.direction();
                Vec3::new(d.x, if random.one() < 0.5 { 0.0 } else { -0.0 }, d.z).normalize()
            }
            _ => random.direction(),
        };
        let t_max = if i % 3 == 0 { spread * random.one() * 3.0 } else { f32::INFINITY };
        forest.agrees(origin, direction, t_max);
    }
}

#[test]
fn agrees_with_a_loop_over_random_scenes() {
    let mut random = Uniforms::new(92);
    for count in [1, 2, 3, 4, 5, 17, 200, 3000] {
        for size in [0.02, 0.3] {
            let shapes: Vec<_> = (0..count).map(|_| random_shape(&mut random, 1.0, size)).collect();
            compare(&Forest::new(&shapes), 1.0, if count > 1000 { 1000 } else { 4000 });
        }
    }
}

#[test]
fn agrees_where_one_shape_is_huge_or_all_are_the_same() {
    let mut random = Uniforms::new(93);
    let mut shapes: Vec<_> = (0..100).map(|_| random_shape(&mut random, 1.0, 0.1)).collect();
    shapes.push(AnyShape::Sphere(Sphere::new(Vec3::Y * -1e6, 1e6).unwrap()));
    compare(&Forest::new(&shapes), 1.0, 10_000);
    compare(&Forest::new(&[shapes[3]; 200]), 1.0, 2_000);
}

#[test]
pub(crate) fn agrees_along_the_faces_of_flat_boxes() {
    // A grid of axis-aligned rectangles: boxes without thickness, and rays in their planes.
    let mut shapes = Vec::new();
    for i in 0..6 {
        for j in 0..6 {
            let at = Vec3::new(i as f32, 0.25 * (i + j) as f32, j as f32);
            shapes.push(AnyShape::Rectangle(Rectangle::new(at, Vec3::X * 0.5, Vec3::Z * 0.5).unwrap()));
            shapes.push(AnyShape::Rectangle(Rectangle::new(at, Vec3::X * 0.5, Vec3::Y * 0.5).unwrap()));
        }
    }
    let forest = Forest::new(&shapes);
    let mut random = Uniforms::new(94);
    for _ in 0..20_000 {
        // On the planes, edges and corners of the boxes, to the last bit.
        let on_grid = |random: &mut Uniforms| (random.below(13) as f32) * 0.5 - 0.5;
        let origin = Vec3::new(on_grid(&mut random), on_grid(&mut random) * 0.5, on_grid(&mut random));
        for direction in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.6, -0.0, -0.8)] {
            forest.agrees(origin, direction, f32::INFINITY);
            forest.agrees(origin, -direction, f32::INFINITY);
        }
    }
}

#[test]
fn nothing_meets_nothing() {
    let forest = Forest::new(&[]);
    let ray = PreparedRay::new(Ray::new(Vec3::ZERO, Vec3::X));
    assert!(forest.closest(&ray, f32::INFINITY).is_none() && !forest.any(&ray, f32::INFINITY));
    assert!(Bvh::new(&[], 0).unwrap().bounds().is_empty());
}

#[test]
pub(crate) fn rays_that_are_not_numbers_meet_nothing() {
    let mut random = Uniforms::new(95);
    let shapes: Vec<_> = (0..100).map(|_| random_shape(&mut random, 1.0, 0.5)).collect();
    let forest = Forest::new(&shapes);
    for (origin, direction) in [
        (Vec3::NAN, Vec3::X),
        (Vec3::ZERO, Vec3::NAN),
        (Vec3::ZERO, Vec3::ZERO),
        (Vec3::INFINITY, Vec3::X),
        (Vec3::new(0.0, f32::NAN, 0.0), Vec3::X),
    ] {
        let ray = PreparedRay::new(Ray::new(origin, direction));
        assert!(forest.closest(&ray, f32::INFINITY).is_none() && !forest.any(&ray, f32::INFINITY));
    }
}

#[test]
pub(crate) fn a_chain_of_ever_smaller_shapes_still_builds() {
    // Each twice as far and as large as the last: clustering makes a chain of such.
    let shapes: Vec<_> = (0..120)
        .map(|i| {
            let k = 2.0_f32.powi(i / 2 - 30);
            let at = Vec3::new(k, if i % 2 == 0 { k } else { -k }, 0.0);
            AnyShape::Sphere(Sphere::new(at, 0.3 * k).unwrap())
        })
        .collect();
    let forest = Forest::new(&shapes);
    let mut random = Uniforms::new(96);
    for _ in 0..2_000 {
        let target = shapes[random.below(shapes.len())].bounds().centre();
        forest.agrees(Vec3::ZERO, target.normalize(), f32::INFINITY);
    }
}

/// What a tree may not be.
pub(crate) mod is_refused {
    use super::*;

    const BOX: Aabb = Aabb { min: Vec3::NEG_ONE, max: Vec3::ONE };

    fn node(children: &[Child]) -> Node {
        children.iter().enumerate().fold(Node::EMPTY, |n, (slot, &child)| n.with_child(slot, child, BOX))
    }

    fn leaf(first: u32, count: u32) -> Child {
        Child::Leaf { first, count }
    }

    #[track_caller]
    fn refused(nodes: &[Node], primitives: usize, why: fn(&BvhError) -> bool) {
        let error = Bvh::new(nodes, primitives).expect_err("a bad tree");
        assert!(why(&error), "{error:?}");
        assert!(!error.to_string().is_empty());
    }

    #[test]
    fn a_cycle() {
        let to_itself = [node(&[Child::Node(0)])];
        refused(&to_itself, 0, |e| matches!(e, BvhError::Shared { .. }));
        let to_each_other = [node(&[Child::Node(1)]), node(&[Child::Node(0)])];
        refused(&to_each_other, 0, |e| matches!(e, BvhError::Shared { .. }));
        let wide = [node(&[Child::Node(0); 4])];
        refused(&wide, 0, |e| matches!(e, BvhError::Shared { .. } | BvhError::TooDeep { .. }));
    }

    #[test]
    fn a_shared_node() {
        let nodes = [node(&[Child::Node(1), Child::Node(1)]), node(&[leaf(0, 1)])];
        refused(&nodes, 1, |e| matches!(e, BvhError::Shared { .. }));
    }

    #[test]
    fn a_node_that_nothing_leads_to() {
        refused(&[node(&[leaf(0, 1)]), Node::EMPTY], 1, |e| {
            matches!(e, BvhError::Unreachable { reached: 1 })
        });
    }

    #[test]
    fn a_child_that_does_not_exist() {
        refused(&[node(&[Child::Node(1)])], 0, |e| matches!(e, BvhError::NodeOutOfRange { node: 0 }));
        refused(&[node(&[leaf(0, 2)])], 1, |e| matches!(e, BvhError::LeafOutOfRange { node: 0 }));
        refused(&[node(&[leaf(1, 1)])], 1, |e| matches!(e, BvhError::LeafOutOfRange { node: 0 }));
        refused(&[node(&[leaf(0, 0)])], 1, |e| matches!(e, BvhError::LeafOutOfRange { node: 0 }));
    }

    #[test]
    fn a_bound_that_is_not_a_number() {
        for bad in [Aabb { min: Vec3::NAN, ..BOX }, Aabb { max: Vec3::new(1.0, f32::NAN, 1.0), ..BOX }] {
            let nodes = [Node::EMPTY.with_child(2, leaf(0, 1), bad)];
            refused(&nodes, 1, |e| matches!(e, BvhError::NotANumber { node: 0 }));
        }
    }

    /// Four-wide chains: each level leaves three children waiting.
    /// A tree whose worst ray needs `entries` stack entries: at each level the way down, in a slot of
    /// its own, and up to three nodes that wait beside it.
    fn deep(entries: usize, down: usize) -> Vec<Node> {
        let mut nodes = vec![Node::EMPTY];
        let (mut at, mut left) = (0, entries);
        while left > 0 {
            let beside = left.min(3);
            let mut slots = [Child::Empty; 4];
            for slot in (0..4).filter(|&slot| slot != down).take(beside) {
                slots[slot] = Child::Node(nodes.len() as u32);
                nodes.push(node(&[leaf(0, 1)]));
            }
            slots[down] = Child::Node(nodes.len() as u32);
            nodes[at] = node(&slots);
            at = nodes.len();
            nodes.push(node(&[leaf(0, 1)]));
            left -= beside;
        }
        nodes
    }

    #[test]
    pub(crate) fn one_that_is_too_deep_for_the_stack_and_no_other() {
        let most = halflight::bvh::STACK;
        for down in 0..4 {
            for entries in [1, most - 1, most] {
                let nodes = deep(entries, down);
                let bvh = Bvh::new(&nodes, 1).unwrap();
                assert_eq!(bvh.stack_needed(), entries);
                // A ray that enters everything and meets nothing visits each leaf once.
                let ray = PreparedRay::new(Ray::new(Vec3::NEG_Z * 3.0, Vec3::Z));
                let (mut any, mut closest) = (0, 0);
                assert!(!bvh.any_hit(&ray, f32::INFINITY, |_| {
                    any += 1;
                    false
                }));
                let found = bvh.closest_hit(&ray, f32::INFINITY, |_, _| {
                    closest += 1;
                    None::<(f32, ())>
                });
                assert_eq!((any, closest, found), (entries + 1, entries + 1, None));
            }
            refused(&deep(most + 1, down), 1, |e| matches!(e, BvhError::TooDeep { .. }));
        }
    }

    #[test]
    fn a_tree_deeper_than_the_stack_that_a_program_asks_for() {
        for down in 0..4 {
            assert_eq!(Bvh::<8>::with_stack(&deep(8, down), 1).unwrap().stack_needed(), 8);
            let refused = Bvh::<8>::with_stack(&deep(9, down), 1).unwrap_err();
            assert!(matches!(refused, BvhError::TooDeep { needed: 9, available: 8 }), "{refused}");
            assert!(Bvh::<100>::with_stack(&deep(100, down), 1).is_ok());
        }
    }

    #[test]
    fn a_box_that_is_not_a_number_by_the_builder() {
        let bad = Aabb { min: Vec3::NAN, max: Vec3::ONE };
        assert!(matches!(build_tree(&[BOX, bad]), Err(BvhError::NotANumber { .. })));
    }

    #[test]
    fn the_largest_leaf_is_not() {
        assert!(Bvh::new(&[node(&[leaf(0, MAX_LEAF as u32)])], MAX_LEAF).is_ok());
    }
}

/// Random bits as trees: refused, or a query over them ends.
#[test]
fn no_tree_that_is_accepted_loops_or_panics() {
    let mut random = Uniforms::new(97);
    let mut accepted = 0;
    for _ in 0..200_000 {
        let count = 1 + random.below(4);
        let nodes: Vec<Node> = (0..count)
            .map(|_| {
                (0..4).fold(Node::EMPTY, |node, slot| {
                    let child = match random.below(4) {
                        0 => Child::Node(random.below(count + 1) as u32),
                        1 => Child::Leaf { first: random.below(3) as u32, count: random.below(3) as u32 },
                        _ => Child::Empty,
                    };
                    let (a, b) = (random.in_cube(), random.in_cube());
                    node.with_child(slot, child, Aabb { min: a.min(b), max: a.max(b) })
                })
            })
            .collect();
        let Ok(bvh) = Bvh::new(&nodes, 3) else { continue };
        accepted += 1;
        let ray = PreparedRay::new(Ray::new(random.in_cube() * 2.0, random.direction()));
        let mut visits = 0;
        bvh.any_hit(&ray, f32::INFINITY, |primitive| {
            assert!(primitive < 3);
            visits += 1;
            false
        });
        assert!(visits <= 4 * count * MAX_LEAF);
    }
    assert!(accepted > 1_000, "{accepted}");
}

/// A large flat mesh, on whose shared edges no ray may be lost.
#[test]
pub(crate) fn no_ray_is_lost_at_the_edges_of_a_mesh() {
    let n = 40;
    let at = |i: usize, j: usize| Vec3::new(i as f32, 0.1 * ((i * 7 + j * 13) % 5) as f32, j as f32);
    let mut shapes = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            shapes.push(AnyShape::Triangle(Triangle::new(a, c, b).unwrap()));
            shapes.push(AnyShape::Triangle(Triangle::new(a, d, c).unwrap()));
        }
    }
    let forest = Forest::new(&shapes);
    let mut random = Uniforms::new(98);
    for _ in 0..100_000 {
        let target = at(1 + random.below(n - 1), 1 + random.below(n - 1));
        let origin = target + Vec3::new(random.between(-3.0, 3.0), 5.0, random.between(-3.0, 3.0));
        let direction = (target - origin).normalize();
        let ray = PreparedRay::new(Ray::new(origin, direction));
        assert!(forest.closest(&ray, f32::INFINITY).is_some(), "{origin} {direction}");
    }
}
