//! Each BSDF passes each check.

use halflight::Rgb;
use halflight::bsdf::{Bsdf, GgxConductor, Lambert, MetallicRoughness, Phong, RoughPlastic, TwoSided};
use halflight::glam::Vec3;
use halflight_tests::bsdfs::{self, COSINES, Lying, furnace, outgoing};
use halflight_tests::quadrature::integrate;
use halflight_tests::random::Uniforms;
use halflight_tests::{Verdict, ensure};

/// The checks that each passes: for a broad lobe, which uniform directions find, and for a narrow
/// one, of which a cone around the mirror direction is looked at. To add a BSDF: a line here.
macro_rules! conformance {
    ($name:ident, $bsdf:expr) => {
        conformance!(@checks $name, $bsdf, true, 2.0);
    };
    ($name:ident, $bsdf:expr, cone: $extent:expr) => {
        conformance!(@checks $name, $bsdf, false, $extent);
    };
    (@checks $name:ident, $bsdf:expr, $uniform:expr, $extent:expr) => {
        mod $name {
            use super::*;

            #[test]
            fn queried_density_equals_sampled_density() -> Verdict {
                bsdfs::queried_density_equals_sampled_density(&$bsdf)
            }

            #[test]
            fn light_may_run_backward() -> Verdict {
                bsdfs::light_may_run_backward(&$bsdf)
            }

            #[test]
            fn reflects_at_most_what_arrives() -> Verdict {
                bsdfs::reflects_at_most_what_arrives(&$bsdf, $uniform)
            }

            #[test]
            fn directions_pass_chi_square() -> Verdict {
                bsdfs::directions_pass_chi_square(&$bsdf, $extent)
            }

            #[test]
            fn extremes_stay_finite() -> Verdict {
                bsdfs::extremes_stay_finite(&$bsdf)
            }
        }
    };
}

fn lambert() -> Lambert {
    Lambert::new(Rgb::splat(0.7)).unwrap()
}

fn phong(diffuse: f32, specular: f32, exponent: f32) -> Phong {
    Phong::new(Rgb::splat(diffuse), Rgb::splat(specular), exponent).unwrap()
}

fn ggx(alpha: f32) -> GgxConductor {
    GgxConductor::new(Rgb::WHITE, alpha).unwrap()
}

/// Rough along one axis and smooth along the other.
fn brushed(along: f32, across: f32) -> GgxConductor {
    GgxConductor::anisotropic(Rgb::WHITE, [along, across]).unwrap()
}

fn gold(alpha: f32) -> GgxConductor {
    ggx(alpha).with_index(Rgb::new(0.143, 0.375, 1.442), Rgb::new(3.983, 2.386, 1.603)).unwrap()
}

fn plastic(alpha: f32, eta: f32, diffuse: f32) -> RoughPlastic {
    RoughPlastic::new(alpha, eta).unwrap().with_diffuse(Rgb::splat(diffuse)).unwrap()
}

fn gltf(base_color: f32, metallic: f32, roughness: f32) -> MetallicRoughness {
    MetallicRoughness::new(Rgb::splat(base_color), metallic, roughness).unwrap()
}

