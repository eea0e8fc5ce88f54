//! Lights of any shape: touched, near, behind, degenerate, scaled.

use super::{METHODS, closed_form, irradiance, light};
use halflight::Rgb;
use halflight::build::{Emission, Geometry, Mesh, Object};
use halflight::choose::PowerTable;
use halflight::estimate::{Direct, Heuristic, Technique};
use halflight::geom::{PreparedRay, Ray};
use halflight::glam::Vec3;
use halflight::light::{AreaLight, Density, Emitter, Receiver, SampledShape, SurfaceDensity, SurfaceView};
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Shape, ShapeError, Sphere, Triangle};
use halflight_tests::lights::{disk_facing_down, receiver, rectangle_facing_down};
use halflight_tests::random::{Uniforms, corners};
use halflight_tests::scenes::{Stage, seen_at_origin};
use halflight_tests::shapes::random_shape;
use halflight_tests::statistics::check_variance;
use halflight_tests::{Verdict, ensure, oracle, with_shape};

/// One shape of each kind, all within 1 of `centre`.
fn one_of_each(centre: Vec3) -> [AnyShape; 5] {
    let (u, v) = (Vec3::new(0.6, 0.64, -0.48), Vec3::new(-0.8, 0.48, -0.36));
    [
        AnyShape::Triangle(Triangle::new(centre, centre + u, centre + v).unwrap()),
        AnyShape::Rectangle(Rectangle::new(centre, u * 0.5, v * 0.4).unwrap()),
        AnyShape::Disk(Disk::new(centre, u * 0.5, v * 0.3).unwrap()),
        AnyShape::Sphere(Sphere::new(centre, 0.5).unwrap()),
        AnyShape::Cylinder(Cylinder::new(centre, u * 0.5, 0.3).unwrap()),
    ]
}

/// Every sample is a number, and so is every density and irradiance.
fn stays_a_number<S: SampledShape>(light: &AreaLight<S>, from: &Receiver) -> Verdict {
    for method in METHODS {
        for u in corners() {
            let Some(sample) = light.sample(from, method, u) else { continue };
            let Density::SolidAngle(pdf) = sample.density else { continue };
            let share = from.normal.dot(sample.wi).max(0.0) / pdf;
            ensure!(pdf > 0.0 && pdf.is_finite() && share.is_finite(), "{method:?}: density {pdf}, {share}");
            ensure!(sample.distance > 0.0 && sample.distance.is_finite(), "{method:?}: {sample:?}");
        }
    }
    closed_form(light, from);
    Ok(())
}

/// `1 / d²` at distance 0: infinite pixels where a lamp touches a wall.
#[test]
fn row_12_touching_a_light_gives_numbers() -> Verdict {
    for shape in one_of_each(Vec3::new(0.3, -0.2, 0.7)) {
        for u in corners() {
            let at = with_shape!(shape, s => s.sample_area(u));
            for normal in [at.normal, -at.normal, at.normal.any_orthonormal_vector()] {
                let from = Receiver { point: at.point, normal };
                with_shape!(shape, s => {
                    stays_a_number(&light(s), &from)?;
                    stays_a_number(&light(s).two_sided(), &from)?;
                });
            }
        }
    }
    Ok(())
}

/// A clamp on `d²` trades fireflies for darkness: the variance next to a light is the exact one.
#[test]
fn row_13_nothing_is_clamped_near_a_light() -> Verdict {
    let from = receiver(Vec3::ZERO, Vec3::Z);
    let disk = light(disk_facing_down(0.5, 0.5, 0.02, Vec3::ZERO));
    let mut random = Uniforms::new(131);
    let values: Vec<f64> = (0..1 << 20)
        .map(|_| {
            let sample = disk.sample(&from, SurfaceDensity::Area, random.two()).expect("a sample");
            let Density::SolidAngle(pdf) = sample.density else { return 0.0 };
            f64::from(sample.wi.z) / f64::from(pdf)
        })
        .collect();
    let (k, e) = (0.0004 / (0.0004 + 0.25), oracle::disk_parallel(0.5, 0.02, 0.0));
    check_variance("disk by area", &values, (1.0 - k) * (1.0 - k) / (3.0 * k) * e * e, 1e-4)?;
    let panel = light(rectangle_facing_down(1.0, 1.0, 0.02, Vec3::ZERO));
    let truth = 4.0 * oracle::rectangle_over_corner(0.5, 0.5, 0.02);
    for (method, relative) in [(SurfaceDensity::SolidAngle, 0.34), (SurfaceDensity::Projected, 1e-8)] {
        let moments = irradiance(&panel, &from, method, 1 << 16);
        moments.check_mean(&format!("{method:?}"), truth, 1e-5)?;
        ensure!(moments.variance() <= relative * truth * truth, "{method:?}: {}", moments.variance());
    }
    Ok(())
}

