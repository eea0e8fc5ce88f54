//! Lights with receivers. Radiance is 1; lengths in metres.

use super::{Area, Environment, Specimen};
use halflight::Rgb;
use halflight::glam::Vec3;
use halflight::light::{AreaLight, Constant, Receiver, SurfaceDensity};
use halflight::shape::{Cylinder, Disk, Polygon, Rectangle, Sphere, Triangle};

/// A receiver at `point` with the direction of its normal.
#[must_use]
pub fn receiver(point: Vec3, normal: Vec3) -> Receiver {
    Receiver { point, normal: normal.normalize() }
}

/// A shape of radiance 1 seen from a receiver.
pub fn area<S: Specimen>(shape: S, from: Receiver) -> Area<S> {
    let light = AreaLight::new(shape, Rgb::WHITE).expect("a proper radiance");
    let measure = shape.solid_angle(from.point);
    Area { light, from, method: SurfaceDensity::Area, measure, projected: false, two_sided: false }
}

/// A receiver at the origin that looks up.
fn floor() -> Receiver {
    receiver(Vec3::ZERO, Vec3::Z)
}

/// `a` by `b`, facing down, `h` above the floor and beside it by `off`.
#[must_use]
pub fn rectangle_facing_down(a: f32, b: f32, h: f32, off: Vec3) -> Rectangle {
    Rectangle::new(off + Vec3::Z * h, Vec3::Y * (0.5 * b), Vec3::X * (0.5 * a)).expect("a proper rectangle")
}

/// A disk or ellipse facing down.
#[must_use]
pub fn disk_facing_down(a: f32, b: f32, h: f32, off: Vec3) -> Disk {
    Disk::new(off + Vec3::Z * h, Vec3::Y * b, Vec3::X * a).expect("a proper disk")
}

/// A rectangle right above.
#[must_use]
pub fn rectangle_overhead() -> Area<Rectangle> {
    area(rectangle_facing_down(1.0, 1.4, 1.0, Vec3::ZERO), floor())
}

/// A rectangle whose distance is a twentieth of its size.
#[must_use]
pub fn rectangle_near() -> Area<Rectangle> {
    area(rectangle_facing_down(1.0, 1.4, 0.05, Vec3::new(0.1, 0.2, 0.0)), floor())
}

/// A rectangle a thousand sizes away, turned.
#[must_use]
pub fn rectangle_far_away() -> Area<Rectangle> {
    from_afar(tilted_rectangle(), 1e3)
}

/// Seen edge-on, almost: 3° above the plane of the rectangle.
#[must_use]
pub fn rectangle_grazing() -> Area<Rectangle> {
    let from = receiver(Vec3::new(-2.0, 0.3, 0.0), Vec3::new(1.0, 0.0, 0.3));
    area(rectangle_facing_down(1.0, 1.4, 0.1, Vec3::ZERO), from)
}

/// A thin long rectangle of 5 × 10⁻⁴ sr.
#[must_use]
pub fn rectangle_thin() -> Area<Rectangle> {
    area(rectangle_facing_down(4.0, 5e-4, 1.0, Vec3::ZERO), floor())
}

/// Both sides emit, and the back is seen.
#[must_use]
pub fn rectangle_two_sided() -> Area<Rectangle> {
    let mut subject =
        area(rectangle_facing_down(1.0, 1.4, 1.0, Vec3::X * 0.5).flipped(), floor()).two_sided();
    subject.measure = subject.light.shape().flipped().solid_angle(Vec3::ZERO);
    subject
}

/// A disk right above.
#[must_use]
pub fn disk_overhead() -> Area<Disk> {
    area(disk_facing_down(0.6, 0.6, 1.0, Vec3::ZERO), floor())
}

/// An ellipse to one side.
#[must_use]
pub fn disk_as_ellipse_aside() -> Area<Disk> {
    area(disk_facing_down(0.9, 0.3, 0.7, Vec3::new(0.8, -0.4, 0.0)), floor())
}

/// Both sides emit, and the back is seen.
#[must_use]
pub fn disk_two_sided() -> Area<Disk> {
    let mut subject = area(disk_facing_down(0.6, 0.6, 0.5, Vec3::X * 0.2).flipped(), floor()).two_sided();
    subject.measure = subject.light.shape().flipped().solid_angle(Vec3::ZERO);
    subject
}

