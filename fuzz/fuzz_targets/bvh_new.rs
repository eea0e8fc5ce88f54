//! Any bytes as a tree: refused, or every query over it ends.
#![no_main]

use halflight::bvh::{Bvh, Child, Node, WIDTH};
use halflight::geom::{Aabb, PreparedRay, Ray};
use halflight_fuzz::Numbers;
use libfuzzer_sys::fuzz_target;

/// One slot: empty, a leaf or a node, in range or not.
fn child(n: &mut Numbers) -> Child {
    match n.byte() % 4 {
        0 => Child::Empty,
        1 => Child::Leaf { first: n.word() % 9, count: u32::from(n.byte() % 17) },
        2 => Child::Node(u32::from(n.byte() % 8)),
        _ => Child::Node(n.word()),
    }
}

fn node(n: &mut Numbers) -> Node {
    (0..WIDTH).fold(Node::EMPTY, |node, slot| {
        let child = child(n);
        let (a, b) = (n.vector(), n.vector());
        let bounds = if n.flag() { Aabb { min: a, max: b } } else { Aabb { min: a.min(b), max: a.max(b) } };
        node.with_child(slot, child, bounds)
    })
}

fuzz_target!(|data: &[u8]| {
    let mut n = Numbers::new(data);
    let count = usize::from(n.byte() % 9);
    let nodes: Vec<Node> = (0..count).map(|_| node(&mut n)).collect();
    let primitives = usize::from(n.byte() % 24);
    let Ok(bvh) = Bvh::new(&nodes, primitives) else { return };
    for _ in 0..4 {
        let ray = PreparedRay::new(Ray::new(n.vector(), n.vector()));
        let (t_max, met) = (n.number(), n.number());
        // Each leaf is asked once, and a leaf has at most 15 primitives.
        let (mut asked, most) = (0, nodes.len() * WIDTH * 15);
        let closest = bvh.closest_hit(&ray, t_max, |primitive, t| {
            assert!((primitive as usize) < primitives);
            asked += 1;
            (met < t).then_some((met, primitive))
        });
        assert!(asked <= most && closest.is_none_or(|p| (p as usize) < primitives));
        let mut asked = 0;
        bvh.any_hit(&ray, t_max, |primitive| {
            assert!((primitive as usize) < primitives);
            asked += 1;
            false
        });
        assert!(asked <= most);
    }
});
