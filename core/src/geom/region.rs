//! Convex parts of space: where the rays of a bundle can be.
//!
//! What does not meet the part is met by none of the rays. All tests err on one side: what may meet it is
//! said to.

use super::{Aabb, Ray, unit};
use crate::num;
use glam::Vec3;

/// Points `x` with `normal · x ≤ offset`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HalfSpace {
    pub(crate) normal: Vec3,
    pub(crate) offset: f32,
}

/// Half-spaces of a region, at most: a shaft has four for each pair of axes, a beam six.
const MOST: usize = 12;

/// A box, cut by half-spaces.
#[derive(Debug, Clone, Copy)]
pub struct Region {
    bounds: Aabb,
    cuts: [HalfSpace; MOST],
    count: usize,
}

impl Region {
    /// Everything in a box.
    #[must_use]
    pub const fn within(bounds: Aabb) -> Self {
        Self { bounds, cuts: [HalfSpace { normal: Vec3::ZERO, offset: 0.0 }; MOST], count: 0 }
    }

    /// All segments between two boxes, and little more.
    ///
    /// Source: Haines, Wallace 1994, *Shaft Culling for Efficient Ray-Cast Radiosity*, section 2: the box
    /// around both, cut by the planes that touch both and are parallel to an axis.
    #[must_use]
    pub fn shaft(from: &Aabb, to: &Aabb) -> Self {
        let mut shaft = Self::within(from.union(*to));
        for (axis, other) in [(0, 1), (1, 2), (2, 0)] {
            for signs in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let corner =
                    |b: &Aabb, axis: usize, sign: f32| if sign > 0.0 { b.max[axis] } else { b.min[axis] };
                let step = |axis, sign: f32| sign * (corner(to, axis, sign) - corner(from, axis, sign));
                // How much farther out the second box reaches, along either axis.
                let (farther, nearer) = (step(axis, signs.0), step(other, signs.1));
                if farther * nearer < 0.0 {
                    let mut normal = Vec3::ZERO;
                    normal[axis] = signs.0 * nearer.abs();
                    normal[other] = signs.1 * farther.abs();
                    let mut touched = Vec3::ZERO;
                    touched[axis] = corner(from, axis, signs.0);
                    touched[other] = corner(from, other, signs.1);
                    shaft.cut(normal, touched);
                }
            }
        }
        shaft
    }

    /// What lies between four rays: all segments from their origins to their ends, and little more.
    ///
    /// * `rays` – the corners of the bundle, in order around it; with unit directions that are all the same
    ///   or from one origin
    /// * `ends` – a point of each
    #[must_use]
    pub fn beam(rays: &[Ray; 4], ends: &[Vec3; 4]) -> Self {
        let origins = rays.map(|ray| ray.origin);
        let mut beam = Self::within(Aabb::around(&origins).union(Aabb::around(ends)));
        let middle = origins.iter().chain(ends).fold(Vec3::ZERO, |sum, &p| sum + p * 0.125);
        for k in 0..4 {
            let (a, b) = (rays[k], rays[(k + 1) % 4]);
            // Differences first: neighbouring directions are almost the same.
            let across = (b.origin - a.origin) + (b.direction - a.direction);
            let Some(normal) = unit((a.direction + b.direction).cross(across)) else { continue };
            let outward = if normal.dot(middle - a.origin) > 0.0 { -normal } else { normal };
            beam.cut(outward, a.origin);
        }
        beam
    }

    /// True when no ray between four meets a flat convex outline, as seen from where they begin: one of its
    /// edges has all of them on its outer side.
    ///
    /// * `rays` – as for [`Region::beam`]
    /// * `outline` – corners in order, in one plane
    #[must_use]
    pub fn is_beside(rays: &[Ray; 4], outline: &[Vec3; 4]) -> bool {
        let normal = (outline[1] - outline[0]).cross(outline[2] - outline[0]);
        let facing = normal.dot(rays[0].direction);
        // Beyond an edge of the outline, the ray, the edge and its origin span a volume of the other sign.
        let passes = |ray: &Ray, from: Vec3, to: Vec3| {
            let (a, b) = (from - ray.origin, to - ray.origin);
            let slack = num::gamma(16) * (a.length() * b.length());
            normal.dot(ray.direction) * facing > 0.0
                && ray.direction.dot(a.cross(b)) * facing.signum() < -slack
        };
        (0..4).any(|k| rays.iter().all(|ray| passes(ray, outline[k], outline[(k + 1) % 4])))
    }

    /// Leaves out what is farther along `normal` (of any length) than a point.
    pub fn cut(&mut self, normal: Vec3, touched: Vec3) {
        let farthest = self.bounds.min.abs().max(self.bounds.max.abs()).max(touched.abs());
        let offset = normal.dot(touched) + num::gamma(16) * normal.abs().dot(farthest);
        if let Some(place) = self.cuts.get_mut(self.count).filter(|_| offset.is_finite()) {
            *place = HalfSpace { normal, offset };
            self.count += 1;
        }
    }

    /// The box around it.
    #[must_use]
    pub const fn bounds(&self) -> &Aabb {
        &self.bounds
    }

    /// The half-spaces that it is in.
    pub(crate) fn cuts(&self) -> &[HalfSpace] {
        self.cuts.get(..self.count).unwrap_or_default()
    }

    /// False when nothing of a convex set is in the region.
    ///
    /// * `bounds` – of the set
    /// * `support` – the largest `direction · x` of the points `x` of the set
    #[must_use]
    pub fn may_meet(&self, bounds: &Aabb, support: impl Fn(Vec3) -> f32) -> bool {
        let apart = self.bounds.min.cmpgt(bounds.max).any() || bounds.min.cmpgt(self.bounds.max).any();
        let farthest = bounds.min.abs().max(bounds.max.abs());
        let beyond = |cut: &HalfSpace| {
            -support(-cut.normal) - num::gamma(16) * cut.normal.abs().dot(farthest) > cut.offset
        };
        !apart && !self.cuts().iter().any(beyond)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::{hash2, unit_f32};

    fn cube(centre: Vec3, half: f32) -> Aabb {
        Aabb { min: centre - half, max: centre + half }
    }

    fn holds(region: &Region, point: Vec3) -> bool {
        region.may_meet(&Aabb::around(&[point]), |direction| direction.dot(point))
    }

    /// Three uniforms in [0, 1).
    fn random(i: u32, k: u32) -> Vec3 {
        Vec3::new(unit_f32(hash2(i, 3 * k)), unit_f32(hash2(i, 3 * k + 1)), unit_f32(hash2(i, 3 * k + 2)))
    }

    #[test]
    fn a_shaft_holds_every_segment_and_is_narrower_than_its_box() {
        for i in 0..2000 {
            let scale = [1e-3, 1.0, 1e4][i as usize % 3];
            let [from, to] = [0, 2].map(|k| {
                let centre = (random(i, k) - 0.5) * 8.0 * scale;
                let half = random(i, k + 1) * scale;
                Aabb { min: centre - half, max: centre + half }
            });
            let shaft = Region::shaft(&from, &to);
            for k in 4..20 {
                let at = |b: &Aabb, u: Vec3| b.min + (b.max - b.min) * u;
                let (a, b) = (at(&from, random(i, 3 * k)), at(&to, random(i, 3 * k + 1)));
                assert!(holds(&shaft, a + (b - a) * random(i, 3 * k + 2).x), "{from:?} {to:?}");
            }
        }
        let shaft = Region::shaft(&cube(Vec3::ZERO, 1.0), &cube(Vec3::new(10.0, 10.0, 0.0), 1.0));
        assert!(holds(&shaft, Vec3::new(5.0, 6.9, 0.0)) && !holds(&shaft, Vec3::new(5.0, 7.1, 0.0)));
        assert!(!holds(&shaft, Vec3::new(9.0, 1.0, 0.0)) && !holds(&shaft, Vec3::new(5.0, 5.0, 1.1)));
    }

    #[test]
    fn a_beam_holds_the_rays_between_its_corners_and_none_beside_them() {
        for parallel in [false, true] {
            for i in 0..500 {
                let origin = (random(i, 0) - 0.5) * 100.0;
                let forward = unit(random(i, 1) - 0.5).unwrap();
                let right = unit(forward.cross(Vec3::new(0.3, 0.5, 0.8))).unwrap();
                let up = right.cross(forward);
                let width = [if parallel { 0.03 } else { 1e-3 }, 0.3][i as usize % 2];
                let ray = |x: f32, y: f32| {
                    let across = (right * x + up * y) * width;
                    if parallel {
                        Ray::new(origin + across, forward)
                    } else {
                        Ray::new(origin, (forward + across).normalize())
                    }
                };
                let rays = [ray(-1.0, -1.0), ray(1.0, -1.0), ray(1.0, 1.0), ray(-1.0, 1.0)];
                let beam = Region::beam(&rays, &rays.map(|r| r.at(50.0)));
                for k in 4..20 {
                    let u = random(i, k) * 2.0 - 1.0;
                    let along = 24.0 * (u.z + 1.0);
                    assert!(holds(&beam, ray(u.x, u.y).at(along)), "{parallel} {i} {u}");
                    let beside = ray(u.x, 1.05).at(10.0 + along);
                    assert!(!holds(&beam, beside), "{parallel} {i} {u}");
                }
            }
        }
    }

    #[test]
    fn a_polygon_is_beside_a_beam_when_no_ray_meets_it() {
        let (mut beside, mut met) = (0, 0);
        for i in 0..4000 {
            let origin = random(i, 0) - 0.5;
            let ray = |x: f32, y: f32| Ray::new(origin, Vec3::new(x, y, 8.0).normalize());
            let rays = [ray(-1.0, -1.0), ray(1.0, -1.0), ray(1.0, 1.0), ray(-1.0, 1.0)];
            let corner = |k| origin + (random(i, k) - 0.5) * 8.0 + Vec3::Z * 8.0;
            let outline = [corner(1), corner(2), corner(3), corner(3)];
            let triangle = crate::shape::Triangle::new(outline[0], outline[1], outline[2]).unwrap();
            let meets = (4..40).any(|k| {
                let u = random(i, k) * 2.0 - 1.0;
                let prepared = crate::geom::PreparedRay::new(ray(u.x, u.y));
                crate::shape::Shape::intersect(&triangle, &prepared, f32::INFINITY).is_some()
            });
            let is_beside = Region::is_beside(&rays, &outline);
            assert!(!(meets && is_beside), "{outline:?}");
            beside += u32::from(is_beside);
            met += u32::from(meets);
        }
        assert!(beside > 800 && met > 800, "{beside} {met}");
    }

    #[test]
    fn what_is_not_finite_cuts_nothing() {
        let mut region = Region::within(cube(Vec3::ZERO, 1.0));
        region.cut(Vec3::splat(f32::NAN), Vec3::ZERO);
        region.cut(Vec3::X * f32::MAX, Vec3::X * 8.0);
        assert!(region.cuts().is_empty() && holds(&region, Vec3::ONE));
    }
}
