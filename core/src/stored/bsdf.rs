//! Materials as numbers.

use crate::Rgb;
use crate::bsdf::{AnyBsdf, GgxConductor, Lambert, MetallicRoughness, Phong, RoughPlastic, TwoSided};
use bytemuck::{Pod, Zeroable};

/// A model of reflection, as numbers.
///
/// | kind | model | numbers |
/// |---|---|---|
/// | 0 | none | |
/// | 1 | [`Lambert`] | reflectance |
/// | 2 | [`Phong`] | diffuse, specular, exponent, probability of sampling the highlight |
/// | 3 | [`GgxConductor`] | reflectance, two roughnesses, 1 when an index follows, its `η` and `k` |
/// | 4 | [`RoughPlastic`] | those of [`RoughPlastic::to_numbers`] |
/// | 5 | [`MetallicRoughness`] | base colour, how metallic, roughness |
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct StoredBsdf {
    kind: u32,
    numbers: [f32; RoughPlastic::NUMBERS],
}

/// The models of both sides of a surface, as numbers.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct StoredMaterial([StoredBsdf; 2]);

impl StoredBsdf {
    /// The numbers of a model; `None` for nothing.
    #[must_use]
    pub fn new(bsdf: Option<&AnyBsdf>) -> Self {
        let some = |kind, parts: &[&[f32]]| {
            let mut numbers = [0.0; RoughPlastic::NUMBERS];
            let given = parts.iter().copied().flatten().copied();
            numbers.iter_mut().zip(given).for_each(|(place, number)| *place = number);
            Self { kind, numbers }
        };
        match bsdf {
            None => some(0, &[]),
            Some(AnyBsdf::Lambert(b)) => some(1, &[&b.reflectance().to_array()]),
            Some(AnyBsdf::Phong(b)) => {
                let (diffuse, specular) = (b.diffuse().to_array(), b.specular().to_array());
                some(2, &[&diffuse, &specular, &[b.exponent(), b.specular_pmf()]])
            }
            Some(AnyBsdf::GgxConductor(b)) => {
                let (eta, k) = b.index().unwrap_or_default();
                let has = f32::from(u8::from(b.index().is_some()));
                let reflectance = b.reflectance().to_array();
                some(3, &[&reflectance, &b.alpha(), &[has], &eta.to_array(), &k.to_array()])
            }
            Some(AnyBsdf::RoughPlastic(b)) => some(4, &[&b.to_numbers()]),
            Some(AnyBsdf::MetallicRoughness(b)) => {
                some(5, &[&b.base_color().to_array(), &[b.metallic(), b.roughness()]])
            }
        }
    }

    /// The model, unchecked; `None` when there is no such kind, `Some(None)` for nothing.
    fn bsdf(&self) -> Option<Option<AnyBsdf>> {
        let [a, b, c, d, e, f, g, h, i, j, k, l, ..] = self.numbers;
        let colour = Rgb::new(a, b, c);
        Some(match self.kind {
            0 => None,
            1 => Some(AnyBsdf::Lambert(Lambert::baked(colour))),
            2 => Some(AnyBsdf::Phong(Phong::baked(colour, Rgb::new(d, e, f), g, h))),
            3 => {
                let index = (f != 0.0).then(|| (Rgb::new(g, h, i), Rgb::new(j, k, l)));
                Some(AnyBsdf::GgxConductor(GgxConductor::baked(colour, [d, e], index)))
            }
            4 => Some(AnyBsdf::RoughPlastic(RoughPlastic::baked(self.numbers))),
            5 => Some(AnyBsdf::MetallicRoughness(MetallicRoughness::baked(colour, d, e))),
            _ => return None,
        })
    }
}

impl StoredMaterial {
    /// The numbers of a material.
    #[must_use]
    pub fn new(material: &TwoSided<AnyBsdf>) -> Self {
        Self([Some(&material.front), material.back.as_ref()].map(StoredBsdf::new))
    }

    /// The material, unchecked; `None` when there is no such kind, or nothing on the front.
    #[must_use]
    pub fn material(&self) -> Option<TwoSided<AnyBsdf>> {
        let [front, back] = &self.0;
        Some(TwoSided { front: front.bsdf()??, back: back.bsdf()? })
    }
}
