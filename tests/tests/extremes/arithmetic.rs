//! The arithmetic around it: sums, bases, narrow lobes, ranges, and the same bits everywhere.

use super::METHODS;
use halflight::Rgb;
use halflight::bsdf::{Bsdf, GgxConductor};
use halflight::estimate::{Direct, Heuristic, PixelStats};
use halflight::geom::{Frame, Ray};
use halflight::glam::Vec3;
use halflight::light::{AnyLight, Density, Directional, Emitter, SurfaceDensity};
use halflight::num;
use halflight::shape::{AnyShape, Rectangle, Sphere};
use halflight_tests::bsdfs::{COSINES, furnace, outgoing};
use halflight_tests::lights::receiver;
use halflight_tests::random::Uniforms;
use halflight_tests::scenes::{Stage, seen_at_origin};
use halflight_tests::{Verdict, ensure};

/// A sum in `f32`: it stands still at 2²⁴ equal samples.
#[test]
fn row_52_the_mean_of_many_samples_does_not_stall() {
    let mut pixel = PixelStats::NEW;
    (0..(1 << 24) + (1 << 20)).for_each(|_| pixel.add(Rgb::WHITE));
    assert_eq!(pixel.mean(), Rgb::WHITE);
    let (mut pixel, mut random, mut truth) = (PixelStats::NEW, Uniforms::new(151), 0.0_f64);
    for _ in 0..1 << 22 {
        let x = random.one();
        truth += f64::from(x);
        pixel.add(Rgb::splat(x));
    }
    let (mean, truth) = (f64::from(pixel.mean().g), truth / f64::from(1 << 22));
    // A fifth of its own standard error, 1.4e-4.
    assert!((mean - truth).abs() < 3e-5, "{mean} instead of {truth}");
}

/// `E[x²] − E[x]²`: below 0 for bright constant pixels, which then stop too early.
#[test]
fn row_53_the_variance_is_never_negative_and_0_for_a_constant() {
    for value in [1e-20_f32, 0.1, 1.0, 1e4, 1e15] {
        let mut pixel = PixelStats::NEW;
        (0..100_000).for_each(|_| pixel.add(Rgb::splat(value)));
        assert_eq!(pixel.variance(), Rgb::BLACK, "of {value}");
        // One unit in the last place, up and down.
        let mut random = Uniforms::new(152);
        for _ in 0..100_000 {
            pixel.add(Rgb::splat(if random.one() < 0.5 { value } else { value.next_up() }));
            assert!(pixel.variance().g >= 0.0, "{:?} around {value}", pixel.variance());
        }
    }
}

/// One NaN makes a pixel black or white for ever.
#[test]
fn row_54_a_sample_that_is_not_a_number_is_counted_and_left_out() {
    let mut pixel = PixelStats::NEW;
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -f32::NAN] {
        pixel.add(Rgb::new(1.0, 1.0, bad));
        pixel.add(Rgb::splat(0.5));
    }
    assert_eq!((pixel.mean(), pixel.count(), pixel.rejected()), (Rgb::splat(0.5), 4, 4));
}

/// `1 / (1 + n.z)` at the south pole: a basis of NaN on every ceiling.
#[test]
fn row_55_every_normal_has_an_orthonormal_basis() {
    let mut random = Uniforms::new(153);
    let special = [Vec3::Z, Vec3::NEG_Z, Vec3::new(0.0, -0.0, -1.0), Vec3::new(-0.0, 0.0, 1.0), Vec3::NEG_X];
    let almost_poles = (0..200_000).map(|i| {
        let slope = 10.0_f32.powi(-(i % 40)) * if i % 2 == 0 { 1.0 } else { -1.0 };
        let pole = if i % 3 == 0 { 1.0 } else { -1.0 };
        Vec3::new(slope, slope * 0.3, pole).normalize()
    });
    let anywhere = (0..1_000_000).map(|_| random.direction());
    for n in special.into_iter().chain(almost_poles).chain(anywhere) {
        let f = Frame::from_normal(n);
        let lengths = [f.s, f.t].map(|v| (v.length() - 1.0).abs());
        let angles = [f.s.dot(f.t), f.s.dot(n), f.t.dot(n)].map(f32::abs);
        assert!(lengths.into_iter().chain(angles).all(|e| e < 1e-6), "{n} {f:?}");
        assert!((f.s.cross(f.t) - n).length() < 2e-6, "{n} is left-handed");
    }
}

/// `1 + (α² − 1) cos²` for a smooth metal: mirrors that lose their light or turn to fireflies.
#[test]
fn row_56_smooth_metals_reflect_all_that_the_masking_leaves() {
    for alpha in [1e-4_f32, 1e-3, 1e-2, 0.1, 1.0] {
        let metal = GgxConductor::new(Rgb::WHITE, alpha).unwrap();
        let mut random = Uniforms::new(154);
        for cosine in COSINES {
            let wo = outgoing(cosine);
            let moments = furnace(&metal, wo);
            // A smooth one is a mirror: nothing is masked, facing or aside.
            let least = if alpha <= 1e-3 && cosine >= 0.1 { 0.995 } else { 0.2 };
            let most = 1.0 + 5.0 * moments.standard_error() + 1e-5;
            assert!((least..=most).contains(&moments.mean()), "α = {alpha}, {cosine}: {}", moments.mean());
            for _ in 0..20_000 {
                let Some(s) = metal.sample(wo, random.two(), 0.5) else { continue };
                // What one sample brings is the masking of the way in: at most all.
                let weight = metal.eval(wo, s.wi).g * s.wi.z / s.pdf_solid_angle;
                assert!((0.0..=1.0 + 1e-5).contains(&weight), "α = {alpha}, {cosine}: weight {weight}");
            }
        }
    }
}