/// A disk that is a fiftieth of its radius away, its foot inside.
#[must_use]
pub fn disk_near() -> Area<Disk> {
    area(disk_facing_down(1.0, 1.0, 0.02, Vec3::new(0.3, -0.4, 0.0)), floor())
}

/// An ellipse a thousand radii away, seen from 40° off its normal.
#[must_use]
pub fn disk_far_away() -> Area<Disk> {
    from_afar(disk_facing_down(1.0, 0.7, 0.0, Vec3::ZERO), 1e3)
}

/// Seen edge-on, almost: 3° above the plane of the disk.
#[must_use]
pub fn disk_grazing() -> Area<Disk> {
    let from = receiver(Vec3::new(-2.0, 0.3, 0.0), Vec3::new(1.0, 0.0, 0.3));
    area(disk_facing_down(0.5, 0.5, 0.1, Vec3::ZERO), from)
}

/// An ellipse four times as long as wide, aslant.
#[must_use]
pub fn disk_aslant() -> Area<Disk> {
    let (u, v) = (Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.8, 0.6, 0.0));
    let disk = Disk::new(Vec3::new(0.3, 0.1, 1.0), v * 0.25, u).expect("a proper disk");
    area(disk, floor())
}

/// A sphere of `radius` whose centre is `distance` away from the receiver, up and aside.
#[must_use]
pub fn sphere(radius: f32, distance: f32) -> Area<Sphere> {
    let centre = Vec3::new(0.48, -0.36, 0.8) * distance;
    area(Sphere::new(centre, radius).expect("a proper sphere"), floor())
}

/// A sphere whose centre is seen at an elevation of sine `c`: the horizon may cut it.
#[must_use]
pub fn sphere_at_the_horizon(radius: f32, distance: f32, c: f32) -> Area<Sphere> {
    let centre = Vec3::new(0.8 * (1.0 - c * c).sqrt(), 0.6 * (1.0 - c * c).sqrt(), c) * distance;
    area(Sphere::new(centre, radius).expect("a proper sphere"), floor())
}

/// Both sides emit, seen from outside: the far side is hidden by the near one.
#[must_use]
pub fn sphere_two_sided() -> Area<Sphere> {
    sphere(1.0, 2.0).two_sided()
}

/// An inward sphere around the receiver.
#[must_use]
pub fn sphere_from_inside() -> Area<Sphere> {
    let shape = Sphere::new(Vec3::new(0.2, -0.3, 0.5), 1.0).expect("a proper sphere").flipped();
    area(shape, floor())
}

/// An inward sphere, from its own wall. The cosine is the weight: it cancels the density's.
#[must_use]
pub fn sphere_from_its_wall() -> Area<Sphere> {
    let shape = Sphere::new(Vec3::ZERO, 1.0).expect("a proper sphere").flipped();
    let wall = receiver(Vec3::NEG_Z * (1.0 - 1e-6), Vec3::Z);
    Area { measure: std::f64::consts::PI, projected: true, ..area(shape, wall) }
}

/// A triangle above.
#[must_use]
pub fn triangle_overhead() -> Area<Triangle> {
    area(triangle(), floor())
}

fn triangle() -> Triangle {
    let (a, b, c) = (Vec3::new(-0.5, -0.6, 1.0), Vec3::new(0.2, 0.9, 1.4), Vec3::new(0.8, -0.3, 0.9));
    Triangle::new(a, b, c).expect("a proper triangle")
}

/// A triangle a thousand sizes away.
#[must_use]
pub fn triangle_far_away() -> Area<Triangle> {
    from_afar(triangle(), 1e3)
}

/// Both sides emit, and the back is seen.
#[must_use]
pub fn triangle_two_sided() -> Area<Triangle> {
    area(triangle().flipped(), floor()).two_sided()
}

/// A triangle seen from a twentieth of its size, over its inside.
#[must_use]
pub fn triangle_near() -> Area<Triangle> {
    near(triangle(), 0.05)
}

/// A needle of aspect 10.
#[must_use]
pub fn triangle_needle() -> Area<Triangle> {
    let (a, b, c) = (Vec3::new(-1.0, 0.4, 0.9), Vec3::new(1.2, -0.3, 1.1), Vec3::new(1.2, -0.07, 1.1));
    area(Triangle::new(c, b, a).expect("a proper triangle"), floor())
}

