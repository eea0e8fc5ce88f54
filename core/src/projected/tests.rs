//! Sampling against the truth in double precision.

use super::{Chart, PolygonSample, ProjectedPolygon, oracle};
use crate::light::Receiver;
use crate::num;
use glam::{DVec3, Quat, Vec2, Vec3};
use std::vec::Vec;

const SQUARE: [Vec2; 4] = [Vec2::NEG_ONE, Vec2::new(1.0, -1.0), Vec2::ONE, Vec2::new(-1.0, 1.0)];
const TRIANGLE: [Vec2; 3] = [Vec2::ZERO, Vec2::X, Vec2::Y];
const HEXAGON: [Vec2; 6] = [
    Vec2::new(1.0, 0.1),
    Vec2::new(0.5, 0.8),
    Vec2::new(-0.6, 0.9),
    Vec2::new(-1.0, 0.0),
    Vec2::new(-0.4, -0.8),
    Vec2::new(0.7, -0.7),
];

/// Whole, thin, a needle.
const ASPECTS: [f32; 3] = [1.0, 1e3, 1e6];

type Polygon = ProjectedPolygon<8>;

/// A receiver, and a polygon with its plane.
#[derive(Debug, Clone, Copy)]
struct Case {
    from: Receiver,
    origin: Vec3,
    axes: [Vec3; 2],
    corners: &'static [Vec2],
}

impl Case {
    fn chart(&self) -> Chart {
        Chart::from_axes(self.from.point, self.origin, self.axes[0], self.axes[1])
    }

    fn polygon(&self) -> Option<Polygon> {
        Polygon::new(self.from.normal, &self.chart(), self.corners)
    }

    /// The point at a place.
    fn exact(&self, place: Vec2) -> DVec3 {
        let [u, v] = self.axes.map(|a| a.as_dvec3());
        self.origin.as_dvec3() + u * f64::from(place.x) + v * f64::from(place.y)
    }

    fn exact_corners(&self) -> Vec<DVec3> {
        self.corners.iter().map(|c| self.exact(*c)).collect()
    }
}

fn random(i: u32, k: u32) -> f32 {
    num::unit_f32(num::hash2(i, k))
}

/// Polygons that are seen from about `distance` times their size, under any angle, from both sides.
fn cases(distance: f32, aspect: f32, scale: f32) -> impl Iterator<Item = Case> {
    (0..60).map(move |i| {
        let euler = glam::EulerRot::XYZ;
        let turn = Quat::from_euler(euler, random(i, 1), random(i, 2) * 3.0, random(i, 3) * 6.0);
        let (u, v) = (turn * Vec3::X * scale, turn * Vec3::Y * (scale / aspect));
        let out = crate::warp::cosine_hemisphere([random(i, 4), random(i, 5)]) + Vec3::Z * 1e-3;
        let out = turn * if i % 2 == 0 { out } else { -out };
        let foot = u * (random(i, 6) - 0.3) + v * (random(i, 7) - 0.4);
        let aim = crate::warp::uniform_sphere([random(i, 8), random(i, 9)]);
        let from = Receiver {
            point: foot + out * (distance * scale),
            normal: (aim * random(i, 10) - out).normalize_or(Vec3::Z),
        };
        let corners: &[Vec2] = [&SQUARE[..], &TRIANGLE, &HEXAGON][i as usize % 3];
        Case { from, origin: Vec3::ZERO, axes: [u, v], corners }
    })
}

fn draws(polygon: &Polygon) -> impl Iterator<Item = ([f32; 2], PolygonSample)> {
    let ends = [[0.0, 0.0], [0.0, num::ONE_MINUS_EPSILON], [num::ONE_MINUS_EPSILON; 2]];
    let uniforms = (0..40u32).map(|i| [random(i, 20), random(i, 21)]).chain(ends);
    uniforms.map(|u| (u, polygon.sample(u).expect("a sample for all uniforms")))
}

/// Both conditionals, where directions in single precision can tell.
#[test]
fn directions_are_spread_in_proportion_to_the_cosine() {
    for (distance, aspect) in [(1e-3, 1.0), (0.1, 1.0), (1.0, 1.0), (8.0, 1.0), (0.1, 10.0), (1.0, 10.0)] {
        for case in cases(distance, aspect, 1.0) {
            let Some(polygon) = case.polygon() else { continue };
            let corners = case.exact_corners();
            for (u, drawn) in draws(&polygon) {
                let (u, wi) = (u.map(f64::from), drawn.wi.as_dvec3());
                let [low, high] = oracle::meridian(&case.from, &corners, wi);
                let sin2 = wi.cross(case.from.normal.as_dvec3()).length_squared();
                // At the ends, the oracle may find the meridian beside the polygon.
                if u[0] < 1e-6 || u[0] > 1.0 - 1e-6 {
                    continue;
                }
                let off = (low + (high - low) * u[1] - sin2).abs();
                assert!(off < 2e-5, "{case:?} {u:?}: {off} of {low} {high}");
                if sin2 < 1e-3 || corners.iter().any(|c| is_below(&case.from, *c)) {
                    continue;
                }
                let start = corners[0] - case.from.point.as_dvec3();
                let mut share = oracle::share_before(&case.from, &corners, start, wi);
                share = if case.chart().volume() < 0.0 { 1.0 - share } else { share };
                assert!((share - u[0]).abs() < 2e-5 * distance.max(1.0) as f64, "{case:?} {u:?} {share}");
            }
        }
    }
}

