//! Leaving a surface without meeting it again.

use glam::Vec3;

/// Moves a point on a surface just off it, to the side that `direction` points to.
///
/// * `point` – computed surface point (m)
/// * `error` – bound on the absolute error of `point`, per axis (m)
/// * `normal` – geometric unit normal, on either side
/// * `direction` – where the ray will go
///
/// The result is on the right side of every plane that passes through the error box with the given
/// normal, and one representable number further on each axis. No length of the scene enters.
///
/// Source: Pharr, Jakob, Humphreys 2023, *Physically Based Rendering*, 4th ed., section 6.8.6.
#[inline]
#[must_use]
pub fn offset_origin(point: Vec3, error: Vec3, normal: Vec3, direction: Vec3) -> Vec3 {
    let distance = normal.abs().dot(error);
    let toward = if direction.dot(normal) < 0.0 { -normal } else { normal };
    let moved = point + toward * distance;
    Vec3::new(step(moved.x, toward.x), step(moved.y, toward.y), step(moved.z, toward.z))
}

/// The next representable number in the direction of `sign`; unchanged when `sign` is 0.
#[inline]
fn step(x: f32, sign: f32) -> f32 {
    if sign > 0.0 {
        x.next_up()
    } else if sign < 0.0 {
        x.next_down()
    } else {
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn always_lands_on_the_side_of_the_direction() {
        for scale in [1e-6, 1.0, 1e6] {
            let n = Vec3::new(0.6, 0.0, -0.8);
            let p = Vec3::new(1.0, 2.0, 3.0) * scale;
            let e = Vec3::splat(1e-6 * scale);
            assert!((offset_origin(p, e, n, n) - p).dot(n) > 0.0);
            assert!((offset_origin(p, e, n, -n) - p).dot(n) < 0.0);
            assert!((offset_origin(p, e, -n, n) - p).dot(n) > 0.0);
        }
    }

    #[test]
    fn a_point_at_the_origin_moves_too() {
        let p = offset_origin(Vec3::ZERO, Vec3::ZERO, Vec3::Y, Vec3::Y);
        assert!(p.y > 0.0 && p.x == 0.0);
    }
}
