//! Probabilities and the weights made of them.

use super::METHODS;
use halflight::Rgb;
use halflight::build::LightTreeBuffers;
use halflight::choose::{LightChoice, PowerTable};
use halflight::estimate::{Direct, Heuristic, Technique};
use halflight::geom::Ray;
use halflight::glam::Vec3;
use halflight::light::{AnyLight, Constant, Emitter, Point, Receiver};
use halflight::num::{ONE_MINUS_EPSILON, unit_f32};
use halflight::sequence::{Dimension, Random, Sequence, Sobol};
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Sphere, SurfacePoint, Triangle};
use halflight_tests::scenes::{Stage, seen, seen_at_origin};
use halflight_tests::{Verdict, ensure};

const WHITE: usize = 1;
const GLOSSY: usize = 2;
const SAMPLES: u32 = 1 << 15;

/// Facing down, `a` by `a`.
fn panel(centre: Vec3, a: f32) -> AnyShape {
    AnyShape::Rectangle(Rectangle::new(centre, Vec3::X * (0.5 * a), Vec3::Z * (0.5 * a)).unwrap())
}

/// Squares of densities leave the range of `f32`: NaN at 1e20, or energy lost to a silent 0.
#[test]
fn row_21_weights_of_huge_and_tiny_densities_add_up_to_one() {
    for h in [Heuristic::Balance, Heuristic::Power] {
        for a in [1e-38_f32, 1e-23, 1.0, 1e20, 1e38, f32::INFINITY] {
            for b in [1e-38_f32, 1e-23, 1.0, 1e20, 1e38, f32::INFINITY] {
                let sum = h.weight(a, b) + h.weight(b, a);
                assert!((sum - 1.0).abs() < 1e-6, "{h:?} {a:e} {b:e}: {sum}");
            }
        }
        assert_eq!(h.weight(f32::INFINITY, f32::INFINITY), 0.5);
    }
}

/// 0/0 where neither technique draws: a NaN pixel instead of nothing.
#[test]
fn row_22_a_direction_that_is_never_drawn_contributes_nothing() {
    for h in [Heuristic::Balance, Heuristic::Power] {
        assert_eq!((h.weight(0.0, 0.0), h.weight(0.0, 1.0), h.weight(1.0, 0.0)), (0.0, 0.0, 1.0));
    }
    // A receiver that cannot see the light: no sample, and a queried density of plain 0.
    let from = Receiver { point: Vec3::Y * 2.0, normal: Vec3::Y };
    let AnyShape::Rectangle(shape) = panel(Vec3::ZERO, 1.0) else { unreachable!("panels are rectangles") };
    let light = super::light(shape);
    let at = SurfacePoint { point: Vec3::ZERO, error: Vec3::ZERO, normal: Vec3::NEG_Y };
    for method in METHODS {
        assert_eq!(light.pdf_solid_angle(&from, method, Vec3::NEG_Y, &at), 0.0);
        assert!(light.sample(&from, method, [0.5; 2]).is_none());
    }
}

/// A weight without the probability of the light's choice: energy that grows with the lights.
#[test]
fn row_23_many_parts_of_a_light_are_the_light() -> Verdict {
    let whole = Stage::floor(GLOSSY).lit(panel(Vec3::Y, 1.6), 3.0).build();
    let mut parts = Stage::floor(GLOSSY);
    for i in 0..64 {
        let (x, z) = ((i % 8) as f32 * 0.2 - 0.7, (i / 8) as f32 * 0.2 - 0.7);
        parts = parts.lit(panel(Vec3::new(x, 1.0, z), 0.2), 3.0);
    }
    let (parts, eye) = (parts.build(), Vec3::new(0.4, 0.8, 1.0));
    let reference = seen_at_origin(&whole, &Direct::default(), eye, 4 * SAMPLES);
    let power = parts.power_table().map(LightChoice::Power);
    let tree = LightChoice::Tree(parts.light_tree());
    for choice in [Some(LightChoice::Uniform), power, Some(tree)].into_iter().flatten() {
        for technique in
            [Technique::Light, Technique::Mis(Heuristic::Balance), Technique::Mis(Heuristic::Power)]
        {
            let direct = Direct { technique, choice, ..Direct::default() };
            let moments = seen_at_origin(&parts, &direct, eye, 2 * SAMPLES);
            moments.check_same(&format!("{technique:?} {choice:?}"), &reference, 1e-5)?;
        }
    }
    Ok(())
}

