//! Choosing among many lights.

use halflight::Rgb;
use halflight::build::{LightTreeBuffers, SceneBuffers};
use halflight::choose::{LightChoice, LightNode, LightTree};
use halflight::estimate::{Direct, Heuristic, Technique};
use halflight::glam::Vec3;
use halflight::light::{
    AnyLight, AreaLight, Constant, Density, Directional, Emitter, Point, Receiver, Spot, SurfaceDensity,
};
use halflight::num::ONE_MINUS_EPSILON;
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Sphere, Triangle};
use halflight_tests::lights::receiver;
use halflight_tests::random::Uniforms;
use halflight_tests::scenes::{Stage, seen_at_origin};
use halflight_tests::statistics::{Moments, chi_square};
use halflight_tests::{Verdict, ensure};

/// Kinds of light that have a place.
const KINDS: usize = 8;

/// A light with a place, in the cube of `2 scale` or somewhat beyond.
fn placed(random: &mut Uniforms, kind: usize, size: f32, scale: f32) -> AnyLight<'static> {
    let (at, n) = (random.in_cube() * scale, random.direction());
    let (s, size) = (n.any_orthonormal_vector(), size * scale * random.between(0.1, 1.0));
    let t = n.cross(s);
    let radiance = Rgb::new(random.one(), random.one(), 0.1);
    // As bright at any scale.
    let intensity = radiance * (scale * scale);
    let two_sided = random.one() < 0.3;
    macro_rules! area {
        ($variant:ident, $shape:expr) => {{
            let light = AreaLight::new($shape.unwrap(), radiance).unwrap();
            AnyLight::$variant(if two_sided { light.two_sided() } else { light })
        }};
    }
    match kind {
        0 => area!(Rectangle, Rectangle::new(at, s * size, t * (0.3 * size))),
        1 => area!(Disk, Disk::new(at, s * size, t * size)),
        2 => area!(Triangle, Triangle::new(at, at + s * size, at + t * size)),
        3 => area!(Sphere, Sphere::new(at, size)),
        4 => area!(Sphere, Sphere::new(at, size).map(Sphere::flipped)),
        5 => area!(Cylinder, Cylinder::new(at, n * (3.0 * size), size)),
        6 => AnyLight::Point(Point::new(at, intensity).unwrap()),
        _ => {
            let cutoff = random.between(0.01, 3.1);
            let beam = cutoff * random.one();
            AnyLight::Spot(Spot::new(at, n, intensity, beam, cutoff).unwrap())
        }
    }
}

/// Lights of every kind.
fn lights(seed: u64, count: usize, size: f32, scale: f32) -> Vec<AnyLight<'static>> {
    let mut random = Uniforms::new(seed);
    (0..count).map(|i| placed(&mut random, i % KINDS, size, scale)).collect()
}

fn receivers(seed: u64, count: usize, scale: f32) -> Vec<Receiver> {
    let mut random = Uniforms::new(seed);
    (0..count).map(|_| receiver(random.in_cube() * scale, random.direction())).collect()
}

fn never() -> f32 {
    panic!("a second uniform for few lights")
}

/// What one sample of a light brings.
fn arriving(light: &AnyLight<'_>, from: &Receiver, u: [f32; 2]) -> f32 {
    light.sample(from, SurfaceDensity::Auto, u).map_or(0.0, |sample| {
        let incident = sample.incident.g * from.normal.dot(sample.wi).max(0.0);
        match sample.density {
            Density::Delta => incident,
            Density::SolidAngle(pdf) => incident / pdf,
        }
    })
}

#[test]
fn probabilities_add_up_to_one() {
    for count in [1, 2, 3, 4, 5, 17, 100, 1000] {
        let lights = lights(81, count, 0.1, 1.0);
        let buffers = LightTreeBuffers::new(&lights);
        let tree = buffers.tree().unwrap();
        for from in receivers(82, 50, 1.5) {
            let sum: f64 = (0..count).map(|i| f64::from(tree.pmf(&from, i))).sum();
            assert!((sum - 1.0).abs() < 1e-5, "{count} lights at {from:?}: {sum}");
        }
    }
}

