//! BSDFs have the values of Mitsuba 3, to the digit, or of the text that they are from.

use halflight::Rgb;
use halflight::bsdf::{Bsdf, GgxConductor, MetallicRoughness, RoughPlastic};
use halflight::glam::Vec3;
use std::f64::consts::PI;

/// `f_r cos θ` for red, green and blue, and the density (sr⁻¹), of Mitsuba 3.9.1 (`scalar_rgb`), for each
/// pair of [`DIRECTIONS`].
type Values = [[f32; 4]; 5];

/// Pairs of directions, as cosine to the normal and angle about it (rad): near the mirror direction,
/// aside, low near the mirror, low, and apart by a little.
const DIRECTIONS: [[[f64; 2]; 2]; 5] = [
    [[0.9, 0.3], [0.8, 0.3 + PI]],
    [[0.9, 0.3], [0.5, 1.0]],
    [[0.3, 2.0], [0.35, 2.0 + PI]],
    [[0.1, 4.0], [0.7, 1.0]],
    [[0.6, 0.0], [0.6, 0.2]],
];

fn direction([cosine, phi]: [f64; 2]) -> Vec3 {
    let sine = (1.0 - cosine * cosine).sqrt();
    Vec3::new((sine * phi.cos()) as f32, (sine * phi.sin()) as f32, cosine as f32)
}

fn assert_same(bsdf: &impl Bsdf, expected: &Values, tolerance: f32, what: &str) {
    for (directions, values) in DIRECTIONS.iter().zip(expected) {
        let [wo, wi] = directions.map(direction);
        let Rgb { r, g, b } = bsdf.eval(wo, wi) * wi.z;
        for (seen, expected) in [r, g, b, bsdf.pdf_solid_angle(wo, wi)].iter().zip(values) {
            let error = seen / expected - 1.0;
            assert!(error.abs() < tolerance, "{what} {directions:?}: {seen}, not {expected}");
        }
    }
}

/// The fit of the transmittance leaves 0.2 %, and 0.5 % of the choice among the lobes.
#[test]
fn rough_plastic_is_that_of_mitsuba() {
    for ((alpha, eta, nonlinear), values) in PLASTICS {
        let bsdf = RoughPlastic::new(alpha, eta).unwrap().with_nonlinear(nonlinear);
        let bsdf =
            bsdf.with_diffuse(Rgb::new(0.2, 0.5, 0.9)).unwrap().with_specular(Rgb::splat(0.8)).unwrap();
        assert_same(&bsdf, &values, 5e-3, &format!("α = {alpha}, η = {eta}"));
    }
}

#[test]
fn stretched_metal_is_that_of_mitsuba() {
    let white = GgxConductor::anisotropic(Rgb::splat(0.7), [0.1, 0.4]).unwrap();
    assert_same(&white, &WHITE, 1e-4, "white");
    let gold = GgxConductor::anisotropic(Rgb::splat(0.7), [0.9, 0.2]).unwrap();
    let gold = gold.with_index(Rgb::new(0.143, 0.375, 1.442), Rgb::new(3.983, 2.386, 1.603)).unwrap();
    assert_same(&gold, &GOLD, 1e-4, "gold");
}

/// Appendix B of the glTF 2.0 specification as it stands, in one channel, in double precision.
fn gltf_appendix([wo, wi]: [Vec3; 2], base: f64, metallic: f64, roughness: f64) -> f64 {
    let ([v, l], alpha) = ([wo, wi].map(|w| w.as_dvec3().normalize()), roughness * roughness);
    let h = (v + l).normalize();
    let (nv, nl, nh, vh) = (v.z, l.z, h.z, v.dot(h));
    let lambda = |c: f64| c + (alpha * alpha + (1.0 - alpha * alpha) * c * c).sqrt();
    let d = alpha * alpha / (PI * (nh * nh * (alpha * alpha - 1.0) + 1.0).powi(2));
    let specular = d / (lambda(nv) * lambda(nl));
    let schlick = |f0: f64| f0 + (1.0 - f0) * (1.0 - vh).powi(5);
    let dielectric = base / PI * (1.0 - schlick(0.04)) + specular * schlick(0.04);
    (1.0 - metallic) * dielectric + metallic * specular * schlick(base)
}

