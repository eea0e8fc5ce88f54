//! Disks and ellipses against Lambert's integral along their edge, in double precision.

use super::disk;
use crate::light::Receiver;
use crate::num::{self, FRAC_PI_2, TAU};
use crate::shape::Disk;
use glam::{DVec3, Quat, Vec3};

/// A point of the edge from the receiver, and how fast it moves.
fn edge(from: &Receiver, disk: &Disk, t: f64) -> (DVec3, DVec3) {
    let centre = disk.centre().as_dvec3() - from.point.as_dvec3();
    let (u, v) = (disk.axis_u().as_dvec3(), disk.axis_v().as_dvec3());
    let (sin, cos) = (libm::sin(t), libm::cos(t));
    (centre + u * cos + v * sin, v * cos - u * sin)
}

/// `∫ n·(r × dr) / r²` by halving until a piece is short against its distance.
fn along(from: &Receiver, disk: &Disk, a: f64, b: f64, depth: u32) -> f64 {
    let [p, q] = [a, b].map(|t| edge(from, disk, t).0);
    if depth > 0 && (b - a > 0.7 || p.distance(q) > 0.5 * p.length().min(q.length())) {
        let middle = 0.5 * (a + b);
        return along(from, disk, a, middle, depth - 1) + along(from, disk, middle, b, depth - 1);
    }
    let at = |x: f64| {
        let (r, dr) = edge(from, disk, 0.5 * (a + b) + 0.5 * (b - a) * x);
        from.normal.as_dvec3().dot(r.cross(dr)) / r.length_squared()
    };
    const NODES: [(f64, f64); 4] = [
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_3),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
        (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
    ];
    0.5 * (b - a) * NODES.iter().map(|(x, w)| w * (at(-x) + at(*x))).sum::<f64>()
}

/// The sum over the edge above the horizon and along the horizon. It cancels for what is small.
fn exact(from: &Receiver, disk: &Disk) -> f64 {
    let normal = from.normal.as_dvec3();
    let up = normal.dot(disk.centre().as_dvec3() - from.point.as_dvec3());
    let (p, q) = (normal.dot(disk.axis_u().as_dvec3()), normal.dot(disk.axis_v().as_dvec3()));
    let most = libm::hypot(p, q);
    if up >= most {
        return 0.5 * along(from, disk, 0.0, core::f64::consts::TAU, 80).abs();
    } else if up <= -most {
        return 0.0;
    }
    let (middle, half) = (libm::atan2(q, p), libm::atan2(libm::sqrt((most - up) * (most + up)), -up));
    let (start, end) = (middle - half, middle + half);
    let (first, last) = (edge(from, disk, start).0, edge(from, disk, end).0);
    let across = last.cross(first);
    // As long as the normal, whose length is rounded.
    let back = libm::atan2(across.length(), last.dot(first)) * normal.length().copysign(normal.dot(across));
    0.5 * (along(from, disk, start, end, 80) + back).abs()
}

fn random(i: u32, k: u32) -> f32 {
    num::unit_f32(num::hash2(i, k))
}

/// A receiver `distance` sizes from a point near the disk, that faces it, has it cut, or any.
fn receiver(i: u32, disk: &Disk, distance: f32, angle: f32) -> Receiver {
    let (u, v, n) = (disk.axis_u(), disk.axis_v(), disk.normal());
    let (sin, cos) = num::sin_cos(TAU * random(i, 1));
    let aside = u.normalize() * cos + v.normalize() * sin;
    let (sin, cos) = num::sin_cos(angle);
    let out = n * cos + aside * sin;
    let inner = u * (random(i, 2) - 0.5) + v * (random(i, 3) - 0.5);
    let foot = disk.centre() + [Vec3::ZERO, u, v, inner][i as usize % 4];
    let any = crate::warp::uniform_sphere([random(i, 4), random(i, 5)]);
    let toward =
        (foot + u * (random(i, 6) - 0.5) - disk.centre() - out * (distance * u.length())).normalize();
    let cut = -out + toward * out.dot(toward);
    let normal = match i % 5 {
        0 => -out,
        1 => cut,
        2 => cut + any * 1e-3,
        3 => v.normalize() - toward * toward.dot(v.normalize()),
        _ => any,
    };
    Receiver {
        point: foot + out * (distance * u.length()),
        normal: normal.try_normalize().unwrap_or(Vec3::Y),
    }
}

