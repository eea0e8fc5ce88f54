//! Any lights as a tree, and any nodes: refused, or each choice ends with the probability that it says.
#![no_main]

use halflight::build::LightTreeBuffers;
use halflight::choose::{LightNode, LightTree};
use halflight::light::{AnyLight, AreaLight, Directional, Emitter, Point, Spot};
use halflight::shape::{Rectangle, Sphere};
use halflight_fuzz::Numbers;
use libfuzzer_sys::fuzz_target;

/// One light, if the numbers make one.
fn light(n: &mut Numbers) -> Option<AnyLight<'static>> {
    let kind = n.byte();
    let two_sided = kind & 128 != 0;
    Some(match kind % 5 {
        0 => AnyLight::Point(Point::new(n.vector(), n.colour()).ok()?),
        1 => AnyLight::Spot(Spot::new(n.vector(), n.vector(), n.colour(), n.number(), n.number()).ok()?),
        2 => AnyLight::Directional(Directional::new(n.vector(), n.colour()).ok()?),
        3 => {
            let light = AreaLight::new(Sphere::new(n.vector(), n.number()).ok()?, n.colour()).ok()?;
            AnyLight::Sphere(if two_sided { light.two_sided() } else { light })
        }
        _ => {
            let shape = Rectangle::new(n.vector(), n.vector(), n.vector()).ok()?;
            let light = AreaLight::new(shape, n.colour()).ok()?;
            AnyLight::Rectangle(if two_sided { light.two_sided() } else { light })
        }
    })
}

/// Choices at any place.
fn choose(tree: &LightTree<'_>, lights: usize, n: &mut Numbers) {
    for _ in 0..4 {
        let (from, [u, more]) = (n.receiver(), n.uniforms());
        if let Some((light, pmf)) = tree.choose(&from, u, || more) {
            assert!(light < lights && pmf > 0.0 && pmf <= 1.0, "{pmf} for {light} at {from:?}");
            assert_eq!(pmf.to_bits(), tree.pmf(&from, light).to_bits(), "light {light} at {from:?}");
        }
    }
}

fuzz_target!(|data: &[u8]| {
    let mut n = Numbers::new(data);
    let lights: Vec<_> = (0..n.byte() % 32).filter_map(|_| light(&mut n)).collect();
    let buffers = LightTreeBuffers::new(&lights);
    choose(&buffers.tree().expect("what was built is a tree"), lights.len(), &mut n);
    // The same lights under links that mean nothing.
    let nodes: Vec<LightNode> = lights
        .iter()
        .filter_map(|light| Some(LightNode::new(&light.bounds()?, u32::from(n.byte() % 16))))
        .collect();
    let leaves: Vec<u32> = nodes.iter().map(|_| u32::from(n.byte() % 16)).collect();
    if let Ok(tree) = LightTree::new(&nodes, &leaves, &[]) {
        choose(&tree, leaves.len(), &mut n);
    }
});
