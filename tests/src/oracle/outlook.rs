//! What a receiver sees of a surface, in cells: the truth for samplers at every distance.
//!
//! Nothing cancels at any distance: all integrands are positive, regions are cut at the horizon
//! before they are integrated, and places are taken relative to the receiver first.

use super::adaptive::{self, Place};
use super::curved::{Curved, Round};
use super::polygon::Flat;
use super::{PI, Patch};
use halflight::glam::DVec3;

/// Cells along each of two surface coordinates.
const SIDE: usize = 4;

/// Cells of an outlook.
pub const CELLS: usize = SIDE * SIDE;

/// What is seen of a part of a surface of radiance 1.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Amounts {
    /// Area that faces the receiver (m²).
    pub area: f64,
    /// Solid angle (sr).
    pub solid_angle: f64,
    /// Irradiance, `∫ cos θ dω` above the horizon (sr).
    pub irradiance: f64,
    /// `∫ cos² θ dω` above the horizon (sr): with the solid angle, the second moment of uniform directions.
    pub cos_squared: f64,
    /// `∫ (cos θ cos θ' / d²)² dA` above the horizon (m⁻²): with the area, the second moment of
    /// uniform places.
    pub geometry_squared: f64,
}

impl Amounts {
    /// Both parts together.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            solid_angle: self.solid_angle + other.solid_angle,
            irradiance: self.irradiance + other.irradiance,
            cos_squared: self.cos_squared + other.cos_squared,
            geometry_squared: self.geometry_squared + other.geometry_squared,
        }
    }

    /// Takes in a piece that faces the receiver, all of it above the horizon.
    pub(super) fn add(&mut self, normal: DVec3, map: &(impl Fn(f64, f64) -> Place + ?Sized)) {
        adaptive::visit(map, |p, n, area| {
            self.area += area;
            let seen = steradians(p, n);
            self.solid_angle += seen * area;
            self.add_node(normal, p, seen, area);
        });
    }

    /// Takes in a piece that faces the receiver, without regard to the horizon.
    pub(super) fn add_facing(&mut self, map: &(impl Fn(f64, f64) -> Place + ?Sized)) {
        adaptive::visit(map, |p, n, area| {
            self.area += area;
            self.solid_angle += steradians(p, n) * area;
        });
    }

    /// Takes in a piece that faces the receiver from above its horizon.
    pub(super) fn add_lit(&mut self, normal: DVec3, map: &(impl Fn(f64, f64) -> Place + ?Sized)) {
        adaptive::visit(map, |p, n, area| {
            self.add_node(normal, p, steradians(p, n), area);
        });
    }

    fn add_node(&mut self, normal: DVec3, p: DVec3, steradians: f64, area: f64) {
        let cos = (normal.dot(p) / p.length()).max(0.0);
        self.irradiance += cos * steradians * area;
        self.cos_squared += cos * cos * steradians * area;
        self.geometry_squared += (cos * steradians).powi(2) * area;
    }
}

/// Solid angle of a unit of area at `p` (sr m⁻²): `cos θ' / d²`, without a root squared again.
fn steradians(p: DVec3, n: DVec3) -> f64 {
    let d2 = p.length_squared();
    (-n.dot(p)).max(0.0) / (d2 * d2.sqrt())
}

/// Edges of the cells along one coordinate.
pub(super) type Edges = [f64; SIDE + 1];

/// Cells from `low` to `high` that are narrow about `at` and grow with the distance from it: even in
/// the angle whose tangent is `(x − at) / reach`.
pub(super) fn graded(low: f64, high: f64, at: f64, reach: f64) -> Edges {
    let reach = reach.max(1e-12 * (high - low));
    let [a, b] = [low, high].map(|x| ((x - at) / reach).atan());
    std::array::from_fn(|i| match i {
        0 => low,
        SIDE => high,
        _ => (at + reach * (a + (b - a) * i as f64 / SIDE as f64).tan()).clamp(low, high),
    })
}

/// The cell that a coordinate is in; those outside count to the nearest.
pub(super) fn find(edges: &Edges, x: f64) -> usize {
    edges[1..SIDE].iter().filter(|&&edge| x >= edge).count()
}

/// A surface about a receiver.
#[derive(Debug, Clone)]
enum Form {
    Flat(Flat),
    Round(Round),
}

/// A surface from a receiver's place, divided into cells: narrow ones where it is near.
#[derive(Debug, Clone)]
pub struct Outlook {
    form: Form,
    area: f64,
}