/// A share that rounds to 0: a weak light vanishes also where nothing else shines.
#[test]
fn row_24_every_light_that_emits_can_be_chosen() -> Verdict {
    let powers = [1e-30_f32, 1.0, 0.0, 1e-9, 1e6, 3e-7, 1e-20];
    let mut table = [0.0; 7];
    assert!(PowerTable::fill(&mut table, |i| powers[i]));
    let table = PowerTable::new(&table).unwrap();
    for (i, power) in powers.iter().enumerate() {
        assert_eq!(table.pmf(i) > 0.0, *power > 0.0, "{power:e} has the share {:e}", table.pmf(i));
    }
    assert_eq!((0..7).map(|i| f64::from(table.pmf(i))).sum::<f64>(), 1.0);
    // A candle at the receiver, and lamps behind a wall: all that is seen is the candle.
    let candle = AnyShape::Sphere(Sphere::new(Vec3::Y * 0.5, 0.05).unwrap());
    let buffers = Stage::floor(WHITE)
        .lit(candle, 1.0)
        .with(panel(Vec3::Y * 2.0, 15.0), 0)
        .lit(panel(Vec3::Y * 3.0, 2.0), 10.0)
        .build();
    let power = buffers.power_table().map(LightChoice::Power).expect("light");
    let eye = Vec3::new(0.4, 0.8, 1.0);
    let all = seen_at_origin(&buffers, &Direct::default(), eye, SAMPLES);
    ensure!(all.mean() > 0.0, "the candle is dark");
    for choice in [power, LightChoice::Tree(buffers.light_tree())] {
        let chosen = Direct { choice, ..Direct::default() };
        seen_at_origin(&buffers, &chosen, eye, 1 << 20).check_same("one candle", &all, 1e-5)?;
    }
    Ok(())
}

/// Metres compared with square metres: the choice of light changes with the unit of the scene.
#[test]
fn row_25_the_choice_of_light_does_not_know_the_unit() {
    let shares = |k: f32| {
        let buffers = Stage::floor(WHITE)
            .lit(panel(Vec3::Y * k, k), 2.0)
            .lit(AnyShape::Sphere(Sphere::new(Vec3::X * k, 0.3 * k).unwrap()), 1.0)
            .lit(AnyShape::Disk(Disk::new(Vec3::Y * (2.0 * k), Vec3::X * k, Vec3::Z * k).unwrap()), 0.1)
            .build();
        let (table, tree) = (buffers.power_table().expect("light"), buffers.light_tree());
        let from = Receiver { point: Vec3::splat(0.1 * k), normal: Vec3::Y };
        ([0, 1, 2].map(|i| table.pmf(i)), [0, 1, 2].map(|i| tree.pmf(&from, i)))
    };
    let (by_power, by_tree) = shares(1.0);
    // The nodes of a tree keep 8 bits of an intensity.
    for k in [1e-3, 0.1, 10.0, 1e3] {
        let (power, tree) = shares(k);
        for (share, unscaled) in tree.into_iter().zip(by_tree) {
            assert!((share / unscaled - 1.0).abs() < 0.02, "{share} times {k}, {unscaled} otherwise");
        }
        for (share, unscaled) in power.into_iter().zip(by_power) {
            assert!((share / unscaled - 1.0).abs() < 1e-5, "{share} times {k}, {unscaled} otherwise");
        }
    }
}

/// A uniform of exactly 1: one past the end of a table, the logarithm of 0.
#[test]
fn row_26_no_uniform_is_one() {
    assert_eq!((unit_f32(u32::MAX), unit_f32(0)), (ONE_MINUS_EPSILON, 0.0));
    // Nor what is left of one on the way through a tree.
    let lamp = |x: u8| AnyLight::Point(Point::new(Vec3::Y * f32::from(x), Rgb::WHITE).unwrap());
    let buffers = LightTreeBuffers::new(&(1..=200).map(lamp).collect::<Vec<_>>());
    let (tree, from) = (buffers.tree().unwrap(), Receiver { point: Vec3::ZERO, normal: Vec3::Y });
    for u in [0.0, f32::MIN_POSITIVE, 0.5, ONE_MINUS_EPSILON] {
        assert!(
            tree.choose(&from, u, || ONE_MINUS_EPSILON).is_some_and(|(light, pmf)| light < 200 && pmf > 0.0)
        );
    }
    // All that the upper 24 bits can be.
    assert!((0..1_u32 << 24).all(|bits| (0.0..1.0).contains(&unit_f32(bits << 8 | 0xff))));
    let mut sequences = (Sobol::new(3), Random::<rand_pcg::Pcg32>::new(3));
    for i in 0..1 << 20 {
        sequences.0.start(i % 97, i);
        sequences.1.start(i % 97, i);
        for dimension in [Dimension::Film, Dimension::Light(0), Dimension::Bsdf] {
            let [[a, b], [c, d]] = [sequences.0.point(dimension, 0, 1), sequences.1.point(dimension, 0, 1)];
            let choices = [sequences.0.choice(dimension, 0, 1), sequences.1.choice(dimension, 0, 1)];
            assert!([a, b, c, d].into_iter().chain(choices).all(|u| (0.0..1.0).contains(&u)));
        }
    }
}