/// A cosine squared or without its sign: light leaks out of the back, or up from below the floor.
#[test]
fn row_14_behind_and_below_is_exactly_dark() -> Verdict {
    let mut random = Uniforms::new(132);
    for shape in one_of_each(Vec3::ZERO) {
        let behind = receiver(Vec3::new(0.0, -0.8, -1.6) * 2.0, Vec3::new(0.0, 0.8, 1.6));
        let flat = !matches!(shape, AnyShape::Sphere(_) | AnyShape::Cylinder(_));
        with_shape!(shape, s => {
            // Below the horizon: the receiver looks away.
            let away = Receiver { normal: -behind.normal, ..behind };
            for lit in [light(s), light(s).two_sided()] {
                for method in METHODS {
                    ensure!(irradiance(&lit, &away, method, 4096).mean() == 0.0, "{method:?}: {lit:?}");
                }
                ensure!(closed_form(&lit, &away).is_none_or(|e| e == 0.0), "light from below of {lit:?}");
            }
            let (foot, normal) = { let at = s.sample_area([0.4, 0.3]); (at.point, at.normal) };
            let behind = receiver(foot - normal * 0.1, normal);
            for method in METHODS {
                if flat {
                    let sample = light(s).sample(&behind, method, random.two());
                    ensure!(sample.is_none(), "{method:?}: {sample:?} from behind");
                }
            }
            ensure!(!flat || closed_form(&light(s), &behind).is_none_or(|e| e == 0.0), "light from behind");
        });
    }
    Ok(())
}

/// One normal for the sampler, another for the density: weights that do not add up to 1.
#[test]
fn row_15_the_density_of_a_sample_is_the_queried_one_for_any_normal() -> Verdict {
    let mut random = Uniforms::new(133);
    for _ in 0..100_000 {
        let shape = random_shape(&mut random, 1.0, 0.5);
        let from = Receiver { point: random.in_cube() * 2.0, normal: random.direction() };
        let u = random.two();
        with_shape!(shape, s => for method in METHODS {
            let lit = light(s).two_sided();
            let Some(sample) = lit.sample(&from, method, u) else { continue };
            let drawn = lit.view(&from, method).and_then(|v| v.sample(u)).expect("the same sample");
            let queried = lit.pdf_solid_angle(&from, method, sample.wi, &drawn.at);
            ensure!(sample.density == Density::SolidAngle(queried), "{method:?}: {sample:?}, then {queried}");
        });
    }
    interpolated_normals_do_not_change_the_mean()
}

/// A floor whose shading normals lean, seen with and without a second technique.
fn interpolated_normals_do_not_change_the_mean() -> Verdict {
    let panel = AnyShape::Rectangle(rectangle_facing_down(1.0, 1.0, 1.0, Vec3::new(0.4, 0.2, 0.0)));
    let positions = vec![Vec3::new(-9.0, -8.0, 0.0), Vec3::new(9.0, -8.0, 0.0), Vec3::new(0.0, 9.0, 0.0)];
    let normals = [Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.36, 0.48, 0.8), Vec3::new(0.8, 0.0, 0.6)];
    let mesh = Mesh { positions, normals: normals.to_vec(), triangles: vec![[0, 1, 2]], ..Mesh::default() };
    let mut stage = Stage::empty().lit(panel, 3.0);
    let name = "floor".into();
    stage.0.objects.push(Object {
        name,
        geometry: Geometry::Mesh(mesh),
        material: 2,
        emission: None::<Emission>,
        object_space: None,
    });
    let (buffers, eye) = (stage.build(), Vec3::new(0.2, -0.5, 1.0));
    let by_light = Direct { technique: Technique::Light, ..Direct::default() };
    let reference = seen_at_origin(&buffers, &by_light, eye, 1 << 18);
    ensure!(reference.mean() > 0.01, "the floor is dark");
    for surface in METHODS {
        for technique in [Technique::Mis(Heuristic::Power), Technique::Mis(Heuristic::Balance)] {
            let both = Direct { technique, surface, ..Direct::default() };
            let moments = seen_at_origin(&buffers, &both, eye, 1 << 16);
            moments.check_same(&format!("{technique:?} {surface:?}"), &reference, 1e-5)?;
        }
    }
    Ok(())
}

