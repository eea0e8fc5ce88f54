//! Maps from the unit square to the shapes that get sampled. Map, density and inverse side by side.
//!
//! Every map takes `u` in `[0, 1)²` and preserves relative area, so stratified points stay
//! stratified. Directions are local: `z` is the axis.

use crate::num::{self, FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI, TAU};
use glam::{Vec2, Vec3};

/// Unit square → unit disk, the concentric map. Density `1/π`.
///
/// Source: Shirley and Chiu 1997, *A Low Distortion Map Between Disk and Square*, JGT 2(3).
#[inline]
#[must_use]
pub fn square_to_disk(u: [f32; 2]) -> Vec2 {
    let a = 2.0 * u[0] - 1.0;
    let b = 2.0 * u[1] - 1.0;
    if a == 0.0 && b == 0.0 {
        return Vec2::ZERO;
    }
    let (r, phi) =
        if a.abs() > b.abs() { (a, FRAC_PI_4 * (b / a)) } else { (b, FRAC_PI_2 - FRAC_PI_4 * (a / b)) };
    let (sin, cos) = num::sin_cos_near(phi);
    Vec2::new(r * cos, r * sin)
}

/// Inverse of [`square_to_disk`].
#[must_use]
pub fn disk_to_square(p: Vec2) -> [f32; 2] {
    let r = num::sqrt(p.length_squared());
    // Angle in [−π/4, 7π/4), as in the quadrants of the map.
    let mut phi = num::atan2(p.y, p.x);
    if phi < -FRAC_PI_4 {
        phi += TAU;
    }
    let (a, b) = if phi < FRAC_PI_4 {
        (r, phi * r / FRAC_PI_4)
    } else if phi < 3.0 * FRAC_PI_4 {
        (-(phi - FRAC_PI_2) * r / FRAC_PI_4, r)
    } else if phi < 5.0 * FRAC_PI_4 {
        (-r, (PI - phi) * r / FRAC_PI_4)
    } else {
        ((phi - 3.0 * FRAC_PI_2) * r / FRAC_PI_4, -r)
    };
    [(a + 1.0) * 0.5, (b + 1.0) * 0.5]
}

/// Unit square → barycentric coordinates `(b1, b2)` of a triangle. Density `1 / area`.
///
/// Source: Heitz 2019, *A Low-Distortion Map Between Triangle and Square*, section 2.
#[inline]
#[must_use]
pub fn square_to_triangle(u: [f32; 2]) -> [f32; 2] {
    let [x, y] = u;
    if y > x {
        let half = 0.5 * x;
        [half, y - half]
    } else {
        let half = 0.5 * y;
        [x - half, half]
    }
}

/// Inverse of [`square_to_triangle`].
#[inline]
#[must_use]
pub fn triangle_to_square(b: [f32; 2]) -> [f32; 2] {
    if b[1] > b[0] { [2.0 * b[0], b[1] + b[0]] } else { [b[0] + b[1], 2.0 * b[1]] }
}

/// Unit square → directions, uniform over the sphere. Density `1/(4π)` (sr⁻¹).
#[inline]
#[must_use]
pub fn uniform_sphere(u: [f32; 2]) -> Vec3 {
    // sin θ = 2 √(u (1 − u)) follows from cos θ = 1 − 2 u without cancellation.
    let sin_theta = 2.0 * num::sqrt(u[0] * (1.0 - u[0]));
    let (sin, cos) = num::sin_cos_turns(u[1]);
    Vec3::new(sin_theta * cos, sin_theta * sin, 1.0 - 2.0 * u[0])
}

/// Inverse of [`uniform_sphere`].
#[must_use]
pub fn uniform_sphere_inverse(d: Vec3) -> [f32; 2] {
    [0.5 * one_minus_cos(d), turn(d)]
}

/// `1 − cos θ` of a unit vector, from its sine where the cosine is near 1.
#[inline]
fn one_minus_cos(d: Vec3) -> f32 {
    if d.z > 0.0 { (d.x * d.x + d.y * d.y) / (1.0 + d.z) } else { 1.0 - d.z }
}

/// Density of [`uniform_sphere`] (sr⁻¹).
pub const UNIFORM_SPHERE_PDF: f32 = 0.25 * FRAC_1_PI;

/// Unit square → directions about `+z` with density `cos θ / π` (sr⁻¹)
/// (a uniform disk lifted to the hemisphere: Malley's method).
#[inline]
#[must_use]
pub fn cosine_hemisphere(u: [f32; 2]) -> Vec3 {
    let p = square_to_disk(u);
    Vec3::new(p.x, p.y, num::sqrt(1.0 - p.length_squared()))
}

/// Density of [`cosine_hemisphere`] (sr⁻¹); 0 at and below the horizon.
#[inline]
#[must_use]
pub fn cosine_hemisphere_pdf(cos_theta: f32) -> f32 {
    cos_theta.max(0.0) * FRAC_1_PI
}

/// Inverse of [`cosine_hemisphere`].
#[must_use]
pub fn cosine_hemisphere_inverse(d: Vec3) -> [f32; 2] {
    disk_to_square(Vec2::new(d.x, d.y))
}

/// Unit square → directions, uniform over the hemisphere about `+z`. Density `1/(2π)` (sr⁻¹).
#[inline]
#[must_use]
pub fn uniform_hemisphere(u: [f32; 2]) -> Vec3 {
    cone(u, 1.0)
}

/// Density of [`uniform_hemisphere`] (sr⁻¹).
pub const UNIFORM_HEMISPHERE_PDF: f32 = 0.5 * FRAC_1_PI;

