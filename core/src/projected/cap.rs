//! A spherical cap, projected on the receiver's plane and cut at its horizon.
//!
//! Seen along the receiver's normal, the rim of a cap of angular radius σ is an ellipse. With
//! s = sin σ, k = cos σ, c and b the cosine and the sine between the normal and the axis, it lies
//! `b k` aside, measures s across and `s c` along. Above the horizon the cap's projection is that
//! ellipse; a cap that the horizon cuts reaches from the ellipse's near side to the unit circle.
//! Directions are local to the cap: `z` is its axis, `x` leads away from the normal, `y` across.

use crate::geom::Frame;
use crate::light::Receiver;
use crate::num::{self, FRAC_PI_2, PI};
use crate::warp;
use glam::{Vec2, Vec3};

/// A cap above a receiver's horizon, uniform over projected solid angle: density `cos θ / E` (sr⁻¹).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProjectedCap {
    /// `sin σ` and `cos σ`.
    sine: f32,
    cosine: f32,
    /// Cosine and sine between the normal and the axis.
    height: f32,
    aside: f32,
    /// Projected solid angle (sr).
    area: f32,
    /// What the horizon cuts; `None` when it does not.
    cut: Option<Cut>,
}

/// Slices across a cap that the horizon cuts: at `y = y_max sin ψ`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cut {
    /// Largest `y` above the horizon.
    y_max: f32,
    /// Half width of the rim where it meets the horizon.
    q_turn: f32,
    /// Where that is; beyond, slices end at the rim on either side.
    psi_turn: f32,
}

/// One slice of a cut cap.
struct Slice {
    /// Offset across.
    y: f32,
    /// Half of the chord of the cap's rim.
    half_rim: f32,
    /// The unit circle: `√(1 − y²)`.
    circle: f32,
    /// Length from the rim to the circle.
    length: f32,
    /// True when it ends at the rim, above the horizon.
    clear: bool,
    /// Length times `dy / dψ`.
    mass: f32,
}