conformance!(lambert_grey, lambert());
conformance!(phong_flat, phong(0.3, 0.5, 0.0));
conformance!(phong_broad, phong(0.2, 0.8, 12.0));
conformance!(phong_narrow, phong(0.2, 0.8, 1e4), cone: 1e-3);
conformance!(phong_needle, phong(0.0, 1.0, 1e6), cone: 1e-5);
conformance!(ggx_rough, ggx(1.0));
conformance!(ggx_broad, ggx(0.4));
conformance!(ggx_narrow, ggx(0.01), cone: 2e-3);
conformance!(ggx_needle, ggx(1e-4), cone: 2e-7);
conformance!(ggx_brushed, brushed(0.2, 0.7));
conformance!(ggx_brushed_across, brushed(0.9, 0.25));
conformance!(ggx_brushed_narrow, brushed(0.02, 0.005), cone: 4e-3);
conformance!(gold_broad, gold(0.4));
conformance!(gold_narrow, gold(0.01), cone: 2e-3);
conformance!(plastic_rough, plastic(1.0, 1.49, 1.0));
conformance!(plastic_broad, plastic(0.3, 1.49, 0.7));
conformance!(plastic_black, plastic(0.3, 2.0, 0.0));
conformance!(plastic_without_boundary, plastic(0.3, 1.0, 1.0));
conformance!(plastic_narrow, plastic(0.01, 1.33, 0.2), cone: 2e-3);
conformance!(plastic_needle, plastic(1e-4, 2.4, 1.0), cone: 2e-7);
conformance!(gltf_rough, gltf(1.0, 0.0, 1.0));
conformance!(gltf_broad, gltf(1.0, 0.0, 0.5));
conformance!(gltf_half_a_metal, gltf(0.8, 0.5, 0.6));
conformance!(gltf_metal, gltf(0.9, 1.0, 0.6));
conformance!(gltf_black_metal, gltf(0.0, 1.0, 0.5));
conformance!(gltf_narrow, gltf(1.0, 0.1, 0.1), cone: 2e-3);
conformance!(gltf_needle, gltf(1.0, 0.0, 0.0), cone: 2e-7);

#[test]
fn lambert_reflects_its_reflectance_from_everywhere() -> Verdict {
    for cosine in COSINES {
        let moments = furnace(&lambert(), outgoing(cosine));
        moments.check_mean("albedo", f64::from(0.7_f32), 1e-6)?;
        ensure!(moments.variance() < 1e-12, "cosine sampling has the variance {}", moments.variance());
    }
    Ok(())
}

#[test]
fn phong_reflects_its_reflectances_at_normal_incidence() -> Verdict {
    for exponent in [0.0, 3.0, 100.0, 1e5] {
        furnace(&phong(0.3, 0.5, exponent), Vec3::Z).check_mean("albedo", 0.8, 1e-5)?;
    }
    Ok(())
}

#[test]
fn a_mirror_facing_cap_holds_its_share_of_a_phong_lobe() {
    // ∫ (n + 1)/(2π) cosⁿ over a cap of half-angle a is 1 − cosⁿ⁺¹ a: the density's own integral.
    for (exponent, a) in [(12.0_f32, 0.3_f64), (1e4, 0.01), (1e6, 1e-3)] {
        let held = integrate(0.0, a, 400, |t| {
            let wi = Vec3::new(t.sin() as f32, 0.0, t.cos() as f32);
            let pdf = phong(0.0, 1.0, exponent).pdf_solid_angle(Vec3::Z, wi);
            f64::from(pdf) * std::f64::consts::TAU * t.sin()
        });
        let truth = 1.0 - a.cos().powf(f64::from(exponent) + 1.0);
        assert!((held / truth - 1.0).abs() < 2e-3, "{exponent}: {held} instead of {truth}");
    }
}

#[test]
fn ggx_weights_are_at_most_the_reflectance() {
    // Visible normals leave G2/G1 ≤ 1 as the weight of a sample.
    let mut random = Uniforms::new(61);
    for alpha in [1e-4, 1e-2, 0.3, 1.0] {
        let bsdf = ggx(alpha);
        for cosine in COSINES {
            let wo = outgoing(cosine);
            for _ in 0..50_000 {
                let Some(s) = bsdf.sample(wo, random.two(), 0.0) else { continue };
                let weight = bsdf.eval(wo, s.wi).g * s.wi.z / s.pdf_solid_angle;
                assert!(weight <= 1.0 + 1e-5, "{alpha} {cosine}: {weight}");
            }
        }
    }
}