/// Unit square → directions, uniform over a cone about `+z`.
///
/// * `one_minus_cos_max` – `1 − cos θ_max` of the cone, in `(0, 2]`; kept instead of the cosine,
///   which rounds to 1 for every cone narrower than 2.4e-4 rad
///
/// Density [`cone_pdf`]. Source: Shirley, Wang, Zimmerman 1996, *Monte Carlo Techniques for Direct
/// Lighting Calculations*, ACM TOG 15(1), section 3.2.2. Differs: with `x = 1 − cos θ`, the sine is
/// `√(x (2 − x))`, which does not cancel.
#[inline]
#[must_use]
pub fn cone(u: [f32; 2], one_minus_cos_max: f32) -> Vec3 {
    let x = u[0] * one_minus_cos_max;
    let sin_theta = num::sqrt(x * (2.0 - x));
    let (sin, cos) = num::sin_cos_turns(u[1]);
    Vec3::new(sin_theta * cos, sin_theta * sin, 1.0 - x)
}

/// Density of [`cone`] (sr⁻¹).
#[inline]
#[must_use]
pub fn cone_pdf(one_minus_cos_max: f32) -> f32 {
    1.0 / (TAU * one_minus_cos_max)
}

/// Inverse of [`cone`]; `1 − cos θ` is taken from the sine, where it does not cancel.
#[must_use]
pub fn cone_inverse(d: Vec3, one_minus_cos_max: f32) -> [f32; 2] {
    [one_minus_cos(d) / one_minus_cos_max, turn(d)]
}

/// Unit square → directions about `+z` with density `(n + 1)/(2π) cosⁿ θ` (sr⁻¹).
///
/// Source: Shirley, Wang, Zimmerman 1996 (as [`cone`]), section 3.3. Differs: `1 − cos θ` comes from
/// `expm1`, so that the lobe of exponent 1e7 keeps its shape.
#[inline]
#[must_use]
pub fn power_cosine(u: [f32; 2], exponent: f32) -> Vec3 {
    let x = -num::exp_m1(num::ln_1p(-u[0]) / (exponent + 1.0));
    let sin_theta = num::sqrt(x * (2.0 - x));
    let (sin, cos) = num::sin_cos_turns(u[1]);
    Vec3::new(sin_theta * cos, sin_theta * sin, 1.0 - x)
}

/// Density of [`power_cosine`] (sr⁻¹); 0 at and below the horizon.
#[inline]
#[must_use]
pub fn power_cosine_pdf(one_minus_cos: f32, exponent: f32) -> f32 {
    (exponent + 1.0) * (0.5 * FRAC_1_PI) * power_of_cosine(one_minus_cos, exponent)
}

/// `cosⁿ θ` from `1 − cos θ`; 0 at and below the horizon. The cosine itself would be rounded, and
/// its millionth power off by 6 %.
#[inline]
#[must_use]
pub fn power_of_cosine(one_minus_cos: f32, exponent: f32) -> f32 {
    if one_minus_cos >= 1.0 { 0.0 } else { num::exp(exponent * num::ln_1p(-one_minus_cos)) }
}

/// The angle around `z` as a fraction of a full turn, in `[0, 1)`.
fn turn(d: Vec3) -> f32 {
    let t = num::atan2(d.y, d.x) / TAU;
    (if t < 0.0 { t + 1.0 } else { t }).min(num::ONE_MINUS_EPSILON)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points() -> impl Iterator<Item = [f32; 2]> {
        (1..4096u32).map(|i| [num::unit_f32(num::hash(i)), num::unit_f32(num::hash2(i, 7))])
    }

    #[track_caller]
    fn close(a: [f32; 2], b: [f32; 2], tolerance: f32) {
        assert!((a[0] - b[0]).abs() < tolerance && (a[1] - b[1]).abs() < tolerance, "{a:?} {b:?}");
    }

    #[test]
    fn inverses_return_the_uniforms() {
        for u in points() {
            close(disk_to_square(square_to_disk(u)), u, 4e-6);
            close(triangle_to_square(square_to_triangle(u)), u, 1e-6);
            close(uniform_sphere_inverse(uniform_sphere(u)), u, 1e-5);
            close(cosine_hemisphere_inverse(cosine_hemisphere(u)), u, 4e-6);
            for k in [1e-7, 1e-3, 0.5, 1.5] {
                close(cone_inverse(cone(u, k), k), u, 1e-5);
            }
        }
    }

    #[test]
    fn corners_of_the_square_stay_finite_and_of_unit_length() {
        for a in [0.0, 0.5, num::ONE_MINUS_EPSILON] {
            for b in [0.0, 0.5, num::ONE_MINUS_EPSILON] {
                for d in [
                    uniform_sphere([a, b]),
                    cosine_hemisphere([a, b]),
                    uniform_hemisphere([a, b]),
                    cone([a, b], 1e-30),
                    power_cosine([a, b], 0.0),
                    power_cosine([a, b], 1e7),
                ] {
                    assert!((d.length() - 1.0).abs() < 1e-6, "{d}");
                }
            }
        }
    }

    #[test]
    fn power_cosine_holds_the_fraction_of_its_cap() {
        // A cap of half-angle a holds 1 − cosⁿ⁺¹ a of the lobe.
        for n in [0.0, 1.0, 30.0, 1e4_f32] {
            for u in points().take(64) {
                let d = power_cosine(u, n);
                let sin2 = f64::from(d.x).powi(2) + f64::from(d.y).powi(2);
                let one_minus_cos = sin2 / (1.0 + (1.0 - sin2.min(1.0)).sqrt());
                let held = -(f64::from(n + 1.0) * (-one_minus_cos).ln_1p()).exp_m1();
                assert!((held - f64::from(u[0])).abs() < 2e-5, "{n} {u:?} {held}");
            }
        }
    }
}
