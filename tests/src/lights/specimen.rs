//! The shapes that lights have, as the checks need them.

use crate::oracle::{self, Outlook, Patch};
use halflight::glam::{DVec3, Vec3};
use halflight::light::SampledShape;
use halflight::shape::{Cylinder, Disk, Polygon, Rectangle, Sphere, Triangle};

/// A shape with its exact geometry.
pub trait Specimen: SampledShape + std::fmt::Debug {
    /// The same with all lengths times `k`.
    fn scaled(self, k: f32) -> Self;

    /// The same facing the other way.
    fn turned(self) -> Self;

    /// A point of the surface with its normal.
    fn foot(&self) -> (Vec3, Vec3);

    /// A sphere around it.
    fn bounding_sphere(&self) -> (Vec3, f32);

    /// The surface in double precision.
    fn patch(&self) -> Patch;

    /// The surface as it is seen from `point`, in cells.
    fn outlook(&self, point: DVec3) -> Outlook {
        Outlook::new(&self.patch(), point)
    }

    /// True when only one side can be seen from one place.
    const FLAT: bool = true;

    /// Solid angle of the front.
    fn solid_angle(&self, from: Vec3) -> f64 {
        self.patch().solid_angle(from.as_dvec3())
    }

    /// Irradiance from the front.
    fn irradiance(&self, from: Vec3, normal: Vec3) -> f64 {
        self.patch().irradiance(from.as_dvec3(), normal.as_dvec3())
    }
}

impl Specimen for Rectangle {
    fn scaled(self, k: f32) -> Self {
        Self::new(self.centre() * k, self.half_u() * k, self.half_v() * k).expect("a proper rectangle")
    }

    fn turned(self) -> Self {
        self.flipped()
    }

    fn foot(&self) -> (Vec3, Vec3) {
        (self.centre(), self.normal())
    }

    fn bounding_sphere(&self) -> (Vec3, f32) {
        (self.centre(), (self.half_u() + self.half_v()).length())
    }

    fn patch(&self) -> Patch {
        let (c, u, v) = (self.centre().as_dvec3(), self.half_u().as_dvec3(), self.half_v().as_dvec3());
        Patch::Parallelogram(c - u - v, u * 2.0, v * 2.0)
    }
}

impl Specimen for Disk {
    fn scaled(self, k: f32) -> Self {
        Self::new(self.centre() * k, self.axis_u() * k, self.axis_v() * k).expect("a proper disk")
    }

    fn turned(self) -> Self {
        self.flipped()
    }

    fn foot(&self) -> (Vec3, Vec3) {
        (self.centre(), self.normal())
    }

    fn bounding_sphere(&self) -> (Vec3, f32) {
        (self.centre(), self.axis_u().length().max(self.axis_v().length()))
    }

    fn patch(&self) -> Patch {
        Patch::Ellipse(self.centre().as_dvec3(), self.axis_u().as_dvec3(), self.axis_v().as_dvec3())
    }
}

impl Specimen for Triangle {
    fn scaled(self, k: f32) -> Self {
        let [a, b, c] = self.corners().map(|p| p * k);
        Self::new(a, b, c).expect("a proper triangle")
    }

    fn turned(self) -> Self {
        self.flipped()
    }

    fn foot(&self) -> (Vec3, Vec3) {
        (self.point(0.3, 0.3).point, self.normal())
    }

    fn bounding_sphere(&self) -> (Vec3, f32) {
        let [a, b, c] = self.corners();
        let centre = (a + b + c) / 3.0;
        (centre, [a, b, c].into_iter().map(|p| p.distance(centre)).fold(0.0, f32::max))
    }

    fn patch(&self) -> Patch {
        let [a, b, c] = self.corners().map(|p| p.as_dvec3());
        Patch::Triangle(a, b, c)
    }

    fn solid_angle(&self, from: Vec3) -> f64 {
        let corners = self.corners().map(|p| p.as_dvec3());
        oracle::triangle_solid_angle(from.as_dvec3(), corners)
    }
}

impl Specimen for Polygon {
    fn scaled(self, k: f32) -> Self {
        let corners: Vec<Vec3> = self.corners().iter().map(|p| *p * k).collect();
        Self::new(&corners).expect("a proper polygon")
    }

