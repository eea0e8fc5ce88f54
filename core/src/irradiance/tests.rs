use super::*;
use crate::light::Receiver;
use crate::num;
use crate::projected::oracle::{self, double};
use crate::shape::{Rectangle, Triangle};
use glam::{DVec3, Quat, Vec3};
use std::vec::Vec;

fn explore(cell: &mut (f64, std::string::String), value: f32, from: &Receiver, corners: &[DVec3], what: std::string::String) {
    let exact = oracle::projected_solid_angle(from, corners);
    if exact != 0.0 && (f64::from(value) - exact).abs() < 1e-19 { return; }
    if corners.iter().all(|c| from.normal.as_dvec3().dot(*c - from.point.as_dvec3()) <= 0.0) { assert!(value == 0.0); return }
    let omega = oracle::solid_angle(from, corners).max(0.01*oracle::solid_angle_all(from, corners));
    let err = (f64::from(value) - exact).abs();
    let bad = if err == 0.0 { 0.0 } else { err / (1e-5 * exact + 4e-7 * omega) };
    if !(bad <= cell.0) {
        *cell = (bad, std::format!("{what}: {value} {exact} omega {omega} rel {:e}", err / exact));
    }
}

#[test]
fn explore_matrix() {
    for scale in [1e-6_f32, 1.0, 1e6] {
    for aspect in [1.0_f32, 1e3, 1e6] {
    for dist in [1e-6_f32, 1e-3, 0.1, 1.0, 1e3, 1e6] {
    for angle in [0.0_f32, 1.0472, std::f32::consts::FRAC_PI_2 - 1e-3, 0.7] {
        let mut cells = [(0.0, std::string::String::new()), (0.0, std::string::String::new())];
        for i in 0..200u32 {
            let r = |k: u32| num::unit_f32(num::hash2(i, k));
            let q = if i % 4 == 0 { Quat::IDENTITY } else { Quat::from_euler(glam::EulerRot::XYZ, r(1) * 6.0, r(2) * 6.0, r(3) * 6.0) };
            let (u, v) = (q * Vec3::X * 0.5 * scale, q * Vec3::Y * 0.5 * scale / aspect);
            let normal = q * Vec3::Z;
            let centre = if i % 3 == 0 { Vec3::new(r(4), r(5), r(6)) * scale } else { Vec3::ZERO };
            let rect = Rectangle::new(centre, u, v).unwrap();
            let aside = match i % 5 { 0 => q * Vec3::X, 1 => q * Vec3::Y, _ => q * Vec3::new((r(7) * 6.3).cos(), (r(7) * 6.3).sin(), 0.0) };
            let foot = match i % 7 { 0 => centre, 1 => centre + u, 2 => centre + u + v, 3 => centre + u * 2.0 , _ => centre + u * (2.0 * r(8) - 1.0) + v * (2.0 * r(9) - 1.0) };
            let out = normal * angle.cos() + aside * angle.sin();
            let point = foot + out * (dist * scale);
            let n = match i % 6 { 0 => -out, 1 => -normal, 2 => (aside - out*0.1).normalize(), 3 => (normal.cross(aside) * 85f32.to_radians().sin() - out * 85f32.to_radians().cos()).normalize(), 4 => aside, _ => crate::warp::uniform_sphere([r(10), r(11)]) };
            let from = Receiver { point, normal: n };
            let (c, ud, vd) = (rect.centre().as_dvec3(), rect.half_u().as_dvec3(), rect.half_v().as_dvec3());
            let corners = [c - ud - vd, c + ud - vd, c + ud + vd, c - ud + vd];
            explore(&mut cells[0], rectangle(&from, &rect), &from, &corners, std::format!("i {i} {from:?} {rect:?}"));
            let tc = [centre - u - v, centre + u * (2.0 * r(12) - 1.0) + v, centre + u - v * r(13)];
            if let Ok(t) = Triangle::new(tc[0], tc[1], tc[2]) {
                explore(&mut cells[1], triangle(&from, &t), &from, &double(&tc), std::format!("i {i} {from:?} {t:?}"));
            }
        }
        for (c, name) in cells.iter().zip(["rect", "tri"]) {
            if c.0 > 1.0 { std::println!("{name} s{scale} a{aspect} d{dist} t{angle}: {:.2} {}", c.0, c.1); }
        }
    }}}}
}
