//! Irradiance and variance of the samplers against closed forms.

use halflight::Rgb;
use halflight::glam::{DVec3, Vec3};
use halflight::light::{Constant, SurfaceDensity};
use halflight::shape::{Cylinder, Rectangle, Sphere, Triangle};
use halflight_tests::lights::{
    Area, Environment, Specimen, Subject, area, disk_facing_down, receiver, rectangle_facing_down,
};
use halflight_tests::oracle::{self, Patch};
use halflight_tests::random::Uniforms;
use halflight_tests::statistics::{Moments, check_variance};
use halflight_tests::{Verdict, ensure};
use std::f64::consts::PI;

const SAMPLES: usize = 1 << 18;

/// What single precision may add to a mean of samples that are accurate to a few roundings.
const ROUNDING: f64 = 2e-6;

fn estimates(subject: &impl Subject) -> Vec<f64> {
    let mut random = Uniforms::new(41);
    let normal = subject.from().normal;
    let weight = |(sample, pdf): (halflight::light::LightSample, f32)| {
        f64::from(normal.dot(sample.wi).max(0.0) * sample.incident.g) / f64::from(pdf)
    };
    (0..SAMPLES).map(|_| subject.draw(random.two()).map_or(0.0, weight)).collect()
}

/// Irradiance, however the surface is sampled.
fn has_irradiance<S: Specimen>(subject: &Area<S>, truth: f64) -> Verdict {
    for method in [SurfaceDensity::Area, SurfaceDensity::SolidAngle] {
        let moments = Moments::of(estimates(&subject.by(method)));
        moments.check_mean(&format!("irradiance by {method:?}"), truth, ROUNDING)?;
        // A variance beyond any use would let every mean pass.
        ensure!(moments.standard_error() < 0.1 * truth, "only ± {}", moments.standard_error());
    }
    Ok(())
}

mod rectangle {
    use super::*;

    #[test]
    fn over_its_corner() -> Verdict {
        let shape = rectangle_facing_down(2.0, 3.0, 1.5, Vec3::new(1.0, 1.5, 0.0));
        has_irradiance(
            &area(shape, receiver(Vec3::ZERO, Vec3::Z)),
            oracle::rectangle_over_corner(2.0, 3.0, 1.5),
        )
    }

    #[test]
    fn over_its_middle() -> Verdict {
        let shape = rectangle_facing_down(2.0, 3.0, 1.5, Vec3::ZERO);
        let truth = 4.0 * oracle::rectangle_over_corner(1.0, 1.5, 1.5);
        has_irradiance(&area(shape, receiver(Vec3::ZERO, Vec3::Z)), truth)
    }

    #[test]
    fn at_right_angles() -> Verdict {
        let shape = rectangle_facing_down(2.0, 3.0, 1.5, Vec3::new(1.0, 1.5, 0.0));
        let truth = oracle::rectangle_at_right_angles(2.0, 3.0, 1.5);
        has_irradiance(&area(shape, receiver(Vec3::ZERO, Vec3::X)), truth)
    }

    #[test]
    fn cut_by_the_horizon() -> Verdict {
        let shape = rectangle_facing_down(2.0, 3.0, 1.5, Vec3::new(0.2, 0.3, 0.0));
        let corners = corners_of(&shape);
        let normal = Vec3::new(1.0, 0.2, 0.1).normalize();
        let truth = oracle::polygon_irradiance(DVec3::ZERO, normal.as_dvec3(), &corners);
        has_irradiance(&area(shape, receiver(Vec3::ZERO, normal)), truth)
    }

    #[test]
    fn thin_and_long() -> Verdict {
        // 4 m by 0.5 mm: between two thresholds of a sampler, both of which must not exist here.
        let shape = rectangle_facing_down(4.0, 5e-4, 1.0, Vec3::ZERO);
        let truth = oracle::polygon_irradiance(DVec3::ZERO, DVec3::Z, &corners_of(&shape));
        has_irradiance(&area(shape, receiver(Vec3::ZERO, Vec3::Z)), truth)
    }

    #[test]
    fn a_tenth_of_its_size_away() -> Verdict {
        let shape = rectangle_facing_down(1.0, 1.0, 0.1, Vec3::new(0.3, 0.1, 0.0));
        let truth = oracle::polygon_irradiance(DVec3::ZERO, DVec3::Z, &corners_of(&shape));
        has_irradiance(&area(shape, receiver(Vec3::ZERO, Vec3::Z)), truth)
    }

    fn corners_of(shape: &Rectangle) -> [DVec3; 4] {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(u, v)| shape.point(u, v).point.as_dvec3())
    }
}

mod disk {
    use super::*;

    #[test]
    fn on_its_axis_and_off_it() -> Verdict {
        for off in [0.0_f32, 0.8, 4.0] {
            let shape = disk_facing_down(1.5, 1.5, 2.0, Vec3::X * off);
            let truth = oracle::disk_parallel(1.5, 2.0, f64::from(off));
            has_irradiance(&area(shape, receiver(Vec3::ZERO, Vec3::Z)), truth)?;
        }
        Ok(())
    }