    fn turned(self) -> Self {
        self.flipped()
    }

    fn foot(&self) -> (Vec3, Vec3) {
        (self.bounding_sphere().0, self.normal())
    }

    fn bounding_sphere(&self) -> (Vec3, f32) {
        let corners = self.corners();
        let centre = corners.iter().sum::<Vec3>() / corners.len() as f32;
        (centre, corners.iter().map(|p| p.distance(centre)).fold(0.0, f32::max))
    }

    /// The first triangle of the fan alone.
    fn patch(&self) -> Patch {
        let corner = |i: usize| self.corners()[i].as_dvec3();
        Patch::Triangle(corner(0), corner(1), corner(2))
    }

    fn outlook(&self, point: DVec3) -> Outlook {
        let corners: Vec<DVec3> = self.corners().iter().map(|p| p.as_dvec3()).collect();
        Outlook::of_polygon(&corners, point)
    }

    fn solid_angle(&self, from: Vec3) -> f64 {
        let (first, rest) = self.corners().split_first().expect("corners");
        let fan = rest.windows(2).map(|pair| [*first, pair[0], pair[1]].map(|p| p.as_dvec3()));
        fan.map(|corners| oracle::triangle_solid_angle(from.as_dvec3(), corners)).sum()
    }
}

impl Specimen for Sphere {
    const FLAT: bool = false;

    fn scaled(self, k: f32) -> Self {
        let sphere = Self::new(self.centre() * k, self.radius() * k).expect("a proper sphere");
        if self.is_inward() { sphere.flipped() } else { sphere }
    }

    fn turned(self) -> Self {
        self.flipped()
    }

    fn foot(&self) -> (Vec3, Vec3) {
        let at = self.point(Vec3::new(0.6, 0.64, -0.48));
        (at.point, at.normal)
    }

    fn bounding_sphere(&self) -> (Vec3, f32) {
        (self.centre(), self.radius())
    }

    fn patch(&self) -> Patch {
        let r = f64::from(self.radius());
        Patch::Sphere(self.centre().as_dvec3(), r)
    }

    fn solid_angle(&self, from: Vec3) -> f64 {
        let s = f64::from(self.radius()) / (self.centre() - from).as_dvec3().length();
        match (s < 1.0, self.is_inward()) {
            (true, false) => oracle::sphere_solid_angle(s),
            (false, true) => 4.0 * std::f64::consts::PI,
            _ => 0.0,
        }
    }

    fn irradiance(&self, from: Vec3, normal: Vec3) -> f64 {
        let v = (self.centre() - from).as_dvec3();
        let s = f64::from(self.radius()) / v.length();
        match (s < 1.0, self.is_inward()) {
            (true, false) => oracle::sphere(s.asin(), normal.as_dvec3().dot(v) / v.length()),
            (false, true) => std::f64::consts::PI,
            _ => 0.0,
        }
    }
}

impl Specimen for Cylinder {
    const FLAT: bool = false;

    fn scaled(self, k: f32) -> Self {
        let tube = Self::new(self.base() * k, self.axis() * k, self.radius() * k).expect("a proper cylinder");
        if self.is_inward() { tube.flipped() } else { tube }
    }

    fn turned(self) -> Self {
        self.flipped()
    }

    fn foot(&self) -> (Vec3, Vec3) {
        let at = self.point(0.4, self.unit_axis().any_orthonormal_vector());
        (at.point, at.normal)
    }

    fn bounding_sphere(&self) -> (Vec3, f32) {
        (self.base() + self.axis() * 0.5, (0.5 * self.axis().length()).hypot(self.radius()))
    }

    fn patch(&self) -> Patch {
        Patch::Tube(self.base().as_dvec3(), self.axis().as_dvec3(), f64::from(self.radius()))
    }

    fn solid_angle(&self, from: Vec3) -> f64 {
        let side = if self.is_inward() { -1.0 } else { 1.0 };
        let from = from.as_dvec3();
        self.patch().integrate(96, |p: DVec3, n| {
            let w = from - p;
            (side * n.dot(w)).max(0.0) / w.length().powi(3)
        })
    }
}
