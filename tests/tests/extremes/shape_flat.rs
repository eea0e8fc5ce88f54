//! Rectangles and triangles: distant, grazed, thin, huge, touched.

use super::{DIRECTIONAL, METHODS, Polygon, closed_form, density, irradiance, light, near};
use halflight::glam::Vec3;
use halflight::light::{AreaLight, Receiver, SurfaceDensity};
use halflight::num::UNIT_ROUND_OFF;
use halflight::shape::{Rectangle, Triangle};
use halflight_tests::lights::{receiver, rectangle_facing_down};
use halflight_tests::oracle_extremes::{polygon_irradiance, polygon_solid_angle};
use halflight_tests::random::Uniforms;
use halflight_tests::{Verdict, ensure};
use std::f64::consts::PI;

const SAMPLES: usize = 1 << 14;

/// In no coordinate plane, centre at the origin.
fn tilted_rectangle() -> Rectangle {
    let (u, v) = (Vec3::new(0.6, 0.64, -0.48), Vec3::new(-0.8, 0.48, -0.36));
    Rectangle::new(Vec3::ZERO, u * 0.5, v * 0.7).unwrap()
}

/// About as large, in the plane `z = 0`, facing up.
fn level_rectangle() -> Rectangle {
    Rectangle::new(Vec3::ZERO, Vec3::X * 0.5, Vec3::Y * 0.7).unwrap()
}

fn level_triangle() -> Triangle {
    Triangle::new(Vec3::new(-0.5, -0.4, 0.0), Vec3::new(0.6, -0.3, 0.0), Vec3::new(0.1, 0.7, 0.0)).unwrap()
}

fn truth<S: Polygon>(light: &AreaLight<S>, from: &Receiver) -> f64 {
    polygon_irradiance(from.point.as_dvec3(), from.normal.as_dvec3(), &light.shape().corners())
}

/// Samples of `1 / p` are all the solid angle, which a uniform density makes them.
#[track_caller]
fn has_its_solid_angle<S: Polygon>(light: &AreaLight<S>, from: &Receiver, tolerance: f64) {
    let truth = polygon_solid_angle(from.point.as_dvec3(), &light.shape().corners());
    let mut random = Uniforms::new(121);
    for _ in 0..64 {
        let (_, pdf) = density(light, from, SurfaceDensity::SolidAngle, random.two()).expect("a sample");
        near(&format!("solid angle from {}", from.point), 1.0 / f64::from(pdf), truth, tolerance);
    }
}

/// A sum of angles minus 2π: distant panels turn to structured noise, then to nothing.
#[test]
fn row_06_distant_rectangles_keep_their_solid_angle_and_their_light() -> Verdict {
    for distance in [1.0_f32, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6] {
        for (shape, angle) in
            [(tilted_rectangle(), 0.0_f32), (tilted_rectangle(), 1.0), (level_rectangle(), 1.0)]
        {
            let aside = shape.half_u().normalize();
            let out = shape.normal() * angle.cos() + aside * angle.sin();
            let (light, from) = (light(shape), Receiver { point: out * distance, normal: -out });
            has_its_solid_angle(&light, &from, 1e-5);
            for method in METHODS {
                let what = format!("{method:?} at {distance}, {angle} rad");
                irradiance(&light, &from, method, SAMPLES).check_mean(&what, truth(&light, &from), 1e-5)?;
            }
        }
    }
    Ok(())
}

/// Cancelling angles at a grazing view, 8 % off one size away, and the planar density that hides it.
#[test]
fn row_07_rectangles_seen_a_milliradian_above_their_plane() -> Verdict {
    for distance in [1.0_f32, 10.0, 1e3, 1e6] {
        for (shape, tolerance) in [
            // Seen along an axis, the height is known to the last bit; elsewhere it is a difference.
            (level_rectangle(), 1e-5),
            (tilted_rectangle(), 1e-5 + f64::from(8.0 * UNIT_ROUND_OFF) / 1e-3),
        ] {
            let out = shape.half_u().normalize() + shape.normal() * 1e-3;
            let from = receiver(out * distance, -out);
            has_its_solid_angle(&light(shape), &from, tolerance);
            for method in METHODS {
                let what = format!("{method:?} at {distance}");
                let moments = irradiance(&light(shape), &from, method, SAMPLES);
                moments.check_mean(&what, truth(&light(shape), &from), tolerance)?;
            }
        }
    }
    Ok(())
}

/// A planar approximation chosen by a test that also fires at contact: 10⁵ times too bright there.
#[test]
fn row_08_contact_inside_the_outline_is_pi() -> Verdict {
    for height in [1e-2_f32, 1e-3, 1e-4, 1e-6] {
        for aside in [0.0_f32, 0.3] {
            let light = light(rectangle_facing_down(1.0, 1.0, height, Vec3::X * aside));
            let from = receiver(Vec3::ZERO, Vec3::Z);
            let truth = truth(&light, &from);
            ensure!(height > 1e-3 || (truth / PI - 1.0).abs() < 0.01, "{truth} at contact");
            has_its_solid_angle(&light, &from, 1e-5);
            for method in DIRECTIONAL {
                let what = format!("{method:?}, {height} below, {aside} aside");
                irradiance(&light, &from, method, SAMPLES).check_mean(&what, truth, 1e-4)?;
            }
            let projected = irradiance(&light, &from, SurfaceDensity::Projected, SAMPLES);
            ensure!(projected.variance() < 1e-6, "variance {}", projected.variance());
            closed_form(&light, &from).into_iter().for_each(|e| near("closed form", e, truth, 1e-5));
        }
    }
    Ok(())
}