/// A table without weight, or whose rounding leaves a rest: a division by 0, or a dead light drawn.
#[test]
fn row_27_tables_add_up_and_never_draw_a_weight_of_zero() {
    assert!(!PowerTable::fill(&mut [0.0; 3], |_| 0.0));
    let dark = AnyLight::Point(Point::new(Vec3::Y, Rgb::BLACK).unwrap());
    let lamp = AnyLight::Point(Point::new(Vec3::Y, Rgb::splat(1e-30)).unwrap());
    let buffers = LightTreeBuffers::new(&[dark, lamp, dark]);
    let (tree, from) = (buffers.tree().unwrap(), Receiver { point: Vec3::ZERO, normal: Vec3::Y });
    assert_eq!([0, 1, 2].map(|i| tree.pmf(&from, i)), [0.0, 1.0, 0.0]);
    assert_eq!(LightTreeBuffers::new(&[dark]).tree().unwrap().choose(&from, 0.5, || 0.5), None);
    // Thirds, and sums that round, with nothing at both ends and between.
    for count in [5_usize, 100, 4097] {
        let power = |i: usize| if i.is_multiple_of(2) { 0.0 } else { 1.0 + (i % 7) as f32 / 3.0 };
        let mut table = vec![0.0; count];
        assert!(PowerTable::fill(&mut table, power));
        let table = PowerTable::new(&table).unwrap();
        let total: f64 = (0..count).map(|i| f64::from(table.pmf(i))).sum();
        assert_eq!(total, 1.0);
        assert!((0..count).all(|i| (table.pmf(i) > 0.0) == (power(i) > 0.0)));
    }
}

/// A density forgotten by one light or one material: a picture that depends on how it was sampled.
#[test]
fn row_28_every_light_on_every_material_by_every_technique() -> Verdict {
    let (a, b, c) = (Vec3::new(-0.4, 1.2, 0.3), Vec3::new(0.5, 1.0, 0.2), Vec3::new(0.1, 1.4, -0.7));
    let ball = Sphere::new(Vec3::new(0.3, 1.1, 0.2), 0.3).unwrap();
    let tube = Cylinder::new(Vec3::new(-0.4, 1.0, 0.2), Vec3::new(0.8, 0.3, -0.1), 0.2).unwrap();
    let disk = Disk::new(Vec3::Y, Vec3::X * 0.5, Vec3::Z * 0.3).unwrap();
    let shapes = [
        panel(Vec3::new(0.2, 1.0, -0.1), 0.8),
        AnyShape::Disk(disk),
        AnyShape::Sphere(ball),
        AnyShape::Triangle(Triangle::new(a, b, c).unwrap()),
        AnyShape::Cylinder(tube),
    ];
    for material in [WHITE, GLOSSY] {
        let lit = shapes.iter().map(|&s| Stage::floor(material).lit(s, 2.0));
        let sky = Constant::new(Rgb::WHITE).unwrap();
        for stage in lit.chain([Stage::floor(material).lit_by(AnyLight::Constant(sky))]) {
            let (buffers, eye) = (stage.build(), Vec3::new(0.3, 0.9, 0.5).normalize());
            let ray = Ray::new(eye * 5e-4, -eye);
            let by_hemisphere = Direct { technique: Technique::Bsdf, ..Direct::default() };
            let reference = seen(&buffers, &by_hemisphere, &ray, 8 * SAMPLES);
            for surface in METHODS {
                for technique in [Technique::Light, Technique::Mis(Heuristic::Power)] {
                    let direct = Direct { technique, surface, ..Direct::default() };
                    let moments = seen(&buffers, &direct, &ray, SAMPLES);
                    moments.check_same(&format!("{technique:?} {surface:?}"), &reference, 1e-5)?;
                }
            }
        }
    }
    Ok(())
}