fn is_below(from: &Receiver, point: DVec3) -> bool {
    from.normal.as_dvec3().dot(point - from.point.as_dvec3()) <= 0.0
}

/// Places, where directions in single precision cannot tell.
#[test]
fn places_on_a_far_polygon_are_spread_like_its_cosine() {
    for (distance, aspect) in [(1e3, 1.0), (1e3, 1e3), (1e6, 1.0), (1e6, 1e3), (1.0, 1e3), (1.0, 1e6)] {
        for case in cases(distance, aspect, 1.0) {
            let Some(polygon) = case.polygon() else { continue };
            let corners = case.exact_corners();
            if corners.iter().any(|c| is_below(&case.from, *c)) {
                continue;
            }
            for (u, drawn) in draws(&polygon) {
                let start = corners[0] - case.from.point.as_dvec3();
                let way = case.exact(drawn.place) - case.from.point.as_dvec3();
                let mut share = oracle::share_before(&case.from, &corners, start, way);
                share = if case.chart().volume() < 0.0 { 1.0 - share } else { share };
                assert!((share - f64::from(u[0])).abs() < 1e-4, "{case:?} {u:?} {share}");
            }
        }
    }
}

#[test]
fn the_inverse_returns_the_uniforms() {
    for (distance, tolerance) in [(0.1, 5e-4), (1.0, 5e-5), (1e3, 2e-5), (1e6, 2e-5)] {
        for (aspect, scale) in ASPECTS.into_iter().flat_map(|a| [(a, 1e-6), (a, 1.0), (a, 1e6)]) {
            for case in cases(distance, aspect, scale) {
                let Some(polygon) = case.polygon() else { continue };
                for (u, drawn) in draws(&polygon) {
                    let v = polygon.invert(drawn.place);
                    let off = (u[0] - v[0]).abs().max((u[1] - v[1]).abs());
                    let ends = u[0].min(1.0 - u[0]).min(1.0 - u[1]) < 1e-6;
                    assert!(off < tolerance || ends, "{case:?} {u:?} {v:?}");
                }
            }
        }
    }
}

/// Near the light its own coordinates are coarse; the direction is not.
#[test]
fn samples_are_consistent_at_every_distance() {
    for distance in [1e-6, 1e-3, 0.1, 1.0, 1e3, 1e6] {
        for (aspect, scale) in ASPECTS.into_iter().flat_map(|a| [(a, 1e-6), (a, 1.0), (a, 1e6)]) {
            for case in cases(distance, aspect, scale) {
                let Some(polygon) = case.polygon() else { continue };
                let e = polygon.projected_solid_angle();
                for (u, drawn) in draws(&polygon) {
                    let way = case.chart().point(drawn.place);
                    let off = (drawn.wi * drawn.distance - way).length();
                    let reach = way.length() + scale + drawn.distance;
                    assert!(
                        (drawn.wi.length() - 1.0).abs() < 5e-7 && off < 1e-6 * reach,
                        "{case:?} {u:?} {off}"
                    );
                    // The cosine over the density is the same for all: no variance without a shadow.
                    let cos = case.from.normal.dot(drawn.wi);
                    let weight = polygon.pdf_solid_angle(drawn.wi).map(|pdf| cos / pdf);
                    assert!(weight.is_none_or(|w| (w / e - 1.0).abs() < 3e-7), "{case:?} {u:?} {weight:?}");
                    assert!(weight.is_some() || cos < 1e-6, "{case:?} {u:?}");
                }
            }
        }
    }
}

#[test]
fn arbitrary_numbers_give_samples_or_nothing() {
    let float = |i, k| f32::from_bits(num::hash2(i, k));
    let vector = |i, k| Vec3::new(float(i, k), float(i, k + 1), float(i, k + 2));
    for i in 0..200_000 {
        // Any numbers, and ones of a few magnitudes that meet more often.
        let normal = crate::warp::uniform_sphere([random(i, 0), random(i, 1)]);
        let small = |k| (vector(i, k) % 3.0) * if i % 4 == 0 { Vec3::X + Vec3::Z } else { Vec3::ONE };
        let [p, a, b, c] =
            if i % 2 == 0 { [2, 5, 8, 11].map(|k| vector(i, k)) } else { [2, 5, 8, 11].map(small) };
        let chart = Chart::from_corners(p, [a, b, c]);
        let Some(polygon) = Polygon::new(normal, &chart, &SQUARE) else { continue };
        let e = polygon.projected_solid_angle();
        assert!(e > 0.0 && e < num::PI * 1.000_1, "{e} {p} {a} {b} {c}");
        for (_, drawn) in [[0.0; 2], [random(i, 20), random(i, 21)]].map(|u| (u, polygon.sample(u))) {
            let Some(drawn) = drawn else { continue };
            assert!((drawn.wi.length() - 1.0).abs() < 1e-6 && drawn.distance > 0.0, "{drawn:?}");
            let inverse = polygon.invert(drawn.place);
            assert!(inverse.iter().all(|u| (0.0..1.0).contains(u)), "{inverse:?}");
        }
    }
}