#[test]
fn facets_that_reflect_hardly_anything_are_still_sampled() {
    // Less than the error of the fitted transmittance: without a floor they would never be drawn.
    for eta in [1.002, 1.01, 1.05] {
        for cosine in COSINES {
            let wo = outgoing(cosine);
            let mirror = Vec3::new(-wo.x, -wo.y, wo.z);
            let bsdf = plastic(1e-3, eta, 0.9);
            let reflected = bsdf.eval(wo, mirror).g * cosine / bsdf.pdf_solid_angle(wo, mirror);
            assert!(reflected < 40.0, "η = {eta}, {cosine}: a sample may weigh {reflected}");
        }
    }
}

#[test]
fn no_roughness_lets_the_coat_of_gltf_and_its_base_reflect_more_than_arrives() {
    for roughness in [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0] {
        for cosine in [1.0, 0.9, 0.7, 0.5, 0.45, 0.4, 0.3, 0.2, 0.1, 0.03, 1e-2, 1e-3] {
            let own = furnace(&gltf(1.0, 0.0, roughness), outgoing(cosine));
            let bound = 1.0 + 5.0 * own.standard_error();
            assert!(own.mean() <= bound, "{roughness} {cosine}: {}", own.mean());
        }
    }
}

#[test]
fn a_smooth_metal_reflects_everything() -> Verdict {
    // With masking but no second bounce, what is lost goes to 0 with the roughness.
    furnace(&ggx(1e-3), outgoing(0.8)).check_mean("albedo", 1.0, 1e-4)
}

#[test]
fn two_sides_mirror_one_another_and_one_side_is_dark_behind() {
    let down = |w: Vec3| Vec3::new(w.x, w.y, -w.z);
    let mut random = Uniforms::new(62);
    let (both, front) = (TwoSided::both(phong(0.2, 0.8, 12.0)), TwoSided::front_only(phong(0.2, 0.8, 12.0)));
    for _ in 0..10_000 {
        let (wo, wi) = (random.direction(), random.direction());
        assert_eq!(both.eval(wo, wi), both.eval(down(wo), down(wi)));
        assert_eq!(both.pdf_solid_angle(wo, wi), both.pdf_solid_angle(down(wo), down(wi)));
        let (u, lobe) = (random.two(), random.one());
        let (above, below) = (both.sample(wo, u, lobe), both.sample(down(wo), u, lobe));
        assert_eq!(above.map(|s| s.wi), below.map(|s| down(s.wi)));
        assert!(both.eval(wo, wi).is_black() || wo.z * wi.z > 0.0, "through the surface");
        if wo.z < 0.0 {
            assert!(front.eval(wo, wi).is_black() && front.sample(wo, u, lobe).is_none());
        } else {
            assert_eq!(front.eval(wo, wi), both.eval(wo, wi));
        }
    }
}

/// Each check notices a density that is 2 % off.
mod two_percent_are_noticed {
    use super::*;

    #[test]
    fn by_the_comparison_of_densities() {
        let lying = Lying { bsdf: lambert(), sampled: 1.02, queried: 1.0 };
        assert!(bsdfs::queried_density_equals_sampled_density(&lying).is_err());
    }

    #[test]
    fn by_the_two_furnaces() {
        let lying = Lying { bsdf: lambert(), sampled: 1.02, queried: 1.02 };
        assert!(bsdfs::reflects_at_most_what_arrives(&lying, true).is_err());
    }

    #[test]
    fn by_the_histogram() {
        let metal = Lying { bsdf: brushed(0.2, 0.7), sampled: 1.0, queried: 1.02 };
        assert!(bsdfs::directions_pass_chi_square(&metal, 2.0).is_err());
        let coated = Lying { bsdf: plastic(0.3, 1.49, 0.7), sampled: 1.0, queried: 1.02 };
        assert!(bsdfs::directions_pass_chi_square(&coated, 2.0).is_err());
        let between = Lying { bsdf: gltf(0.8, 0.5, 0.6), sampled: 1.0, queried: 1.02 };
        assert!(bsdfs::directions_pass_chi_square(&between, 2.0).is_err());
    }
}