/// All of scale × aspect × distance × angle.
fn matrix(mut check: impl FnMut(&Disk, &Receiver)) {
    for (scale, aspect) in
        [1e-6_f32, 1.0, 1e6].into_iter().flat_map(|s| [1.0_f32, 3.0, 1e3, 1e6].map(|a| (s, a)))
    {
        for distance in [0.0, 1e-6, 1e-3, 0.1, 1.0, 1e3, 1e6_f32] {
            for (i, angle) in (0..60).flat_map(|i| [0.0, 1.047, FRAC_PI_2 - 1e-3, 2.0].map(|a| (i, a))) {
                let euler = glam::EulerRot::XYZ;
                let turn =
                    Quat::from_euler(euler, random(i, 7) * 6.0, random(i, 8) * 6.0, random(i, 9) * 6.0);
                let turn = if i % 3 == 0 { Quat::IDENTITY } else { turn };
                let (u, v) = (turn * Vec3::X * scale, turn * Vec3::Y * (scale / aspect));
                let (u, v) = if i % 2 == 0 { (u, v) } else { (v, -u) };
                let Ok(disk) = Disk::new(Vec3::ZERO, u, v) else { continue };
                check(&disk, &receiver(i, &disk, distance, angle));
            }
        }
    }
}

#[test]
fn disks_and_ellipses_are_right_from_everywhere() {
    let mut compared = 0;
    matrix(|light, from| {
        let (e, truth) = (f64::from(disk(from, light)), exact(from, light));
        assert!((0.0..=f64::from(num::PI)).contains(&e), "{e} {light:?} {from:?}");
        // Heights in longer semi-axes. In the plane to what doubles can say, the edge may pass through
        // the receiver; next to it, a double says where along the ellipse the receiver is to few digits.
        let (u, v) = (light.axis_u().as_dvec3(), light.axis_v().as_dvec3());
        let long = u.length().max(v.length());
        let height = u.cross(v).normalize().dot(from.point.as_dvec3()).abs() / long;
        // What the edge integral keeps of what is small.
        let lost = 1e-15;
        if height > 1e-12 && truth > 1e8 * lost {
            compared += 1;
            let tolerance = if height < 1e-8 { 2e-4 } else { 5e-6 };
            let off = (e - truth).abs();
            assert!(off <= tolerance * truth + lost, "{:e}: {e} {truth} {light:?} {from:?}", off / truth);
        }
    });
    assert!(compared > 10_000, "{compared}");
}

#[test]
fn nothing_arrives_from_below_and_in_the_plane() {
    let light = Disk::new(Vec3::ZERO, Vec3::X, Vec3::Y * 0.5).unwrap();
    let at = |point, normal| disk(&Receiver { point, normal }, &light);
    assert_eq!(at(Vec3::Z, Vec3::Z), 0.0);
    assert_eq!(at(Vec3::X * 3.0, Vec3::NEG_X), 0.0);
    assert_eq!(at(Vec3::X * 0.3, Vec3::Z), 0.0);
}

#[test]
fn halves_on_either_side_of_a_horizon_are_the_whole() {
    let light = Disk::new(Vec3::ZERO, Vec3::X, Vec3::Y * 0.2).unwrap();
    for x in [0.0, 0.7, 3.0_f32] {
        let point = Vec3::new(x, 0.0, 0.4);
        // The horizon passes through the plane of symmetry.
        let half = disk(&Receiver { point, normal: Vec3::Y }, &light);
        let other = disk(&Receiver { point, normal: Vec3::NEG_Y }, &light);
        assert!(half > 0.0 && (half - other).abs() < 1e-7 * half);
    }
}

#[test]
fn distant_slivers_are_those_of_a_flat_segment() {
    // Cut through the middle: ∫ height dA / d³ with 2/3 a² b for the half ellipse, h = d.
    for (a, b, d) in [(1.0_f32, 1.0_f32, 1e4_f32), (1.0, 1e-3, 1e5), (1e-2, 1.0, 1e6)] {
        let light = Disk::new(Vec3::Z * d, Vec3::X * a, Vec3::Y * b).unwrap();
        let e = disk(&Receiver { point: Vec3::ZERO, normal: Vec3::X }, &light);
        let [a, b, d] = [a, b, d].map(f64::from);
        let flat = 2.0 / 3.0 * a * a * b / (d * d * d);
        assert!((f64::from(e) / flat - 1.0).abs() < 1e-6, "{e} {flat}");
    }
}