impl Outlook {
    /// Looks at the front of a surface from `point` (m).
    #[must_use]
    pub fn new(patch: &Patch, point: DVec3) -> Self {
        match *patch {
            Patch::Parallelogram(c, u, v) => Self::of_polygon(&[c, c + u, c + u + v, c + v], point),
            Patch::Triangle(a, b, c) => Self::of_polygon(&[a, b, c], point),
            Patch::Ellipse(c, u, v) => Self {
                form: Form::Round(Round::new(Curved::Ellipse { centre: c - point, u, v })),
                area: PI * u.cross(v).length(),
            },
            Patch::Sphere(c, radius) => Self {
                form: Form::Round(Round::new(Curved::sphere(c - point, radius))),
                area: 4.0 * PI * radius * radius,
            },
            Patch::Tube(base, axis, radius) => Self {
                form: Form::Round(Round::new(Curved::tube(base - point, axis, radius))),
                area: 2.0 * PI * radius * axis.length(),
            },
        }
    }

    /// Looks at the front of a convex polygon: its corners run counter-clockwise when seen from there.
    #[must_use]
    pub fn of_polygon(corners: &[DVec3], point: DVec3) -> Self {
        let flat = Flat::new(corners, point);
        let area = flat.area();
        Self { form: Form::Flat(flat), area }
    }

    /// Area of the whole surface (m²), seen or not.
    #[must_use]
    pub fn whole_area(&self) -> f64 {
        self.area
    }

    /// The cell of a surface point.
    ///
    /// * `place` – relative to the point that the outlook was made for (m)
    #[must_use]
    pub fn cell(&self, place: DVec3) -> usize {
        let [i, j] = match &self.form {
            Form::Flat(flat) => flat.cell(place),
            Form::Round(round) => round.cell(place),
        };
        i * SIDE + j
    }

    /// What is in each cell.
    ///
    /// * `offset` – how far beside the point that the outlook was made for (m)
    /// * `normal` – of the receiver
    #[must_use]
    pub fn seen(&self, offset: DVec3, normal: DVec3) -> [Amounts; CELLS] {
        std::array::from_fn(|cell| {
            let (i, j) = (cell / SIDE, cell % SIDE);
            match &self.form {
                Form::Flat(flat) => flat.seen(offset, normal, [i, j]),
                Form::Round(round) => round.seen(offset, normal, [i, j]),
            }
        })
    }

    /// What is in all cells together.
    #[must_use]
    pub fn total(&self, normal: DVec3) -> Amounts {
        self.seen(DVec3::ZERO, normal).into_iter().fold(Amounts::default(), Amounts::plus)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle;

    #[track_caller]
    fn agree(what: &str, seen: f64, closed: f64, tolerance: f64) {
        assert!((seen - closed).abs() <= tolerance * closed.abs(), "{what}: {seen} instead of {closed}");
    }

    /// Normals from facing to hardly above the horizon of a light overhead.
    fn normals() -> [DVec3; 4] {
        [[0.0, 1.0], [0.6, 0.8], [1.0, 0.02], [0.9, -0.1]].map(|[x, z]| DVec3::new(x, 0.1, z).normalize())
    }

    #[test]
    fn polygons_agree_with_lambert_from_a_millionth_to_ten_sizes() {
        let [a, b, c] = [DVec3::new(-0.6, -0.5, 0.0), DVec3::new(-0.2, 0.8, 0.0), DVec3::new(0.9, -0.3, 0.0)];
        for height in [1e-6, 1e-3, 0.3, 1.0, 10.0] {
            for normal in normals() {
                let point = DVec3::new(0.5 * height, 0.1 * height, -height);
                let total = Outlook::new(&Patch::Triangle(a, b, c), point).total(normal);
                let lambert = oracle::polygon_irradiance(point, normal, &[a, b, c]);
                agree("irradiance", total.irradiance, lambert, 1e-7);
                let angle = oracle::triangle_solid_angle(point, [a, b, c]);
                agree("solid angle", total.solid_angle, angle, 1e-7);
                agree("area", total.area, 0.5 * (b - a).cross(c - a).length(), 1e-7);
            }
        }
    }

    #[test]
    fn disks_agree_with_closed_forms_from_a_millionth_to_a_million_radii() {
        for height in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            let disk = Patch::Ellipse(DVec3::Z * height, DVec3::Y, DVec3::X);
            let total = Outlook::new(&disk, DVec3::ZERO).total(DVec3::Z);
            agree("irradiance", total.irradiance, PI / (1.0 + height * height), 1e-7);
            let slant = height.hypot(1.0);
            agree("solid angle", total.solid_angle, 2.0 * PI / (slant * (slant + height)), 1e-7);
            let aside = Outlook::new(&disk, DVec3::X * 0.5).total(DVec3::Z);
            let sum = 0.25 + height * height + 1.0;
            let root = (sum * sum - 1.0).sqrt();
            // From afar with the difference of squares written out.
            let far = (4.0 * sum - 5.0) / (root * (root + sum - 2.0));
            let share = if sum > 2.0 { far } else { 1.0 - (sum - 2.0) / root };
            agree("irradiance aside", aside.irradiance, 0.5 * PI * share, 1e-7);
        }
        let disk = Patch::Ellipse(DVec3::new(0.0, 0.0, 2.0), DVec3::Y * 1.5, DVec3::X * 1.5);
        let cut = Outlook::new(&disk, DVec3::X * 3.0).total(DVec3::NEG_X);
        agree("cut", cut.irradiance, oracle::disk_at_right_angles(1.5, 2.0, 3.0), 2e-7);
    }

