//! Rectangles and triangles against double precision, over distances, angles, aspects and scales.

use super::{Apex, Corner, RectanglePlace, SphericalRectangle, SphericalTriangle};
use crate::num::{TAU, hash, hash2, unit_f32};
use glam::{DVec3, Vec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};
use std::vec::Vec;

const DISTANCES: [f64; 7] = [1e-6, 1e-3, 0.1, 1.0, 30.0, 1e3, 1e6];
const ANGLES: [f64; 4] = [0.0, FRAC_PI_3, 1.4, FRAC_PI_2 - 1e-3];
const ASPECTS: [f64; 5] = [1.0, 1e3, 1e6, 1e-3, 1e-6];
const SCALES: [f64; 3] = [1e-6, 1.0, 1e6];

fn uniforms(n: u32) -> impl Iterator<Item = [f32; 2]> {
    let edges = [0.0, 1e-30, 1e-6, 0.5, 1.0 - f32::EPSILON, crate::num::ONE_MINUS_EPSILON];
    let corners = edges.into_iter().flat_map(move |a| edges.into_iter().map(move |b| [a, b]));
    corners.chain((1..n).map(|i| [unit_f32(hash(i)), unit_f32(hash2(i, 7))]))
}

/// Two triangles of one determinant over a rectangle in one quadrant of the plane.
fn quadrant_of_size(low: DVec3, size: [f64; 2]) -> f64 {
    let corner = |i: f64, j: f64| low + DVec3::new(i * size[0], j * size[1], 0.0);
    let (p, q, r, t) = (corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0));
    let det = low.z * size[0] * size[1];
    let half = |a: DVec3, b: DVec3, c: DVec3| {
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        det.atan2(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb)
    };
    2.0 * (half(p, q, r) + half(p, r, t))
}

/// Solid angle of `[x, x + dx] × [y, y + dy]`.
fn rectangle_solid_angle([x, y]: [f64; 2], [dx, dy]: [f64; 2], z: f64) -> f64 {
    let pieces = |low: f64, size: f64| -> Vec<[f64; 2]> {
        if low >= 0.0 {
            Vec::from([[low, size]])
        } else if low + size <= 0.0 {
            Vec::from([[-(low + size), size]])
        } else {
            Vec::from([[0.0, -low], [0.0, low + size]])
        }
    };
    let mut sum = 0.0;
    for [x, dx] in pieces(x, dx) {
        for [y, dy] in pieces(y, dy) {
            sum += quadrant_of_size(DVec3::new(x, y, z), [dx, dy]);
        }
    }
    sum
}

/// `y / √(d² + y²)` between two ends.
fn sines(d2: f64, y: f64, step: f64) -> f64 {
    let high = y + step;
    let (e0, e1) = (d2 + y * y, d2 + high * high);
    let (e0, e1) = (e0.sqrt(), e1.sqrt());
    if y * high > 0.0 {
        d2 * step * (y + high) / (e0 * e1 * (high * e0 + y * e1))
    } else {
        high / e1 - y / e0
    }
}

#[derive(Debug)]
struct Case {
    corner: [f32; 2],
    size: [f32; 2],
    height: f32,
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for scale in SCALES {
        for aspect in ASPECTS {
            for distance in DISTANCES {
                for angle in ANGLES {
                    for turn in [0.0, 0.13, 0.7, FRAC_PI_2, 3.3] {
                        let size = if aspect > 1.0 { [1.0, 1.0 / aspect] } else { [aspect, 1.0] };
                        let (s, c) = (angle.sin() * distance, angle.cos() * distance);
                        let corner =
                            [s * f64::cos(turn) - 0.4 * size[0], s * f64::sin(turn) - 0.45 * size[1]];
                        cases.push(Case {
                            corner: corner.map(|x| (x * scale) as f32),
                            size: size.map(|x| (x * scale) as f32),
                            height: (c * scale) as f32,
                        });
                    }
                }
            }
        }
    }
    cases
}

fn f64s(x: [f32; 2]) -> [f64; 2] {
    x.map(f64::from)
}

#[test]
fn rectangles_have_their_solid_angle() {
    for Case { corner, size, height } in cases() {
        let exact = rectangle_solid_angle(f64s(corner), f64s(size), f64::from(height));
        let seen = SphericalRectangle::new(corner, size, height).unwrap().solid_angle();
        let error = (f64::from(seen) / exact - 1.0).abs();
        assert!(error < 1e-6, "{seen} instead of {exact} sr: {corner:?} {size:?} {height}");
    }
}