#[test]
fn lights_are_chosen_as_often_as_their_probability_says() -> Verdict {
    const DRAWS: usize = 1 << 17;
    let lights = lights(83, 200, 0.2, 1.0);
    let buffers = LightTreeBuffers::new(&lights);
    let (tree, mut random) = (buffers.tree().unwrap(), Uniforms::new(84));
    for from in receivers(85, 4, 1.0) {
        let mut counts = vec![0_u64; lights.len()];
        for _ in 0..DRAWS {
            let [u, more] = random.two();
            let (light, pmf) = tree.choose(&from, u, || more).unwrap();
            ensure!(pmf.to_bits() == tree.pmf(&from, light).to_bits(), "{pmf} for light {light} at {from:?}");
            counts[light] += 1;
        }
        let expected: Vec<f64> =
            (0..lights.len()).map(|i| f64::from(tree.pmf(&from, i)) * DRAWS as f64).collect();
        chi_square("chosen lights", &counts, &expected, 0.0)?;
    }
    Ok(())
}

/// Bounds that promise too much: a light vanishes at some receivers.
#[test]
fn every_light_that_reaches_a_receiver_can_be_chosen() {
    let mut random = Uniforms::new(86);
    for (scale, size) in [(1.0, 0.01), (1.0, 0.3), (1e-6, 0.1), (1e6, 0.1), (1.0, 2.0)] {
        let lights = lights(87, 40 * KINDS, size, scale);
        let buffers = LightTreeBuffers::new(&lights);
        let tree = buffers.tree().unwrap();
        let mut reached = 0;
        for (i, light) in lights.iter().enumerate() {
            let near = light.bounds().unwrap().region;
            for k in 0..40 {
                // Anywhere, inside of the light's box, and with the light about the horizon.
                let inside = near.min + (near.max - near.min) * (random.in_cube() * 0.5 + 0.5);
                let point = if k % 4 == 0 { inside } else { random.in_cube() * (1.5 * scale) };
                let across = (near.centre() - point).cross(random.direction()).normalize_or(Vec3::Z);
                let normal = if k % 2 == 0 { random.direction() } else { across };
                let from = Receiver { point, normal };
                if (0..16).any(|_| arriving(light, &from, random.two()) > 0.0) {
                    reached += 1;
                    assert!(tree.pmf(&from, i) > 0.0, "light {i}, {light:?}, at {from:?}");
                }
            }
        }
        assert!(reached > 2000, "only {reached} times did a light reach its receiver");
    }
}

/// Metres compared with square metres: the choice changes with the unit of the scene.
#[test]
fn the_choice_does_not_know_the_unit() {
    let at = |scale: f32| {
        let lights = lights(88, 300, 0.05, scale);
        let buffers = LightTreeBuffers::new(&lights);
        let tree = buffers.tree().unwrap();
        let receivers = receivers(89, 20, scale);
        let all = receivers.iter().flat_map(|from| (0..300).map(move |i| tree.pmf(from, i)));
        all.collect::<Vec<_>>()
    };
    // A millionth and a million, as powers of two, by which nothing is rounded.
    let one = at(1.0);
    for scale in [1.0 / 1_048_576.0, 1_048_576.0] {
        for (a, b) in one.iter().zip(at(scale)) {
            assert!((a - b).abs() <= 1e-5 * a, "{a} and {b} at {scale}");
        }
    }
}