    #[test]
    fn spheres_agree_with_closed_forms_from_a_millionth_to_a_million_radii() {
        for gap in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            let distance: f64 = 1.0 + gap;
            let ball = Patch::Sphere(DVec3::Z * distance, 1.0);
            let facing = Outlook::new(&ball, DVec3::ZERO).total(DVec3::Z);
            agree("irradiance", facing.irradiance, PI / (distance * distance), 1e-7);
            agree("solid angle", facing.solid_angle, oracle::sphere_solid_angle(1.0 / distance), 1e-7);
            let horizon = Outlook::new(&ball, DVec3::ZERO).total(DVec3::X);
            let s = 1.0 / distance;
            let sigma = s.asin();
            // σ − sin σ cos σ, as a series where it cancels.
            let series = s.powi(3) * (2.0 / 3.0 + s * s * 0.2);
            let closed = if s < 1e-2 { series } else { sigma - sigma.sin() * sigma.cos() };
            agree("on the horizon", horizon.irradiance, closed, 1e-7);
            for normal in normals() {
                let total = Outlook::new(&ball, DVec3::ZERO).total(normal);
                if gap < 1e2 && normal.z > -s {
                    agree("cut", total.irradiance, oracle::sphere(sigma, normal.z), 1e-6);
                }
            }
        }
    }

    #[test]
    fn tubes_agree_with_closed_forms_and_with_the_integral() {
        let tube = Patch::Tube(DVec3::ZERO, DVec3::Y * 3.0, 0.5);
        for distance in [0.5 + 1e-6, 0.501, 2.0, 500.0] {
            let total = Outlook::new(&tube, DVec3::X * distance).total(DVec3::NEG_X);
            let closed = oracle::tube_from_its_end(0.5, 3.0, distance);
            agree("irradiance", total.irradiance, closed, if distance > 100.0 { 1e-4 } else { 1e-7 });
        }
        let (point, normal) = (DVec3::new(1.2, -0.5, 0.3), DVec3::new(-0.3, 0.2, 0.9).normalize());
        let total = Outlook::new(&tube, point).total(normal);
        agree("cut", total.irradiance, tube.irradiance(point, normal), 1e-3);
        agree("solid angle", total.solid_angle, tube.solid_angle(point), 1e-3);
        assert_eq!(Outlook::new(&tube, DVec3::new(0.2, 1.0, 0.0)).total(normal), Amounts::default());
    }

    #[test]
    fn second_moments_are_those_of_the_closed_forms() {
        let disk = Patch::Ellipse(DVec3::Z, DVec3::Y, DVec3::X);
        let outlook = Outlook::new(&disk, DVec3::ZERO);
        let total = outlook.total(DVec3::Z);
        let variance = outlook.whole_area() * total.geometry_squared - total.irradiance.powi(2);
        agree("by area", variance, disk.area_sampling_variance(DVec3::ZERO, DVec3::Z), 1e-7);
        // A cone of directions: (1 − c)² / (3 (1 + c)²), c the cosine of its angle.
        let ball = Outlook::new(&Patch::Sphere(DVec3::Z * 2.0, 1.0), DVec3::ZERO).total(DVec3::Z);
        let c = 0.75_f64.sqrt();
        let relative = (1.0 - c).powi(2) / (3.0 * (1.0 + c).powi(2));
        let variance = ball.solid_angle * ball.cos_squared / ball.irradiance.powi(2) - 1.0;
        agree("by solid angle", variance, relative, 1e-7);
    }

    #[test]
    fn the_cell_of_a_place_is_the_one_that_holds_it() {
        let point = DVec3::new(0.3, -0.2, -0.7);
        for patch in [
            Patch::Parallelogram(DVec3::new(-1.0, -1.0, 0.0), DVec3::Y * 2.0, DVec3::X * 2.0),
            Patch::Ellipse(DVec3::ZERO, DVec3::Y * 0.4, DVec3::X),
            Patch::Sphere(DVec3::Z, 1.2),
            Patch::Tube(DVec3::NEG_X, DVec3::X * 2.0, 0.2),
        ] {
            let outlook = Outlook::new(&patch, point);
            let mut held = [0.0; CELLS];
            patch.integrate(120, |p, n| {
                let to_light = p - point;
                held[outlook.cell(to_light)] += f64::from(n.dot(to_light) < 0.0);
                0.0
            });
            let visited: f64 = held.iter().sum();
            let cells = outlook.seen(DVec3::ZERO, DVec3::Z);
            for (cell, amounts) in cells.iter().enumerate() {
                assert!(amounts.area > 0.0 || held[cell] == 0.0, "{patch:?} {cell}");
                assert!(held[cell] > 0.0 || amounts.area < 1e-3, "{patch:?} {cell} of {visited}");
            }
        }
    }
}
