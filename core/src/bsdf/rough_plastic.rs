//! A matte base under a rough transparent coat.

use super::error::check_reflectance;
use super::fresnel::dielectric;
use super::microfacet::Ggx;
use super::transmittance::{Transmittance, internal_reflectance};
use super::{Bsdf, BsdfError, BsdfSample};
use crate::Rgb;
use crate::num::{self, FRAC_1_PI, PI};
use glam::Vec3;

/// The largest relative index of refraction; that of diamond in air is 2.4.
const MAX_ETA: f32 = 4.0;

/// Plastic: light is reflected by GGX facets of a dielectric, or passes them, is reflected by a matte
/// base, any number of times where they throw it back, and leaves through them.
///
/// `f_r = k_s F D G1 G1 / (4 cos θ_o cos θ_i) + ρ / (1 − ρ' R) T(ω_o) T(ω_i) / (π η²)`, with `T` the
/// transmittance of the coat, `R` its reflectance from inside, and `ρ'` 1, or `ρ` when colours
/// shift. The same as `roughplastic` of Mitsuba 3 with `ggx`.
///
/// Source: Walter et al. 2007, *Microfacet Models for Refraction through Rough Surfaces*, EGSR; the base
/// as in Weidlich and Wilkie 2007, *Arbitrarily Layered Micro-Facet Surfaces*, GRAPHITE, section 3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughPlastic {
    diffuse: Rgb,
    specular: Rgb,
    facets: Ggx,
    eta: f32,
    nonlinear: bool,
    /// What the base reflects through a coat that lets everything out, over `π` (sr⁻¹).
    base: Rgb,
    through: Transmittance,
    internal_reflectance: f32,
    /// What a facet reflects at least: facing, where a dielectric reflects least.
    facing: f32,
    /// Weight of the facets when a lobe is chosen, beside that of the base.
    specular_weight: f32,
}

impl RoughPlastic {
    /// From the roughness `α` in `[1e-4, 1]` and the index of refraction inside over that outside, in
    /// `[1, 4]`. The base reflects a half, the coat what Fresnel's equations say.
    ///
    /// Integrates and fits the coat's transmittance: some milliseconds.
    ///
    /// # Errors
    /// When a number is outside its range.
    pub fn new(alpha: f32, eta: f32) -> Result<Self, BsdfError> {
        if !(1.0..=MAX_ETA).contains(&eta) {
            return Err(BsdfError::RelativeIndex(eta));
        }
        let facets = Ggx::new([alpha; 2])?;
        let plastic = Self {
            diffuse: Rgb::splat(0.5),
            specular: Rgb::WHITE,
            facets,
            eta,
            nonlinear: false,
            base: Rgb::BLACK,
            through: Transmittance::new(&facets, eta),
            internal_reflectance: internal_reflectance(&facets, eta),
            facing: dielectric(1.0, eta),
            specular_weight: 0.0,
        };
        Ok(plastic.prepared())
    }

    /// The same with another diffuse reflectance of the base, each channel in `[0, 1]`.
    ///
    /// # Errors
    /// When a channel is outside.
    pub fn with_diffuse(self, diffuse: Rgb) -> Result<Self, BsdfError> {
        let diffuse = check_reflectance("the diffuse reflectance", diffuse)?;
        Ok(Self { diffuse, ..self }.prepared())
    }

    /// The same with another factor on what the facets reflect, each channel in `[0, 1]`.
    ///
    /// # Errors
    /// When a channel is outside.
    pub fn with_specular(self, specular: Rgb) -> Result<Self, BsdfError> {
        let specular = check_reflectance("the specular reflectance", specular)?;
        Ok(Self { specular, ..self }.prepared())
    }

    /// The same with or without the shift of colours by light that the base reflects more than once.
    #[must_use]
    pub fn with_nonlinear(self, nonlinear: bool) -> Self {
        Self { nonlinear, ..self }.prepared()
    }

    /// Works out what does not depend on directions.
    #[inline]
    fn prepared(self) -> Self {
        let (d, s) = (self.diffuse.average(), self.specular.average());
        let back = |rho: f32| if self.nonlinear { rho } else { 1.0 } * self.internal_reflectance;
        let scale = FRAC_1_PI / (self.eta * self.eta);
        let base = self.diffuse.map(|rho| rho * scale / (1.0 - back(rho)));
        Self { base, specular_weight: if s > 0.0 { s / (d + s) } else { 0.0 }, ..self }
    }

    /// Diffuse reflectance of the base.
    #[must_use]
    pub const fn diffuse(&self) -> Rgb {
        self.diffuse
    }

    /// Factor on what the facets reflect.
    #[must_use]
    pub const fn specular(&self) -> Rgb {
        self.specular
    }

    /// Roughness.
    #[must_use]
    pub const fn alpha(&self) -> f32 {
        self.facets.alpha()[0]
    }

    /// Index of refraction inside over that outside.
    #[must_use]
    pub const fn eta(&self) -> f32 {
        self.eta
    }