/// The irradiance of many lights by one sample of a chosen one, its probability times `k`.
fn irradiance(lights: &[AnyLight<'_>], tree: &LightTree<'_>, from: &Receiver, k: f32) -> Moments {
    let mut random = Uniforms::new(90);
    Moments::of((0..1 << 16).map(|_| {
        let [u, more] = random.two();
        let (light, pmf) = tree.choose(from, u, || more).expect("lights");
        f64::from(arriving(&lights[light], from, random.two()) / (k * pmf))
    }))
}

#[test]
fn one_chosen_light_stands_for_all() -> Verdict {
    let lights = lights(91, 100, 0.05, 1.0);
    let buffers = LightTreeBuffers::new(&lights);
    let (tree, mut random) = (buffers.tree().unwrap(), Uniforms::new(92));
    let from = receiver(Vec3::new(0.1, -1.5, 0.2), Vec3::Y);
    let all = lights.iter().map(|l| Moments::of((0..4096).map(|_| arriving(l, &from, random.two()).into())));
    let (truth, variance) = all.fold((0.0, 0.0), |(m, v), l| (m + l.mean(), v + l.standard_error().powi(2)));
    ensure!(variance.sqrt() < 1e-3 * truth, "the truth is known to {}", variance.sqrt() / truth);
    irradiance(&lights, &tree, &from, 1.0).check_mean("by choice", truth, 1e-3)?;
    // The test can fail.
    let wrong = irradiance(&lights, &tree, &from, 1.02).check_mean("2 % off", truth, 1e-3);
    ensure!(wrong.is_err(), "a probability that is 2 % too large goes unnoticed");
    Ok(())
}

/// Lamps over a floor, with a wall between some of them.
fn hall() -> SceneBuffers {
    let mut stage = Stage::floor(2);
    let mut random = Uniforms::new(93);
    for _ in 0..60 {
        let at = Vec3::new(random.between(-3.0, 3.0), random.between(0.4, 1.5), random.between(-3.0, 3.0));
        let ball = Sphere::new(at, random.between(0.02, 0.1)).unwrap();
        stage = stage.lit(AnyShape::Sphere(ball), random.between(1.0, 50.0));
    }
    let wall = Rectangle::new(Vec3::new(0.5, 0.5, 0.0), Vec3::Z * 0.5, Vec3::Y * 0.5).unwrap();
    stage = stage.with(AnyShape::Rectangle(wall), 1);
    let sun = Directional::new(Vec3::new(0.3, -1.0, 0.2), Rgb::splat(0.5)).unwrap();
    stage = stage.lit_by(AnyLight::Directional(sun));
    stage = stage.lit_by(AnyLight::Point(Point::new(Vec3::new(-0.7, 1.0, 0.4), Rgb::WHITE).unwrap()));
    stage.lit_by(AnyLight::Constant(Constant::new(Rgb::splat(0.2)).unwrap())).build()
}

#[test]
fn every_technique_agrees_with_sampling_all_lights() -> Verdict {
    let buffers = hall();
    let choice = LightChoice::Tree(buffers.light_tree());
    let eye = Vec3::new(0.4, 0.8, 1.0);
    let all = seen_at_origin(&buffers, &Direct::default(), eye, 1 << 13);
    let mis = [Heuristic::Balance, Heuristic::Power].map(Technique::Mis);
    for technique in [Technique::Light, Technique::Bsdf, mis[0], mis[1]] {
        for light_samples in [1, 3] {
            let direct = Direct { technique, choice, light_samples, ..Direct::default() };
            let chosen = seen_at_origin(&buffers, &direct, eye, (1 << 16) / light_samples);
            chosen.check_same(&format!("{technique:?}"), &all, 1e-5)?;
        }
    }
    Ok(())
}

/// A light without a place is sampled besides the chosen one; a dark one never is.
#[test]
fn lights_without_a_place_are_sampled_besides() {
    let sun = AnyLight::Directional(Directional::new(Vec3::NEG_Y, Rgb::WHITE).unwrap());
    let sky = AnyLight::Constant(Constant::new(Rgb::WHITE).unwrap());
    let dark = AnyLight::Point(Point::new(Vec3::Y, Rgb::BLACK).unwrap());
    let lamp = AnyLight::Point(Point::new(Vec3::Y, Rgb::WHITE).unwrap());
    let buffers = LightTreeBuffers::new(&[sun, dark, lamp, sky]);
    let (tree, from) = (buffers.tree().unwrap(), receiver(Vec3::ZERO, Vec3::Y));
    assert_eq!(tree.everywhere(), [0, 3]);
    assert_eq!([0, 1, 2, 3, 4].map(|i| tree.pmf(&from, i)), [1.0, 0.0, 1.0, 1.0, 0.0]);
    assert_eq!(tree.choose(&from, ONE_MINUS_EPSILON, never), Some((2, 1.0)));
    let none = LightTreeBuffers::new(&[sun, dark]);
    assert_eq!(none.tree().unwrap().choose(&from, 0.5, never), None);
}

/// Where all lights are the same, or ever farther away, and where the receiver is no place at all.
#[test]
fn odd_places_are_chosen_from_all_the_same() {
    let point = |at: Vec3| AnyLight::Point(Point::new(at, Rgb::WHITE).unwrap());
    let coincident: Vec<_> = (0..3000).map(|_| point(Vec3::ONE)).collect();
    let farther = (0..240).map(|i| point(Vec3::splat(2.0_f32.powf(i as f32 * 0.5 - 60.0)))).collect();
    let huge = [1e-38_f32, 1e-20, 1.0, 1e20, 3e38].map(|x| point(Vec3::new(x, -x, 0.0))).to_vec();
    for lights in [coincident, farther, huge] {
        let buffers = LightTreeBuffers::new(&lights);
        let tree = buffers.tree().unwrap();
        for at in [Vec3::ZERO, Vec3::ONE, Vec3::splat(1e30), Vec3::splat(1e-38), Vec3::NAN, Vec3::INFINITY] {
            let from = Receiver { point: at, normal: Vec3::Y };
            let sum: f64 = (0..lights.len()).map(|i| f64::from(tree.pmf(&from, i))).sum();
            assert!((sum - 1.0).abs() < 1e-4, "{sum} at {at}");
            for u in [0.0, 0.3, ONE_MINUS_EPSILON] {
                let (light, pmf) = tree.choose(&from, u, || u).unwrap();
                assert!(pmf > 0.0 && pmf == tree.pmf(&from, light), "{pmf} at {at}");
            }
        }
    }
}

/// Of a million lights even, each can be drawn: one uniform has not bits enough for that.
#[test]
fn many_lights_take_little_memory_and_a_second_uniform() {
    let count = 1 << 16;
    let lights = lights(94, count, 1e-3, 1.0);
    let buffers = LightTreeBuffers::new(&lights);
    assert_eq!(size_of::<LightNode>(), 28);
    assert!(buffers.bytes() <= 64 * count, "{} bytes a light", buffers.bytes() / count);
    let (tree, mut random, mut seconds) = (buffers.tree().unwrap(), Uniforms::new(95), 0);
    for from in receivers(96, 2000, 1.0) {
        let (u, more) = (random.one(), random.one());
        let (light, pmf) = tree
            .choose(&from, u, || {
                seconds += 1;
                more
            })
            .unwrap();
        assert_eq!(pmf, tree.pmf(&from, light));
    }
    assert!(seconds > 100, "{seconds}");
}

/// What it is for: the samples that 300 small lights take for a given error.
#[test]
fn the_tree_takes_a_twentieth_of_the_samples_of_a_uniform_choice() {
    let mut random = Uniforms::new(97);
    let lights: Vec<_> = (0..300)
        .map(|_| {
            let at =
                Vec3::new(random.between(-3.0, 3.0), random.between(0.5, 1.5), random.between(-3.0, 3.0));
            let (n, l) = ((random.direction() + Vec3::NEG_Y).normalize(), random.between(1.0, 50.0));
            let s = n.any_orthonormal_vector() * 0.03;
            let shape = Rectangle::new(at, s, n.cross(s)).unwrap();
            AnyLight::Rectangle(AreaLight::new(shape, Rgb::splat(l)).unwrap())
        })
        .collect();
    let buffers = LightTreeBuffers::new(&lights);
    let tree = buffers.tree().unwrap();
    let mut ratios: Vec<f64> = (0..200)
        .map(|_| {
            let point = Vec3::new(random.between(-3.0, 3.0), 0.0, random.between(-3.0, 3.0));
            let from = Receiver { point, normal: Vec3::Y };
            let (mut sum, mut uniform, mut by_tree) = (0.0, 0.0, 0.0);
            for (i, light) in lights.iter().enumerate() {
                let e = f64::from(light.unshadowed_irradiance(&from).unwrap().g);
                if e > 0.0 {
                    sum += e;
                    uniform += e * e * 300.0;
                    by_tree += e * e / f64::from(tree.pmf(&from, i));
                }
            }
            (uniform - sum * sum) / (by_tree - sum * sum)
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[100] > 20.0, "a median of {}, of {} at worst", ratios[100], ratios[0]);
}