/// Its matte base is the appendix's in mirror directions only, its facets are everywhere.
#[test]
fn metallic_roughness_is_that_of_the_specification() {
    for roughness in [0.2_f32, 0.5, 1.0] {
        for metallic in [0.0, 0.3, 1.0_f32] {
            for (index, directions) in DIRECTIONS.map(|d| d.map(direction)).into_iter().enumerate() {
                let mirror = |w: Vec3| Vec3::new(-w.x, -w.y, w.z);
                let pair = if metallic == 1.0 { directions } else { [directions[0], mirror(directions[0])] };
                let bsdf = MetallicRoughness::new(Rgb::splat(0.7), metallic, roughness).unwrap();
                let expected = gltf_appendix(pair, 0.7, metallic.into(), roughness.into());
                let error = f64::from(bsdf.eval(pair[0], pair[1]).g) / expected - 1.0;
                assert!(error.abs() < 2e-5, "{roughness} {metallic} {index}: {error}");
            }
        }
    }
}

/// Roughness, index of refraction, whether colours shift.
type Plastic = (f32, f32, bool);

const PLASTICS: [(Plastic, Values); 5] = [
    (
        (0.02, 1.49, false),
        [
            [0.062471, 0.13762, 0.23781, 0.26202],
            [0.029839, 0.074589, 0.13426, 0.14991],
            [12.857, 12.881, 12.913, 24.577],
            [0.022231, 0.05287, 0.093722, 0.091379],
            [0.03586, 0.089644, 0.16136, 0.17342],
        ],
    ),
    (
        (0.1, 1.49, false),
        [
            [0.12441, 0.1938, 0.28633, 0.38412],
            [0.027635, 0.068877, 0.12387, 0.14987],
            [3.2711, 3.2936, 3.3236, 6.0624],
            [0.058777, 0.097162, 0.14834, 0.28898],
            [0.033034, 0.082437, 0.14831, 0.17259],
        ],
    ),
    (
        (0.3, 1.33, true),
        [
            [0.042305, 0.092583, 0.17877, 0.28029],
            [0.017385, 0.04714, 0.098147, 0.15342],
            [0.2587, 0.27577, 0.30503, 0.6303],
            [0.072065, 0.10441, 0.15987, 0.44079],
            [0.020371, 0.055589, 0.11596, 0.17482],
        ],
    ),
    (
        (0.5, 2.4, false),
        [
            [0.055858, 0.073993, 0.098172, 0.27521],
            [0.014704, 0.025283, 0.039387, 0.1336],
            [0.12689, 0.13285, 0.1408, 0.36862],
            [0.1033, 0.11499, 0.13058, 0.38604],
            [0.015231, 0.027584, 0.044054, 0.14738],
        ],
    ),
    (
        (1.0, 1.5, true),
        [
            [0.018347, 0.043612, 0.080394, 0.21851],
            [0.0098088, 0.022568, 0.041143, 0.14321],
            [0.012325, 0.01701, 0.023831, 0.11779],
            [0.016792, 0.025654, 0.038556, 0.16607],
            [0.011099, 0.024982, 0.045194, 0.156],
        ],
    ),
];

const WHITE: Values = [
    [0.4557, 0.4557, 0.4557, 0.65311],
    [0.0024068, 0.0024068, 0.0024068, 0.0037156],
    [2.9627, 2.9627, 2.9627, 5.079],
    [0.056646, 0.056646, 0.056646, 0.0833],
    [0.00056844, 0.00056844, 0.00056844, 0.00081777],
];

const GOLD: Values = [
    [0.27915, 0.2316, 0.094318, 0.45202],
    [0.0072625, 0.0060264, 0.0024382, 0.012555],
    [0.57978, 0.49826, 0.26935, 1.0782],
    [0.2475, 0.20854, 0.10158, 0.39181],
    [0.18084, 0.15007, 0.060617, 0.34002],
];
