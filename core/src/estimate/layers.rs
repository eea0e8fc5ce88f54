//! What else is seen in a pixel.

use super::{Observer, Pixel, PixelStats};
use crate::Rgb;
use crate::scene::Interaction;
use glam::Vec3;

/// A pixel that keeps, beside its radiance, what its camera rays meet: the means of albedo, normal and
/// depth over the samples that meet a surface, and how much of the light arrives there.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LayeredPixel {
    stats: PixelStats,
    surfaces: u32,
    albedo: Rgb,
    normal: Vec3,
    depth: f32,
    arriving: f32,
    unblocked: f32,
}

impl LayeredPixel {
    /// Fraction of light that is reflected, roughly; black where there is no surface.
    #[must_use]
    pub const fn albedo(&self) -> Rgb {
        self.albedo
    }

    /// Shading normal on the side that is seen, in world space: a mean of unit vectors, so that it is
    /// shorter where the pixel sees several; 0 where there is no surface.
    #[must_use]
    pub const fn normal(&self) -> Vec3 {
        self.normal
    }

    /// Distance from where the camera's rays begin (m); 0 where there is no surface.
    #[must_use]
    pub const fn depth(&self) -> f32 {
        self.depth
    }

    /// The fraction of the light that is seen: 0 in the umbra, between in the penumbra, 1 where nothing
    /// is in the way.
    ///
    /// It is `∫ f_r L V cos θ dω / ∫ f_r L cos θ dω`, both averaged over the channels and the pixel
    /// and estimated by the same light samples. 0 where no light could arrive: on surfaces that
    /// face away from every light, and where there is none.
    #[must_use]
    pub fn visibility(&self) -> f32 {
        if self.unblocked > 0.0 { (self.arriving / self.unblocked).min(1.0) } else { 0.0 }
    }
}

impl LayeredPixel {
    /// Every bit of it, for keeping it elsewhere: those of its radiance, the samples that met a surface,
    /// and as bits of `f32` albedo, normal, depth, and the light that arrives and that could.
    #[must_use]
    pub const fn to_words(&self) -> [u32; 18] {
        let [a, b, c, d, e, f, g, h] = self.stats.to_words();
        let w = f32::to_bits;
        let (i, j, k) = (w(self.albedo.r), w(self.albedo.g), w(self.albedo.b));
        let (l, m, n) = (w(self.normal.x), w(self.normal.y), w(self.normal.z));
        let (depth, arriving, unblocked) = (w(self.depth), w(self.arriving), w(self.unblocked));
        [a, b, c, d, e, f, g, h, self.surfaces, i, j, k, l, m, n, depth, arriving, unblocked]
    }

    /// What [`LayeredPixel::to_words`] was made from.
    #[must_use]
    pub const fn from_words(words: [u32; 18]) -> Self {
        let [a, b, c, d, e, f, g, h, surfaces, i, j, k, l, m, n, depth, arriving, unblocked] = words;
        let float = f32::from_bits;
        Self {
            stats: PixelStats::from_words([a, b, c, d, e, f, g, h]),
            surfaces,
            albedo: Rgb::new(float(i), float(j), float(k)),
            normal: Vec3::new(float(l), float(m), float(n)),
            depth: float(depth),
            arriving: float(arriving),
            unblocked: float(unblocked),
        }
    }
}

impl Observer for LayeredPixel {
    fn surface(&mut self, at: &Interaction, toward: Vec3, albedo: impl FnOnce() -> Rgb) {
        let albedo = albedo();
        if !(albedo.is_finite() && at.distance.is_finite()) {
            return;
        }
        self.surfaces = self.surfaces.saturating_add(1);
        let share = 1.0 / self.surfaces as f32;
        self.albedo += (albedo - self.albedo) * share;
        self.normal += (at.receiver(toward).normal - self.normal) * share;
        self.depth += (at.distance - self.depth) * share;
    }

    fn light(&mut self, arrives: bool, unblocked: impl FnOnce() -> f32) {
        let unblocked = unblocked();
        // What would drown all others, or is no number, says nothing of a fraction.
        if unblocked > 0.0 && (self.unblocked + unblocked).is_finite() {
            self.unblocked += unblocked;
            self.arriving += if arrives { unblocked } else { 0.0 };
        }
    }
}

impl Pixel for LayeredPixel {
    fn stats(&self) -> &PixelStats {
        &self.stats
    }

    fn add(&mut self, sample: Rgb) {
        self.stats.add(sample);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_keep_every_bit() {
        let words = core::array::from_fn(|i| (i as f32 + 0.1).to_bits());
        let pixel = LayeredPixel::from_words(words);
        assert_eq!(pixel.to_words(), words);
        assert_eq!((pixel.albedo().b, pixel.normal().x, pixel.depth()), (11.1, 12.1, 15.1));
    }

    #[test]
    fn visibility_is_the_part_that_arrives_by_weight() {
        let mut pixel = LayeredPixel::default();
        assert_eq!(pixel.visibility(), 0.0);
        pixel.light(true, || 3.0);
        pixel.light(false, || 1.0);
        for nothing in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            pixel.light(false, || nothing);
        }
        assert_eq!(pixel.visibility(), 0.75);
    }
}