    /// True when light that the base reflects more than once shifts its colour.
    #[must_use]
    pub const fn is_nonlinear(&self) -> bool {
        self.nonlinear
    }

    /// Probability of sampling the facets, from what they and the base roughly reflect; above 0 where
    /// they reflect anything.
    #[inline]
    fn specular_pmf(&self, wo: Vec3) -> f32 {
        let through = self.through.at(wo.z);
        let facets = num::larger(1.0 - through, self.facing) * self.specular_weight;
        let base = through * (1.0 - self.specular_weight);
        if facets > 0.0 { facets / (facets + base) } else { 0.0 }
    }

    /// All numbers that describe it, those that took long to work out included: what
    /// [`RoughPlastic::baked`] takes. Their order is this crate's own.
    #[must_use]
    pub const fn to_numbers(&self) -> [f32; Self::NUMBERS] {
        let (d, s, b, t) = (self.diffuse, self.specular, self.base, self.through.to_numbers());
        let nonlinear = if self.nonlinear { 1.0 } else { 0.0 };
        let mut all = [0.0; Self::NUMBERS];
        let own = [
            d.r,
            d.g,
            d.b,
            s.r,
            s.g,
            s.b,
            self.facets.alpha()[0],
            self.eta,
            nonlinear,
            b.r,
            b.g,
            b.b,
            self.internal_reflectance,
            self.facing,
            self.specular_weight,
        ];
        let mut i = 0;
        while i < all.len() {
            all[i] = if i < own.len() { own[i] } else { t[i - own.len()] };
            i += 1;
        }
        all
    }

    /// How many numbers describe it.
    pub const NUMBERS: usize = 15 + Transmittance::NUMBERS;

    /// Plastic that was checked before: for constants; see [`crate::Scene::baked`].
    ///
    /// * `numbers` – as [`RoughPlastic::to_numbers`] gave them
    #[must_use]
    pub const fn baked(numbers: [f32; Self::NUMBERS]) -> Self {
        let n = &numbers;
        let mut through = [0.0; Transmittance::NUMBERS];
        let mut i = 0;
        while i < through.len() {
            through[i] = n[n.len() - through.len() + i];
            i += 1;
        }
        Self {
            diffuse: Rgb::new(n[0], n[1], n[2]),
            specular: Rgb::new(n[3], n[4], n[5]),
            facets: Ggx::baked([n[6]; 2]),
            eta: n[7],
            nonlinear: n[8] != 0.0,
            base: Rgb::new(n[9], n[10], n[11]),
            through: Transmittance::baked(through),
            internal_reflectance: n[12],
            facing: n[13],
            specular_weight: n[14],
        }
    }
}

impl Bsdf for RoughPlastic {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        let Some(h) = Ggx::half(wo, wi) else { return Rgb::BLACK };
        let fresnel = dielectric(Ggx::facet_cosine(wo, wi, h), self.eta);
        self.specular * (fresnel * self.facets.reflection(wo, wi, h))
            + self.base * (self.through.at(wo.z) * self.through.at(wi.z))
    }

    /// Density: the mixture of that of visible facets and of `cos θ / π`.
    #[inline]
    fn sample(&self, wo: Vec3, u: [f32; 2], u_lobe: f32) -> Option<BsdfSample> {
        self.facets.sample_over_matte(self.specular_pmf(wo), wo, u, u_lobe)
    }

    #[inline]
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.facets.pdf_over_matte(self.specular_pmf(wo), wo, wi)
    }

    #[inline]
    fn lobe_solid_angle(&self) -> f32 {
        PI * self.alpha() * self.alpha()
    }

    /// What is reflected of light along the normal.
    fn albedo(&self) -> Rgb {
        // What the base sends out evenly passes the coat as diffuse light does.
        let out = (1.0 - self.internal_reflectance) * self.eta * self.eta;
        let base = self.base * (self.through.at(1.0) * out / FRAC_1_PI);
        base + self.specular * self.facing
    }

    /// That the coat's transmittance is that of its roughness is not checked: it lies in `[0, 1]` whatever
    /// its numbers are, as long as they are numbers.
    fn check(&self) -> Result<(), BsdfError> {
        check_reflectance("the diffuse reflectance", self.diffuse)?;
        check_reflectance("the specular reflectance", self.specular)?;
        Ggx::new(self.facets.alpha())?;
        if !(1.0..=MAX_ETA).contains(&self.eta) {
            return Err(BsdfError::RelativeIndex(self.eta));
        }
        let prepared = self.prepared();
        for (field, ok) in [
            ("the transmittance", self.through.to_numbers().iter().all(|n| n.is_finite())),
            ("the internal reflectance", (0.0..1.0).contains(&self.internal_reflectance)),
            ("the reflectance of a facet", self.facing == dielectric(1.0, self.eta)),
            ("what the base reflects", prepared.base == self.base),
            ("the probability of the coat", prepared.specular_weight == self.specular_weight),
        ] {
            if !ok {
                return Err(BsdfError::Derived { field });
            }
        }
        Ok(())
    }
}
