//! Direct lighting from area and environment lights, to a known accuracy, anywhere.
//!
//! The radiance that leaves a surface point is its own and what it reflects of the light that
//! arrives from all directions above it,
//!
//! ```text
//! L_o(p, ω_o) = L_e(p, ω_o) + ∫ f_r(p, ω_o, ω_i) L_i(p, ω_i) V(p, ω_i) cos θ_i dω_i
//! ```
//!
//! and the same over the surfaces A of the lights, with `dω = cos θ' dA / d²`:
//!
//! ```text
//! L_o(p, ω_o) = L_e(p, ω_o) + Σ_lights ∫ f_r L_e V G dA,      G = cos θ_i cos θ' / d²
//! ```
//!
//! `V`, the fraction of the light that is seen, is what makes umbra (0), penumbra (between) and light (1).
//! [`estimate::Direct`] estimates either form with n samples of each light, taken at places x (m⁻²) or
//! in directions ω (sr⁻¹) of known density p,
//!
//! ```text
//! L_o ≈ L_e + Σ_lights 1/n Σ_j  f_r L_e V G / p(x_j)   =   L_e + Σ_lights 1/n Σ_j  f_r L_i V cos θ_j / p(ω_j)
//! ```
//!
//! or takes samples of the BSDF too, and weighs both by what their densities say of each other.
//! [`estimate::Path`] follows the light of other surfaces too.
//!
//! The crate is `no_std` and allocates nothing: a [`Scene`] is a set of borrowed slices, traversal uses
//! a stack of fixed size, and everything is generic over the kinds of shape, light and material, so that a
//! program links only what its scene holds. Its arithmetic is the same on every target: no platform's
//! libm, no fused multiply-add, a fixed order of sums.
//!
//! # A lamp over a floor, without a heap
//!
//! ```
//! use halflight::bsdf::Lambert;
//! use halflight::bvh::{Bvh, Child, Node};
//! use halflight::estimate::{Direct, Estimator, PixelStats};
//! use halflight::geom::Ray;
//! use halflight::glam::Vec3;
//! use halflight::light::AreaLight;
//! use halflight::scene::{NONE, Scene, Surface, Tables};
//! use halflight::sequence::{Sequence, Sobol};
//! use halflight::shape::{Rectangle, Shape};
//! use halflight::Rgb;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let floor = Rectangle::new(Vec3::ZERO, Vec3::X * 5.0, Vec3::NEG_Z * 5.0)?;
//! let panel = Rectangle::new(Vec3::Y * 2.0, Vec3::X * 0.5, Vec3::Z * 0.5)?; // faces down
//! let lights = [AreaLight::new(panel, Rgb::splat(10.0))?];
//! let materials = [Lambert::new(Rgb::splat(0.5))?];
//! let surfaces = [
//!     Surface { shape: floor, material: 0, light: NONE, normals: NONE, uvs: NONE },
//!     Surface { shape: panel, material: 0, light: 0, normals: NONE, uvs: NONE },
//! ];
//! let nodes = [Node::EMPTY
//!     .with_child(0, Child::Leaf { first: 0, count: 1 }, floor.bounds())
//!     .with_child(1, Child::Leaf { first: 1, count: 1 }, panel.bounds())];
//! let tables = Tables { surfaces: &surfaces, lights: &lights, materials: &materials, ..Tables::EMPTY };
//! let scene = Scene::new(Bvh::new(&nodes, surfaces.len())?, tables)?;
//!
//! // What an eye at (0, 1, 3) sees of the floor under the lamp.
//! let (eye, mut sequence) = (Vec3::new(0.0, 1.0, 3.0), Sobol::new(1));
//! let ray = Ray::new(eye, (Vec3::ZERO - eye).normalize());
//! let mut seen = PixelStats::NEW;
//! for sample in 0..256 {
//!     sequence.start(0, sample);
//!     seen.add(Direct::default().sample(&scene, &ray, f32::INFINITY, &mut sequence));
//! }
//! // ρ E / π, with E from four quarter panels over their corner (h = 2, half-edge 0.5).
//! let a = (1.0_f32 + 0.0625).sqrt();
//! let exact = 0.5 * 10.0 / core::f32::consts::PI * 4.0 * (0.25 / a) * (0.25 / a).atan();
//! assert!((seen.mean().r / exact - 1.0).abs() < 1e-3);
//! # Ok(())
//! # }
//! ```
//!
//! # Units
//!
//! | quantity | unit |
//! |---|---|
//! | radiance | W m⁻² sr⁻¹ |
//! | irradiance | W m⁻² |
//! | intensity | W sr⁻¹ |
//! | power | W |
//! | `pdf_area` | m⁻² |
//! | `pdf_solid_angle` | sr⁻¹ |
//! | `pmf` | 1 |
//! | lengths | m |
//! | angles | rad |
//!
//! Directions `wo` and `wi` are unit vectors that point away from the surface. Coordinates are
//! right-handed with y up; rows of a picture start at the top.
//!
//! # Features
//!
//! None is on by default. `bytes` borrows scenes from bytes. `build` makes trees and tables from owned scenes
//! (std), `load` reads scene files and meshes and has the built-in scenes (std, implies `build` and `bytes`).
//! `small` makes less code, which takes longer, for firmware; the bits of a picture are the same.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(any(test, feature = "build"))]
extern crate std;

pub mod bsdf;
#[cfg(feature = "build")]
pub mod build;
pub mod bvh;
pub mod camera;
pub mod choose;
pub mod estimate;
pub mod film;
pub mod geom;
pub mod irradiance;
pub mod light;
#[cfg(feature = "load")]
pub mod load;
pub mod material;
pub mod measure;
pub mod num;
pub mod projected;
mod rgb;
pub mod scene;
pub mod sequence;
pub mod shape;
pub mod solid_angle;
#[cfg(feature = "bytes")]
pub mod stored;
pub mod texture;
pub mod warp;

pub use camera::Camera;
pub use film::Film;
/// The vector types of the public interface.
pub use glam;
pub use rgb::Rgb;
pub use scene::Scene;

/// The code in the README.
#[cfg(all(doctest, feature = "load"))]
#[doc = include_str!("../../README.md")]
struct Readme;