/// Nodes and weights of the ten-point Gauss–Legendre rule on [−1, 1], for either sign.
///
/// Source: Abramowitz and Stegun 1964, table 25.4.
const GAUSS: [(f32, f32); 5] = [
    (0.148_874_34, 0.295_524_2),
    (0.433_395_4, 0.269_266_72),
    (0.679_409_57, 0.219_086_36),
    (0.865_063_37, 0.149_451_35),
    (0.973_906_5, 0.066_671_34),
];

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
        let height = num::sum_of_products(n.to_array(), to_centre.to_array()) / to_centre.length();
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
        // Above 0, so that a quotient is not 0 / 0 right above a receiver that touches.
        let (s, k, c, b) = (sine, cosine, height, aside.max(f32::MIN_POSITIVE));
        if !(c > -s) {
            return None;
        }
        let mut cap = Self { sine, cosine, height, aside: b, area: PI * s * s * c, cut: None };
        if c < s {
            // s² − c² = b² − k²: of both the one whose terms are small.
            let above_horizon = if s < k { (s - c) * (s + c) } else { (b - k) * (b + k) };
            let (y_turn, q_turn) = (num::sqrt(above_horizon) / b, c.abs() * k / b);
            let above = c > 0.0;
            let psi_turn = if above { num::atan2(y_turn, q_turn) } else { FRAC_PI_2 };
            let cut = Cut { y_max: if above { s } else { y_turn }, q_turn, psi_turn };
            cap.area = 2.0 * cap.mass_below(&cut, FRAC_PI_2);
            cap.cut = Some(cut);
        }
        (cap.area > 0.0 && cap.area.is_finite()).then_some(cap)
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
            let p = warp::square_to_disk(u) * self.sine;
            return self.lift(p.x, p.y, (self.sine - p.length()) * (self.sine + p.length()));
        };
        let side = 2.0 * u[1] - 1.0;
        let slice = self.slice(cut, self.solve(cut, side.abs()));
        let y = slice.y.copysign(side);
        if slice.clear {
            let q = slice.half_rim;
            return self.lift(q * (2.0 * u[0] - 1.0), y, 4.0 * q * q * u[0] * (1.0 - u[0]));
        }
        // From the unit circle inward: there the height is a product.
        let inward = slice.length * (1.0 - u[0]);
        let (x, z) = (slice.circle - inward, num::sqrt(inward * (2.0 * slice.circle - inward)));
        let (b, c) = (self.aside, self.height);
        Vec3::new(c * x - b * z, y, b * x + c * z)
    }

    /// The uniforms of a local direction, each in `[0, 1)`: the inverse of [`ProjectedCap::sample`].
    #[must_use]
    pub fn invert(&self, d: Vec3) -> [f32; 2] {
        let (s, k, b, c) = (self.sine, self.cosine, self.aside, self.height);
        // Back onto the plane of the rim, along the normal.
        let flat = || d.x + b * ((s * s - d.x * d.x - d.y * d.y) / ((d.z + k) * c));
        let [u, v] = if let Some(cut) = &self.cut {
            let sin = (d.y.abs() / cut.y_max).min(1.0);
            let psi = num::atan2(sin, num::sqrt((1.0 - sin) * (1.0 + sin)));
            let slice = self.slice(cut, psi);
            let share = self.mass_below(cut, psi) / self.area;
            let (x, z) = (b * d.z + c * d.x, c * d.z - b * d.x);
            let inward = if x > 0.0 { z * z / (slice.circle + x) } else { slice.circle - x };
            let along =
                if slice.clear { 0.5 + 0.5 * (flat() / slice.half_rim) } else { 1.0 - inward / slice.length };
            [along, 0.5 + share.copysign(d.y)]
        } else {
            warp::disk_to_square(Vec2::new(flat() / s, d.y / s))
        };
        [u, v].map(|x| if x > 0.0 { x.min(num::ONE_MINUS_EPSILON) } else { 0.0 })
    }

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

    /// The slice at `ψ`.
    ///
    /// Derived: from the rim's near side at `b k − c q`, `q = √(s² − y²)`, to the unit circle at
    /// `√(1 − y²)` are `(b q + c k)² / (√(1 − y²) + b k − c q)`.
    fn slice(&self, cut: &Cut, psi: f32) -> Slice {
        let (s, k, c, b) = (self.sine, self.cosine, self.height, self.aside);
        let (sin, cos) = num::sin_cos(psi);
        let across = cut.y_max * cos;
        let (half_rim, rise) = if c > 0.0 {
            (s * cos, b * s * cos + c * k)
        } else {
            // b q − |c| k, from the difference of the squares.
            let q = num::sqrt(cut.q_turn * cut.q_turn + across * across);
            (q, b * across * across / (q + cut.q_turn).max(f32::MIN_POSITIVE))
        };
        let circle = num::sqrt(k * k + half_rim * half_rim);
        let near = b * k - c * half_rim;
        let clear = psi > cut.psi_turn;
        let length = if clear {
            2.0 * c * half_rim
        } else if near > 0.0 {
            rise * rise / (circle + near)
        } else {
            circle - near
        };
        Slice { y: cut.y_max * sin, half_rim, circle, length, clear, mass: length * across }
    }

    /// Projected solid angle of the slices from the middle to `ψ`.
    fn mass_below(&self, cut: &Cut, psi: f32) -> f32 {
        let half = 0.5 * psi.min(cut.psi_turn);
        let at = |x: f32| self.slice(cut, half * (1.0 + x)).mass;
        let cut_slices = half * GAUSS.iter().map(|(x, w)| w * (at(-x) + at(*x))).sum::<f32>();
        if psi <= cut.psi_turn {
            return cut_slices;
        }
        // ∫ 2 c q dy
        let (turn, end) = (num::sin_cos(cut.psi_turn), num::sin_cos(psi));
        let clear = (psi - cut.psi_turn) + end.0 * end.1 - turn.0 * turn.1;
        cut_slices + self.height * self.sine * self.sine * clear
    }

    /// `ψ` with the given share of the mass of one side below it: Newton's method in a bracket.
    fn solve(&self, cut: &Cut, share: f32) -> f32 {
        let target = 0.5 * share * self.area;
        let (mut low, mut high) = (0.0, FRAC_PI_2);
        let mut psi = 0.8 * share;
        for _ in 0..ITERATIONS {
            let excess = self.mass_below(cut, psi) - target;
            if excess > 0.0 {
                high = psi
            } else {
                low = psi
            }
            let next = psi - excess / self.slice(cut, psi).mass;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            let step = (next - psi).abs();
            psi = next;
            if step <= 1e-5 {
                break;
            }
        }
        psi
    }
}

/// Three to five are taken; so many only where the mass is flat.
const ITERATIONS: usize = 16;
