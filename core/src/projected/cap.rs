//! A spherical cap, projected on the receiver's plane and cut at its horizon.
//!
//! Seen along the receiver's normal, the rim of a cap of angular radius σ is an ellipse. With
//! s = sin σ, k = cos σ, c and b the cosine and the sine between the normal and the axis, it lies
//! `b k` aside, measures s across and `s c` along. Above the horizon the cap's projection is that
//! ellipse; a cap that the horizon cuts reaches from the ellipse's near side to the unit circle.
//! Directions are local to the cap: `z` is its axis, `x` leads away from the normal, `y` across.

use super::cut::Cut;
use crate::geom::Frame;
use crate::light::Receiver;
use crate::num::{self, PI};
use crate::warp;
use glam::{Vec2, Vec3};

/// The rim of a cap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rim {
    /// `sin σ` and `cos σ`.
    pub(super) sine: f32,
    pub(super) cosine: f32,
    /// Cosine and sine between the normal and the axis.
    pub(super) height: f32,
    pub(super) aside: f32,
}

/// A cap above a receiver's horizon, uniform over projected solid angle: density `cos θ / E` (sr⁻¹).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProjectedCap {
    rim: Rim,
    /// Projected solid angle (sr).
    area: f32,
    /// What the horizon cuts; `None` when it does not.
    cut: Option<Cut>,
}

impl ProjectedCap {
    /// The cap that a sphere fills, and the frame it is local to; `None` below the horizon.
    ///
    /// * `to_centre` – from the receiver to the sphere's centre (m)
    /// * `radius`, `gap` – the sphere's radius and how far outside of it the receiver is (m), above 0
    #[must_use]
    pub fn of_sphere(from: &Receiver, to_centre: Vec3, radius: f32, gap: f32) -> Option<(Self, Frame)> {
        let distance = radius + gap;
        let n = from.normal;
        let axis = crate::geom::unit(to_centre)?;
        let cross = n.cross(axis);
        // Right above, the cross product is round-off: what is left must still be across the axis.
        let across = crate::geom::unit(cross - axis * cross.dot(axis)).unwrap_or(Frame::from_normal(axis).s);
        let frame = Frame { s: across.cross(axis), t: across, n: axis };
        // In double precision the products are exact: of a sphere on the horizon the sum keeps its digits.
        let height = n.as_dvec3().dot(to_centre.as_dvec3()) as f32 / to_centre.dot(axis);
        let cosine = num::sqrt(gap / distance) * num::sqrt((gap + 2.0 * radius) / distance);
        let cap =
            Self::new(radius / distance, cosine, height.clamp(-1.0, 1.0), num::sqrt(cross.length_squared()))?;
        Some((cap, frame))
    }

    /// * `sine`, `cosine` – of the angular radius, in `(0, 1]` and `[0, 1)`
    /// * `height`, `aside` – cosine in `[−1, 1]` and sine between the axis and the receiver's normal
    ///
    /// `None` below the horizon.
    ///
    /// Source for a cap above the horizon: `E = π s² c`, Snyder 1996, *Area Light Sources for
    /// Real-Time Graphics*. Differs: where the horizon cuts, the slices are summed instead of taking
    /// his closed form, which cancels; every term here is positive, so that the error stays below
    /// 5e-6 of the result for every size and every sliver.
    #[must_use]
    pub fn new(sine: f32, cosine: f32, height: f32, aside: f32) -> Option<Self> {
        if !(height > -sine) {
            return None;
        }
        // Above 0, so that a quotient is not 0 / 0 right above a receiver that touches.
        let rim = Rim { sine, cosine, height, aside: aside.max(f32::MIN_POSITIVE) };
        let cut = (height < sine).then(|| Cut::new(&rim));
        let area = cut.as_ref().map_or(PI * sine * sine * height, Cut::area);
        (area > 0.0 && area < f32::INFINITY).then_some(Self { rim, area, cut })
    }

    /// Projected solid angle above the horizon (sr).
    #[inline]
    #[must_use]
    pub fn area(&self) -> f32 {
        self.area
    }

    /// Draws a local direction of the cap.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> Vec3 {
        // Of unit length but for what a receiver that touches takes from its four constants.
        self.direction(u).normalize_or_zero()
    }

    #[inline]
    fn direction(&self, u: [f32; 2]) -> Vec3 {
        let Some(cut) = &self.cut else {
            let (p, sine) = (warp::square_to_disk(u) * self.rim.sine, self.rim.sine);
            return self.rim.lift(p.x, p.y, (sine - p.length()) * (sine + p.length()));
        };
        let side = 2.0 * u[1] - 1.0;
        let tau = cut.solve(side.abs());
        let slice = cut.slice(tau);
        let y = slice.y.copysign(side);
        if cut.is_clear(tau) {
            let q = slice.half_rim;
            return self.rim.lift(q * (2.0 * u[0] - 1.0), y, 4.0 * q * q * u[0] * (1.0 - u[0]));
        }
        // From the unit circle inward: there the height is a product.
        let inward = slice.length * (1.0 - u[0]);
        let (x, z) = (slice.circle - inward, num::sqrt(inward * (2.0 * slice.circle - inward)));
        let Rim { height: c, aside: b, .. } = self.rim;
        Vec3::new(c * x - b * z, y, b * x + c * z)
    }

    /// The uniforms of a local direction, each in `[0, 1)`: the inverse of [`ProjectedCap::sample`].
    #[must_use]
    pub fn invert(&self, d: Vec3) -> [f32; 2] {
        let Rim { sine: s, cosine: k, height: c, aside: b } = self.rim;
        // Back onto the plane of the rim, along the normal.
        let flat = || d.x + b * ((s * s - d.x * d.x - d.y * d.y) / ((d.z + k) * c));
        let [u, v] = if let Some(cut) = &self.cut {
            let tau = cut.tau_at(d.y.abs());
            let slice = cut.slice(tau);
            let share = 0.5 * cut.share_below(tau);
            let (x, z) = (b * d.z + c * d.x, c * d.z - b * d.x);
            let inward = if x > 0.0 { z * z / (slice.circle + x) } else { slice.circle - x };
            let along = if cut.is_clear(tau) {
                0.5 + 0.5 * (flat() / slice.half_rim)
            } else {
                1.0 - inward / slice.length
            };
            [along, 0.5 + share.copysign(d.y)]
        } else {
            warp::disk_to_square(Vec2::new(flat() / s, d.y / s))
        };
        [u, v].map(|x| if x > 0.0 { x.min(num::ONE_MINUS_EPSILON) } else { 0.0 })
    }
}

impl Rim {
    /// The direction above a point in the plane of the rim: `δ` away from the normal, `y` across.
    ///
    /// * `below` – how much of `s²` the point leaves, `s² − δ² − y²`
    ///
    /// Derived: the line along the normal through the point meets the unit sphere at `τ`, with
    /// `τ² + 2 τ (c k − b δ) = below`; no difference of unit vectors enters, so that the smallest
    /// cap keeps its shape.
    #[inline]
    fn lift(&self, delta: f32, y: f32, below: f32) -> Vec3 {
        let base = (self.height * self.cosine - self.aside * delta).max(0.0);
        let far = base + num::sqrt(base * base + below);
        let rise = if far > 0.0 { below.max(0.0) / far } else { 0.0 };
        Vec3::new(delta - rise * self.aside, y, self.cosine + rise * self.height)
    }
}