/// Seen almost edge-on, from 6° above the plane of the triangle.
#[must_use]
pub fn triangle_grazing() -> Area<Triangle> {
    let (a, b, c) = (Vec3::new(-0.5, -0.6, 0.2), Vec3::new(0.1, 0.9, 0.2), Vec3::new(0.8, -0.3, 0.2));
    let from = receiver(Vec3::new(-2.0, 0.3, 0.0), Vec3::new(1.0, 0.0, 0.3));
    area(Triangle::new(a, b, c).expect("a proper triangle"), from)
}

/// A polygon of six corners above; one of them is on a line with its neighbours.
#[must_use]
pub fn polygon_overhead() -> Area<Polygon> {
    area(polygon(), floor())
}

fn polygon() -> Polygon {
    let flat = [[-0.6, -0.5], [-0.7, 0.2], [-0.2, 0.8], [0.3, 0.7], [0.8, 0.6], [0.5, -0.7]];
    let corners = flat.map(|[x, y]: [f32; 2]| Vec3::new(x, y, 1.0 + 0.25 * x - 0.125 * y));
    Polygon::new(&corners).expect("a proper polygon")
}

/// A polygon seen from a twentieth of its size, over its inside.
#[must_use]
pub fn polygon_near() -> Area<Polygon> {
    near(polygon(), 0.05)
}

/// A polygon a thousand sizes away.
#[must_use]
pub fn polygon_far_away() -> Area<Polygon> {
    from_afar(polygon(), 1e3)
}

/// Both sides emit, and the back is seen.
#[must_use]
pub fn polygon_two_sided() -> Area<Polygon> {
    area(polygon().flipped(), floor()).two_sided()
}

/// A standing tube, seen from its side.
#[must_use]
pub fn cylinder_beside() -> Area<Cylinder> {
    let tube = Cylinder::new(Vec3::new(1.0, 0.4, -0.3), Vec3::new(0.1, 0.2, 1.5), 0.3);
    area(tube.expect("a proper cylinder"), receiver(Vec3::ZERO, Vec3::X))
}

/// A tube whose wall is a tenth of its radius away.
#[must_use]
pub fn cylinder_near() -> Area<Cylinder> {
    let tube = Cylinder::new(Vec3::new(1.1, 0.0, -0.7), Vec3::Z * 2.0, 1.0);
    area(tube.expect("a proper cylinder"), receiver(Vec3::ZERO, Vec3::X))
}

/// A tube a hundred lengths away.
#[must_use]
pub fn cylinder_far_away() -> Area<Cylinder> {
    let tube = Cylinder::new(Vec3::ZERO, Vec3::new(0.1, 0.2, 1.0), 0.1);
    let from = receiver(Vec3::new(60.0, 64.0, -48.0), Vec3::new(-0.6, -0.64, 0.48));
    area(tube.expect("a proper cylinder"), from)
}

/// An inward tube around the receiver.
#[must_use]
pub fn cylinder_from_inside() -> Area<Cylinder> {
    let tube = Cylinder::new(Vec3::new(0.2, -0.1, -1.0), Vec3::new(0.1, 0.2, 2.5), 0.8);
    area(tube.expect("a proper cylinder").flipped(), receiver(Vec3::ZERO, Vec3::new(1.0, 0.2, 0.3)))
}

/// An environment over a tilted receiver.
#[must_use]
pub fn constant_over_a_slope() -> Environment<Constant> {
    let light = Constant::new(Rgb::WHITE).expect("a proper radiance");
    Environment { light, from: receiver(Vec3::ONE, Vec3::new(0.3, -0.5, 0.8)) }
}

/// Not aligned with any axis.
fn tilted_rectangle() -> Rectangle {
    let (u, v) = (Vec3::new(0.6, 0.64, -0.48), Vec3::new(-0.8, 0.48, -0.36));
    Rectangle::new(Vec3::ZERO, u * 0.5, v * 0.3).expect("a proper rectangle")
}

/// A shape and a receiver that faces it from before its foot.
fn near<S: Specimen>(shape: S, distance: f32) -> Area<S> {
    let (foot, normal) = shape.foot();
    area(shape, receiver(foot + normal * distance, -normal))
}

/// A shape and a receiver that faces it from 40° off its normal.
fn from_afar<S: Specimen>(shape: S, distance: f32) -> Area<S> {
    let (foot, normal) = shape.foot();
    let aside = normal.any_orthonormal_vector();
    let (sin, cos) = 40.0_f32.to_radians().sin_cos();
    let out = normal * cos + aside * sin;
    area(shape, receiver(foot + out * distance, -out))
}