    #[test]
    fn tilted_but_above_the_horizon() -> Verdict {
        let shape = disk_facing_down(0.5, 0.5, 2.0, Vec3::ZERO);
        let normal = Vec3::new(0.6, 0.0, 0.8);
        has_irradiance(&area(shape, receiver(Vec3::ZERO, normal)), 0.8 * oracle::disk_parallel(0.5, 2.0, 0.0))
    }

    #[test]
    fn at_right_angles() -> Verdict {
        let shape = disk_facing_down(1.5, 1.5, 2.0, Vec3::NEG_X * 3.0);
        has_irradiance(
            &area(shape, receiver(Vec3::ZERO, Vec3::NEG_X)),
            oracle::disk_at_right_angles(1.5, 2.0, 3.0),
        )
    }

    #[test]
    fn as_an_ellipse() -> Verdict {
        let shape = disk_facing_down(1.5, 0.4, 1.0, Vec3::new(0.3, 0.2, 0.0));
        let truth = shape.patch().irradiance(DVec3::ZERO, DVec3::Z);
        has_irradiance(&area(shape, receiver(Vec3::ZERO, Vec3::Z)), truth)
    }

    #[test]
    fn sampled_by_area_on_its_axis_has_the_exact_variance() -> Verdict {
        for h in [0.2_f32, 1.0, 5.0] {
            let subject = area(disk_facing_down(1.0, 1.0, h, Vec3::ZERO), receiver(Vec3::ZERO, Vec3::Z));
            let k = f64::from(h * h / (1.0 + h * h));
            let truth = (1.0 - k).powi(2) / (3.0 * k) * oracle::disk_parallel(1.0, f64::from(h), 0.0).powi(2);
            check_variance("disk by area", &estimates(&subject), truth, 1e-6)?;
        }
        Ok(())
    }
}

mod sphere {
    use super::*;

    fn at(sigma: f64, c: f64) -> Area<Sphere> {
        let (s, c) = (sigma.sin() as f32, c as f32);
        let shape = Sphere::new(Vec3::Z / s, 1.0).unwrap();
        area(shape, receiver(Vec3::ZERO, Vec3::new((1.0 - c * c).max(0.0).sqrt(), 0.0, c)))
    }

    #[test]
    fn clear_of_the_horizon_and_cut_by_it() -> Verdict {
        for sigma in [0.1, 0.5, 1.2] {
            for c in [1.0, 0.6, 0.3, 0.0, -0.05] {
                let truth = oracle::sphere(sigma, c);
                if truth > 0.0 {
                    has_irradiance(&at(sigma, c), truth)?;
                }
            }
        }
        Ok(())
    }

    #[test]
    fn below_the_horizon_is_dark() -> Verdict {
        let moments = Moments::of(estimates(&at(0.3, -0.5).by(SurfaceDensity::SolidAngle)));
        ensure!(moments.mean() == 0.0, "{} from below", moments.mean());
        Ok(())
    }

    #[test]
    fn tiny_ones_are_exact() -> Verdict {
        // π s² cos θ to single precision, from cones whose cosine rounds to 1.
        for sigma in [1e-2, 1e-4, 1e-6] {
            let subject = at(sigma, 0.8).by(SurfaceDensity::SolidAngle);
            let s = 1.0 / f64::from(subject.light.shape().centre().z);
            Moments::of(estimates(&subject)).check_mean(
                "a tiny sphere",
                PI * s * s * f64::from(0.8_f32),
                ROUNDING,
            )?;
        }
        Ok(())
    }

    #[test]
    fn from_inside_it_is_pi_whatever_the_normal() -> Verdict {
        let mut random = Uniforms::new(42);
        for off in [0.0, 0.5, 0.9_f32] {
            let shape = Sphere::new(random.direction() * off, 1.0).unwrap().flipped();
            has_irradiance(&area(shape, receiver(Vec3::ZERO, random.direction())), PI)?;
        }
        Ok(())
    }

    #[test]
    fn sampled_by_its_cone_has_the_exact_variance() -> Verdict {
        for sigma in [0.01_f64, 0.3, 1.0, 1.5] {
            let subject = at(sigma, 1.0).by(SurfaceDensity::SolidAngle);
            let s = 1.0 / f64::from(subject.light.shape().centre().z);
            let c = (1.0 - s * s).sqrt();
            let truth = ((1.0 - c) / (1.0 + c)).powi(2) / 3.0 * (PI * s * s).powi(2);
            check_variance("sphere by its cone", &estimates(&subject), truth, 1e-9)?;
        }
        Ok(())
    }

    #[test]
    fn sampled_by_area_has_the_exact_variance() -> Verdict {
        for sigma in [0.05, 0.5, 1.0] {
            let subject = at(sigma, 1.0);
            let truth = subject.light.shape().patch().area_sampling_variance(DVec3::ZERO, DVec3::Z);
            check_variance("sphere by area", &estimates(&subject), truth, 1e-3)?;
        }
        Ok(())
    }
}