/// One threshold for the sampler, another for its density: thin panels between them lose 42 %.
#[test]
fn row_09_thin_long_rectangles_of_every_solid_angle() -> Verdict {
    for (length, width) in [(10.0_f32, 2e-4), (4.0, 5e-4), (4.0, 5e-5), (4.0, 5e-3), (1e3, 1e-3), (1.0, 1e-6)]
    {
        for height in [0.1_f32, 1.0, 3.0] {
            let light = light(rectangle_facing_down(length, width, height, Vec3::X * 0.1));
            let from = receiver(Vec3::ZERO, Vec3::new(0.2, 0.1, 1.0));
            has_its_solid_angle(&light, &from, 1e-5);
            for method in METHODS {
                let what = format!("{method:?}, {length} x {width} at {height}");
                irradiance(&light, &from, method, SAMPLES).check_mean(&what, truth(&light, &from), 2e-5)?;
            }
        }
    }
    Ok(())
}

/// A random triangle of any size and thinness, and a receiver that faces it.
fn small_triangle(random: &mut Uniforms) -> Option<(AreaLight<Triangle>, Receiver)> {
    let size = 10.0_f32.powf(random.between(-6.0, 0.0));
    let (a, u) = (random.direction(), random.direction());
    let v = u * random.between(-1.0, 1.0) + random.direction() * 10.0_f32.powf(random.between(-3.0, 0.0));
    let shape = Triangle::new(a, a + u * size, a + v * size).ok()?;
    let shape = if shape.normal().dot(a) > 0.0 { shape.flipped() } else { shape };
    Some((light(shape), receiver(Vec3::ZERO, a + random.direction() * 0.5)))
}

/// Angles of a spherical triangle that cancel: NaN directions from small triangles.
#[test]
fn row_10_a_million_small_triangles_give_numbers_and_their_light() {
    let mut random = Uniforms::new(122);
    for i in 0..1_000_000 {
        let Some((light, from)) = small_triangle(&mut random) else { continue };
        density(&light, &from, METHODS[i % 4], random.two());
    }
    for _ in 0..300 {
        let Some((light, from)) = small_triangle(&mut random) else { continue };
        let [a, b, c] = light.shape().corners();
        // The height over the longest edge, in roundings of the corners; and the slope of the view.
        let extent = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let height = 2.0 * halflight::shape::Shape::area(light.shape()) / extent;
        let cosine = light.shape().normal().dot(a).abs();
        let tolerance = 1e-5 + f64::from(4.0 * UNIT_ROUND_OFF / height.min(cosine));
        for method in METHODS {
            let mean = irradiance(&light, &from, method, 4096);
            mean.check_mean(&format!("{method:?} {light:?}"), truth(&light, &from), tolerance).unwrap();
        }
    }
}

/// Polygons that fill the hemisphere or none of it: `acos(−1) / sin π` in an edge term is infinite.
#[test]
fn row_11_huge_lights_are_pi_inside_and_nothing_in_their_plane() -> Verdict {
    for size in [1e3_f32, 1e6] {
        let huge = light(rectangle_facing_down(size, size, 1.0, Vec3::ZERO));
        let from = receiver(Vec3::ZERO, Vec3::Z);
        for method in DIRECTIONAL {
            let what = format!("{method:?}, {size} wide");
            irradiance(&huge, &from, method, 1 << 16).check_mean(&what, truth(&huge, &from), 1e-5)?;
        }
        near("irradiance", truth(&huge, &from), PI, 1e-4);
        closed_form(&huge, &from).into_iter().for_each(|e| near("closed form", e, PI, 1e-4));
    }
    // In the plane: beside the light, at a corner, on the line of an edge.
    for point in [Vec3::new(2.0, 0.3, 0.0), Vec3::new(0.5, 0.7, 0.0), Vec3::new(0.5, 3.0, 0.0)] {
        for normal in [Vec3::Z, Vec3::NEG_Z, Vec3::NEG_X, Vec3::new(-0.6, -0.8, 0.0)] {
            in_plane(&light(level_rectangle()), &Receiver { point, normal });
            in_plane(&light(level_rectangle()).two_sided(), &Receiver { point, normal });
            in_plane(&light(level_triangle()), &Receiver { point, normal });
        }
    }
    Ok(())
}

#[track_caller]
fn in_plane<S: Polygon>(light: &AreaLight<S>, from: &Receiver) {
    for method in METHODS {
        let e = irradiance(light, from, method, 256);
        assert!(e.mean() == 0.0, "{method:?}: {} in the plane, from {from:?}", e.mean());
    }
    assert!(closed_form(light, from).is_none_or(|e| e == 0.0), "light in the plane, from {from:?}");
}

/// `acos(v · v')` in Lambert's sum: 3 % off at 100 sizes, forty times too bright at 1000.
#[test]
fn row_20_the_edge_sum_of_distant_polygons() {
    for distance in [1.0_f32, 1e2, 1e3, 1e4, 1e6] {
        for (x, c) in [(0.0_f32, 1.0_f32), (0.6, 0.8), (0.96, 0.28)] {
            let from = Receiver { point: Vec3::Z * distance, normal: Vec3::new(x, 0.0, -c) };
            let (square, triangle) = (light(level_rectangle()), light(level_triangle()));
            let e = closed_form(&square, &from).expect("a closed form");
            near(&format!("rectangle at {distance}"), e, truth(&square, &from), 3e-5);
            let e = closed_form(&triangle, &from).expect("a closed form");
            near(&format!("triangle at {distance}"), e, truth(&triangle, &from), 3e-5);
        }
    }
}
