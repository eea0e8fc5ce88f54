//! Sampling against the truth in double precision.

use super::oracle::{self, projected_solid_angle};
use super::{Chart, PolygonSample, ProjectedPolygon};
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

type Polygon = ProjectedPolygon<10>;

/// A receiver, and a polygon with its axes.
#[derive(Debug, Clone, Copy)]
struct Case {
    from: Receiver,
    axes: [Vec3; 3],
    corners: &'static [Vec2],
}

impl Case {
    fn chart(&self) -> Chart {
        let [origin, u, v] = self.axes;
        Chart::from_axes(self.from.point, origin, u, v)
    }

    fn polygon(&self) -> Option<Polygon> {
        Polygon::new(self.from.normal, &self.chart(), self.corners)
    }

    fn exact_corners(&self) -> Vec<DVec3> {
        let [origin, u, v] = self.axes.map(|a| a.as_dvec3());
        self.corners.iter().map(|c| origin + u * f64::from(c.x) + v * f64::from(c.y)).collect()
    }

    /// The largest coordinate over the smallest distance to a corner: what rounding is magnified by.
    fn conditioning(&self) -> f64 {
        let way = self.from.point.as_dvec3();
        let nearest = self.exact_corners().iter().map(|c| c.distance(way)).fold(f64::INFINITY, f64::min);
        self.axes[1].length().max(self.axes[2].length()) as f64 / nearest
    }
}

fn random(i: u32, k: u32) -> f32 {
    num::unit_f32(num::hash2(i, k))
}

/// Polygons all around, at `distance` sizes and with `aspect`; the normal aims near them.
fn cases(distance: f32, aspect: f32, scale: f32) -> impl Iterator<Item = Case> {
    (0..60).map(move |i| {
        let turn = Quat::from_euler(glam::EulerRot::XYZ, random(i, 1), random(i, 2) * 3.0, random(i, 3) * 6.0);
        let (u, v) = (turn * Vec3::X * scale, turn * Vec3::Y * (scale / aspect));
        let out = crate::warp::cosine_hemisphere([random(i, 4), random(i, 5)]) + Vec3::Z * 1e-3;
        let foot = u * (random(i, 6) - 0.3) + v * (random(i, 7) - 0.4);
        let point = foot + turn * out * (distance * scale);
        let aim = crate::warp::uniform_sphere([random(i, 8), random(i, 9)]);
        let normal = (aim - turn * out).normalize_or(Vec3::Z);
        let corners: &[Vec2] = [&SQUARE[..], &TRIANGLE, &HEXAGON][i as usize % 3];
        Case { from: Receiver { point, normal }, axes: [Vec3::ZERO, u, v], corners }
    })
}

fn draws(polygon: &Polygon) -> impl Iterator<Item = ([f32; 2], PolygonSample)> {
    let uniforms = (0..40u32).map(|i| [random(i, 20), random(i, 21)]);
    uniforms.filter_map(|u| polygon.sample(u).map(|drawn| (u, drawn)))
}

#[test]
fn explore_samples() {
    for scale in [1e-6_f32, 1.0, 1e6] {
    for aspect in [1.0, 1e3, 1e6] {
    for distance in [1e-6, 1e-3, 0.1, 1.0, 1e3, 1e6] {
        let (mut worst_inv, mut worst_cdf, mut worst_h, mut n) = (0.0_f64, 0.0_f64, 0.0_f64, 0);
        let mut what = std::string::String::new();
        for case in cases(distance, aspect, scale) {
            let Some(polygon) = case.polygon() else { continue };
            let mut m = 0;
            for (u, drawn) in draws(&polygon) {
                n += 1; m += 1;
                let v = polygon.invert(drawn.place);
                let e = (u[0] - v[0]).abs().max((u[1] - v[1]).abs());
                if f64::from(e) > worst_inv { worst_inv = e.into(); what = std::format!("{case:?} {u:?} {v:?}"); }
                let (share, cut) = oracle::meridian(&case.from, &case.exact_corners(), case.chart().point(drawn.place).as_dvec3(), drawn.wi.as_dvec3());
                let share = if case.chart().volume() < 0.0 { 1.0 - share } else { share };
                worst_cdf = worst_cdf.max((share - f64::from(u[0])).abs());
                worst_h = worst_h.max((cut - f64::from(u[1])).abs());
            }
            assert!(m == 40, "{m} {case:?}");
        }
        std::println!("s{scale} a{aspect} d{distance}: n {n} inv {worst_inv:.2e} cdf {worst_cdf:.2e} h {worst_h:.2e} {what}");
    }}}
}