mod triangle {
    use super::*;

    #[test]
    fn anywhere_also_cut_by_the_horizon() -> Verdict {
        let corners = [Vec3::new(-1.0, 2.0, 0.9), Vec3::new(0.5, -1.0, 3.0), Vec3::new(2.0, 1.0, 1.1)];
        let shape = Triangle::new(corners[0], corners[1], corners[2]).unwrap();
        for normal in [Vec3::Z, Vec3::new(1.0, 0.5, 1.0), Vec3::new(1.0, 0.0, -0.1), Vec3::NEG_X] {
            let from = receiver(Vec3::new(0.1, 0.2, -0.5), normal);
            let truth = oracle::polygon_irradiance(
                from.point.as_dvec3(),
                from.normal.as_dvec3(),
                &corners.map(|c| c.as_dvec3()),
            );
            has_irradiance(&area(shape.flipped(), from), truth)?;
        }
        Ok(())
    }
}

mod cylinder {
    use super::*;

    #[test]
    fn level_with_its_end() -> Verdict {
        let shape = Cylinder::new(Vec3::new(2.0, 0.0, 0.0), Vec3::Y * 3.0, 0.5).unwrap();
        has_irradiance(&area(shape, receiver(Vec3::ZERO, Vec3::X)), oracle::tube_from_its_end(0.5, 3.0, 2.0))
    }

    #[test]
    fn tilted() -> Verdict {
        let shape = Cylinder::new(Vec3::new(1.0, 0.4, -0.3), Vec3::new(0.1, 0.2, 1.5), 0.3).unwrap();
        let normal = Vec3::new(1.0, 0.2, 0.3).normalize();
        let truth = shape.patch().irradiance(DVec3::ZERO, normal.as_dvec3());
        let subject = area(shape, receiver(Vec3::ZERO, normal));
        Moments::of(estimates(&subject)).check_mean("tilted tube", truth, 2e-4)
    }

    #[test]
    fn sampled_by_area_has_the_exact_variance() -> Verdict {
        let shape = Cylinder::new(Vec3::new(2.0, 0.0, 0.0), Vec3::Y * 3.0, 0.5).unwrap();
        let truth = shape.patch().area_sampling_variance(DVec3::ZERO, DVec3::X);
        check_variance("tube by area", &estimates(&area(shape, receiver(Vec3::ZERO, Vec3::X))), truth, 1e-3)
    }
}

mod constant {
    use super::*;

    #[test]
    fn is_pi_without_variance() {
        let light = Constant::new(Rgb::WHITE).unwrap();
        let subject = Environment { light, from: receiver(Vec3::ZERO, Vec3::new(1.0, -2.0, 0.5)) };
        // Each sample is π to a few roundings, except those that graze the horizon, which are none.
        let values = estimates(&subject);
        let off = values.iter().filter(|v| (**v / PI - 1.0).abs() > 1e-6).count();
        assert_eq!(off, 0);
    }
}

mod flat_lights_by_area_have_the_exact_variance {
    use super::*;

    fn check<S: Specimen>(shape: S) -> Verdict {
        let from = receiver(Vec3::ZERO, Vec3::Z);
        let truth = shape.patch().area_sampling_variance(DVec3::ZERO, DVec3::Z);
        check_variance("flat light by area", &estimates(&area(shape, from)), truth, 1e-6)
    }

    #[test]
    fn rectangle() -> Verdict {
        check(rectangle_facing_down(2.0, 3.0, 1.5, Vec3::new(0.4, 0.2, 0.0)))
    }

    #[test]
    fn ellipse() -> Verdict {
        check(disk_facing_down(1.5, 0.4, 1.0, Vec3::new(0.3, 0.2, 0.0)))
    }

    #[test]
    fn triangle() -> Verdict {
        let (a, b, c) = (Vec3::new(-1.0, 2.0, 0.9), Vec3::new(2.0, 1.0, 1.1), Vec3::new(0.5, -1.0, 3.0));
        check(Triangle::new(a, b, c).unwrap())
    }
}

/// The integral and the formula are of the same surface.
#[test]
fn patches_have_the_area_of_their_shapes() {
    let near = |patch: Patch, area: f32| assert!((patch.area() / f64::from(area) - 1.0).abs() < 1e-6);
    use halflight::shape::Shape;
    let rectangle = rectangle_facing_down(2.0, 3.0, 1.5, Vec3::ZERO);
    near(rectangle.patch(), rectangle.area());
    let disk = disk_facing_down(1.5, 0.4, 1.0, Vec3::ZERO);
    near(disk.patch(), disk.area());
    let tube = Cylinder::new(Vec3::ONE, Vec3::new(0.1, 0.2, 1.5), 0.3).unwrap();
    near(tube.patch(), tube.area());
    let ball = Sphere::new(Vec3::ONE, 0.3).unwrap();
    near(ball.patch(), ball.area());
    let triangle = Triangle::new(Vec3::X, Vec3::Y, Vec3::Z).unwrap();
    near(triangle.patch(), triangle.area());
}