/// The uniforms of a place, in double precision.
fn uniforms_of(case: &Case, seen: &SphericalRectangle, place: &RectanglePlace) -> [f64; 2] {
    let (corner, size, z) = (f64s(case.corner), f64s(case.size), f64::from(case.height));
    let step = |i: usize| {
        let spans = corner[i] < 0.0 && corner[i] + size[i] > 0.0;
        if spans {
            f64::from(place.offset[i]) * f64::from(seen.reach()) - corner[i]
        } else {
            f64::from(place.fraction[i]) * size[i]
        }
    };
    let steps = [step(0), step(1)];
    let exact = rectangle_solid_angle(corner, size, z);
    let first = rectangle_solid_angle(corner, [steps[0], size[1]], z) / exact;
    let second = rectangle_solid_angle(corner, [size[0], steps[1]], z) / exact;
    let across = |i: usize| {
        let d2 = (corner[1 - i] + steps[1 - i]).powi(2) + z * z;
        sines(d2, corner[i], steps[i]) / sines(d2, corner[i], size[i])
    };
    let (swapped, turned) = seen.layout();
    let share = |i: usize, u: f64| if turned[i] { 1.0 - u } else { u };
    if swapped { [share(1, second), share(0, across(0))] } else { [share(0, first), share(1, across(1))] }
}

#[track_caller]
fn close(u: [f32; 2], exact: [f64; 2], back: [f32; 2], what: &dyn core::fmt::Debug) {
    for i in 0..2 {
        assert!((exact[i] - f64::from(u[i])).abs() < 2e-6, "{u:?} is in truth {exact:?}: {what:?}");
        assert!((back[i] - u[i]).abs() < 2e-6, "{u:?} became {back:?}: {what:?}");
    }
}

#[test]
fn places_on_rectangles_hold_their_share() {
    for case in cases() {
        let seen = SphericalRectangle::new(case.corner, case.size, case.height).unwrap();
        for u in uniforms(60) {
            let place = seen.sample(u);
            assert!(place.fraction.iter().all(|f| (0.0..=1.0).contains(f)), "{place:?}");
            close(u, uniforms_of(&case, &seen, &place), seen.invert(&place), &(&case, place));
        }
    }
}

/// A triangle 1 long at most, with a receiver.
fn triangles() -> Vec<([Vec3; 3], Vec3)> {
    let mut cases = Vec::new();
    let turn = glam::DMat3::from_axis_angle(DVec3::new(0.48, -0.6, 0.64), 0.7);
    for scale in SCALES {
        for aspect in [1.0, 1e-3, 1e-6] {
            // An equal one, a needle with a short edge at each corner, a flat cap.
            for flat in [
                [[0.0, 0.0], [1.0, 0.0], [0.5, 0.8 * aspect]],
                [[0.0, 0.0], [1.0, 0.1 * aspect], [1.0, aspect]],
                [[1.0, aspect], [0.0, 0.0], [1.0, 0.1 * aspect]],
                [[1.0, 0.1 * aspect], [1.0, aspect], [0.0, 0.0]],
            ] {
                let corners = flat.map(|[x, y]| turn * DVec3::new(x, y, 0.0) * scale);
                let corners = corners.map(DVec3::as_vec3);
                let foot = (corners[0] + corners[1] + corners[2]).as_dvec3() / 3.0;
                for distance in DISTANCES {
                    for angle in ANGLES {
                        for azimuth in [0.1_f64, 1.9, 4.0] {
                            let flat = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0) * angle.sin();
                            let out = turn * (flat + DVec3::Z * angle.cos());
                            cases.push((corners, (foot + out * distance * scale).as_vec3()));
                        }
                    }
                }
            }
        }
    }
    cases
}

fn volume_and_cosines(p: [DVec3; 3], volume: f64) -> f64 {
    let v = p.map(DVec3::normalize);
    let sum = |i: usize, j: usize, k: usize| (v[i] + v[k]).dot(v[j] + v[k]);
    let pairs =
        [(v[1].dot(v[2]), sum(1, 2, 0)), (v[2].dot(v[0]), sum(2, 0, 1)), (v[0].dot(v[1]), sum(0, 1, 2))];
    let best = pairs.into_iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    2.0 * (volume / p.map(DVec3::length).into_iter().product::<f64>()).atan2(best.1)
}