/// Power 0/0 and infinite densities from lights without area: refused, or never chosen.
#[test]
fn row_16_a_light_without_area_or_power_takes_nothing_from_others() {
    assert!(Rectangle::new(Vec3::ZERO, Vec3::X, Vec3::ZERO).is_err());
    assert!(Disk::new(Vec3::ZERO, Vec3::ZERO, Vec3::Y).is_err());
    assert!(Sphere::new(Vec3::ZERO, 0.0).is_err() && Sphere::new(Vec3::ZERO, 1e-45).is_err());
    assert!(Cylinder::new(Vec3::ZERO, Vec3::ZERO, 1.0).is_err());
    assert!(Triangle::new(Vec3::X, Vec3::X, Vec3::X).is_err());
    let black = AreaLight::new(Sphere::new(Vec3::ZERO, 1.0).unwrap(), Rgb::BLACK).unwrap();
    let lights = [black, light(Sphere::new(Vec3::X, 1.0).unwrap()), black];
    let mut table = [0.0; 3];
    assert!(PowerTable::fill(&mut table, |i| lights[i].power(1.0)));
    let table = PowerTable::new(&table).unwrap();
    assert_eq!([0, 1, 2].map(|i| table.pmf(i)), [0.0, 1.0, 0.0]);
}

/// Needles and collinear corners: NaN normals, or hits at a distance of NaN.
#[test]
fn row_17_degenerate_triangles_are_refused_or_give_numbers() {
    for c in [Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::X * -3.0] {
        assert!(matches!(Triangle::new(Vec3::ZERO, Vec3::X, c), Err(ShapeError::Degenerate { .. })));
    }
    let mut random = Uniforms::new(134);
    for i in 0..200_000 {
        let (a, along) = (random.in_cube(), random.direction());
        let thin = random.direction() * 10.0_f32.powf(random.between(-22.0, -3.0));
        let Ok(needle) = Triangle::new(a, a + along, a + along * random.one() + thin) else { continue };
        assert!((needle.normal().length() - 1.0).abs() < 1e-6, "{needle:?}");
        let eye = random.in_cube() * 3.0;
        let target = needle.point(random.one() * 0.5, random.one() * 0.5).point;
        let Some(direction) = (target - eye).try_normalize() else { continue };
        if let Some(hit) = needle.intersect(&PreparedRay::new(Ray::new(eye, direction)), f32::INFINITY) {
            assert!(hit.t.is_finite() && hit.u.is_finite() && hit.v.is_finite(), "{needle:?} {hit:?}");
        }
        let from = Receiver { point: eye, normal: direction };
        super::density(&light(needle), &from, METHODS[i % 4], random.two());
    }
}

/// An area taken before the transform: a light twice as large would keep its power.
#[test]
fn row_18_light_grows_with_the_square_of_its_size() -> Verdict {
    let eye = Vec3::new(0.3, 1.0, 0.2);
    let seen_under = |radius: f32| {
        let ball = AnyShape::Sphere(Sphere::new(Vec3::new(0.0, 4.0, 1.0), radius).unwrap());
        seen_at_origin(&Stage::floor(1).lit(ball, 1.0).build(), &Direct::default(), eye, 1 << 14)
    };
    let one = seen_under(0.01).mean();
    for scale in [1e-3_f32, 0.1, 10.0, 100.0] {
        let truth = one * f64::from(scale * scale);
        seen_under(0.01 * scale).check_mean(&format!("{scale} times as large"), truth, 1e-3)?;
    }
    Ok(())
}