/// The largest number as "infinitely far": its square overflows.
#[test]
fn row_57_lights_at_infinity_have_no_stand_in_for_a_distance() {
    let sun = Directional::new(Vec3::new(0.3, -1.0, 0.2), Rgb::WHITE).unwrap();
    let from = receiver(Vec3::new(1e30, -1e30, 1e20), Vec3::Y);
    let sample = sun.sample(&from, SurfaceDensity::Auto, [0.5; 2]).unwrap();
    assert_eq!(
        (sample.distance, sample.density, sample.incident),
        (f32::INFINITY, Density::Delta, Rgb::WHITE)
    );
    // It is seen past everything that is near, and hidden by what is a million lengths away.
    let lit = Stage::floor(1).lit_by(AnyLight::Directional(sun));
    let hidden = lit.clone().with(ball(-sun.direction() * 1e6, 1e3), 0);
    let eye = Vec3::new(0.3, 1.0, 0.1);
    let moments = seen_at_origin(&lit.build(), &Direct::default(), eye, 64);
    let truth = f64::from(sample.wi.y) * std::f64::consts::FRAC_1_PI;
    moments.check_mean("under the sun", truth, 1e-6).unwrap();
    assert_eq!(seen_at_origin(&hidden.build(), &Direct::default(), eye, 64).mean(), 0.0);
}

fn ball(centre: Vec3, radius: f32) -> AnyShape {
    AnyShape::Sphere(Sphere::new(centre, radius).unwrap())
}

/// The nearest number that hardware without subnormals would compute with.
fn flushed(v: Vec3) -> Vec3 {
    v.map(|x| if x.is_subnormal() { 0.0 } else { x })
}

/// Subnormals that some machines flush: a comparison with 0 decides otherwise there.
#[test]
fn row_59_subnormal_numbers_decide_nothing() -> Verdict {
    let mut random = Uniforms::new(155);
    let panel = Rectangle::new(Vec3::Y, Vec3::X * 0.5, Vec3::Z * 0.5).unwrap();
    let buffers = Stage::floor(1).lit(AnyShape::Rectangle(panel), 1.0).build();
    let bound = buffers.bind();
    let scene = bound.scene();
    for _ in 0..50_000 {
        let tiny = |random: &mut Uniforms| 1e-39 * random.between(-1.0, 1.0);
        let d = random.direction();
        let direction = Vec3::new(d.x, d.y, tiny(&mut random)).normalize();
        let origin = Vec3::new(random.between(-2.0, 2.0), 0.5, tiny(&mut random));
        let hit = |origin, direction| scene.closest_hit(&Ray::new(origin, direction), f32::INFINITY);
        let (with, without) = (hit(origin, direction), hit(flushed(origin), flushed(direction)));
        ensure!(with.map(|h| h.distance) == without.map(|h| h.distance), "{origin} {direction}");
        // A receiver with subnormal coordinates sees what one at 0 sees.
        let from = receiver(Vec3::new(tiny(&mut random), 0.0, 0.0), Vec3::new(0.0, 1.0, tiny(&mut random)));
        let plain = receiver(flushed(from.point), flushed(from.normal));
        let u = random.two();
        for method in METHODS {
            let (a, b) = [from, plain].map(|r| scene.lights()[0].sample(&r, method, u)).into();
            ensure!(a.is_some() == b.is_some(), "{method:?}: {a:?} {b:?}");
            let Some((a, b)) = a.zip(b) else { continue };
            ensure!((a.wi - b.wi).length() < 1e-6, "{method:?}: {a:?} {b:?}");
        }
    }
    for h in [Heuristic::Balance, Heuristic::Power] {
        ensure!((h.weight(1.0, 1e-40) - h.weight(1.0, 0.0)).abs() < 1e-6, "{h:?} knows a subnormal density");
    }
    Ok(())
}

/// A platform's own sine: pictures that differ between a desktop, a browser and a chip.
#[test]
fn row_60_the_functions_have_the_same_bits_everywhere() {
    let mut hash = 0x811c_9dc5_u32;
    let mut take = |x: f32| {
        for byte in x.to_bits().to_le_bytes() {
            hash = (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        }
    };
    for i in 0..20_000 {
        // Spread over the useful range, by integer arithmetic alone.
        let x = num::unit_f32(num::hash(i));
        let y = num::unit_f32(num::hash2(i, 1));
        let (sin, cos) = num::sin_cos(8.0 * x - 4.0);
        [sin, cos, num::atan2(y - 0.5, x - 0.5), num::acos(2.0 * x - 1.0), num::tan(x), num::sqrt(x)]
            .into_iter()
            .chain([num::pow(x, 8.0 * y), num::exp(8.0 * x - 4.0), num::exp_m1(x - 0.5)])
            .chain([num::ln(x + 1e-6), num::ln_1p(x)])
            .for_each(&mut take);
    }
    assert_eq!(hash, 825_370_836, "the bits of a function have changed");
}