/// Solid angle and, for a place, its uniforms.
fn triangle_truth(corners: &[Vec3; 3], from: Vec3, barycentric: Option<[f64; 2]>) -> (f64, [f64; 2]) {
    let p = corners.map(|c| c.as_dvec3() - from.as_dvec3());
    let volume = p[0].dot((p[1] - p[0]).cross(p[2] - p[0])).abs();
    let solid = volume_and_cosines(p, volume);
    let Some([b1, b2]) = barycentric else { return (solid, [0.0; 2]) };
    let b = [1.0 - b1 - b2, b1, b2];
    let direction = p[1] + (p[0] - p[1]) * b[0] + (p[2] - p[1]) * b[2];
    let part = b[2] / (b[0] + b[2]);
    let end = p[0] + (p[2] - p[0]) * part;
    let first = volume_and_cosines([p[0], p[1], end], volume * part) / solid;
    let apart = |a: DVec3, b: DVec3| (a.normalize() - b.normalize()).length_squared();
    (solid, [first, apart(p[1], direction) / apart(p[1], end)])
}

#[test]
fn triangles_have_their_solid_angle() {
    for (corners, from) in triangles() {
        let (exact, _) = triangle_truth(&corners, from, None);
        if exact > 0.0 {
            let apex = Apex::new(from, corners[0]);
            let [a, b] = [1, 2].map(|i| Corner::new(&apex, corners[i]));
            let [sin, cos] = super::half_solid_angle(&apex, &a, &b);
            let seen = 2.0 * crate::num::atan2(sin, cos);
            let error = (f64::from(seen) / exact - 1.0).abs();
            assert!(error < 1e-6, "{seen} instead of {exact} sr: {corners:?} {from}");
        }
    }
}

#[test]
fn places_on_triangles_hold_their_share() {
    for (corners, from) in triangles() {
        let Some(seen) = SphericalTriangle::new(from, &corners) else {
            assert_eq!(triangle_truth(&corners, from, None).0, 0.0, "{corners:?} {from}");
            continue;
        };
        for u in uniforms(60) {
            let place = seen.sample(u).expect("a place");
            let [b1, b2] = place.barycentric;
            assert!(b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0 + f64::EPSILON, "{place:?}");
            assert!((place.direction.length() - 1.0).abs() < 1e-6, "{place:?}");
            assert!(place.distance > 0.0 && place.distance.is_finite(), "{place:?}");
            // At a corner there is no arc.
            if u.iter().all(|u| (1e-3..0.999).contains(u)) {
                let (_, exact) = triangle_truth(&corners, from, Some(place.barycentric));
                close(u, exact, seen.invert(place.barycentric), &(corners, from, place));
            }
        }
    }
}

/// Any bits at all: numbers out of range, subnormal, infinite, NaN.
#[test]
fn random_bits_give_proper_numbers_or_nothing() {
    let mut state = 1;
    let mut any = || {
        state = hash(state);
        let bits = f32::from_bits(hash(state ^ 0x5555_5555));
        // Half of them of a size that is met in scenes.
        if state & 1 == 0 { bits } else { bits.signum() * libm::powf(bits.abs().max(1e-30), 0.1) }
    };
    for _ in 0..200_000 {
        let u = [unit_f32(hash(any().to_bits())), unit_f32(hash(any().to_bits()))];
        if let Some(seen) = SphericalRectangle::new([any(), any()], [any().abs(), any().abs()], any().abs()) {
            let place = seen.sample(u);
            let back = seen.invert(&place);
            assert!(seen.solid_angle() > 0.0 && seen.solid_angle() <= TAU.next_up(), "{seen:?}");
            assert!(place.fraction.iter().all(|f| (0.0..=1.0).contains(f)), "{seen:?} {place:?}");
            assert!(place.offset.iter().all(|x| x.abs() <= 1.001), "{seen:?} {place:?}");
            assert!(back.iter().all(|u| (0.0..1.0).contains(u)), "{seen:?} {place:?} {back:?}");
        }
        let mut point = || Vec3::new(any(), any(), any());
        if let Some(seen) = SphericalTriangle::new(point(), &[point(), point(), point()]) {
            let Some(place) = seen.sample(u) else { continue };
            let back = seen.invert(place.barycentric);
            assert!(seen.solid_angle() > 0.0 && seen.solid_angle() <= TAU.next_up(), "{seen:?}");
            assert!(place.barycentric.iter().all(|f| (0.0..=1.0).contains(f)), "{seen:?} {place:?}");
            assert!(place.distance > 0.0 && !place.direction.is_nan(), "{seen:?} {place:?}");
            assert!(back.iter().all(|u| (0.0..1.0).contains(u)), "{seen:?} {place:?} {back:?}");
        }
    }
}
