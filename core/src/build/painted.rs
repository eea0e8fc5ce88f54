//! Surfaces that emit a picture, owned.

use super::{BuildError, Emission, Object, TexelBuffer, TextureDescription};
use crate::Rgb;
use crate::light::{
    AnyLight, AreaLight, LuminanceGrid, Paint, Painted, PaintedLight, PaintedRectangle, SampledShape,
};
use crate::shape::AnyShape;
use crate::texture::{SurfaceUvs, Texels, Texture};
use core::mem::size_of_val;
use std::sync::Arc;
use std::vec;
use std::vec::Vec;

/// What a light with a picture borrows from.
#[derive(Debug, Clone)]
pub(super) struct PaintedBuffer {
    /// Index of the light.
    pub(super) light: usize,
    shape: AnyShape,
    two_sided: bool,
    paint: Paint,
    texels: Option<Arc<TexelBuffer>>,
    luminance: Option<(LuminanceGrid, Vec<f32>)>,
}

/// The picture of an object that emits it, looked at once for all of its surfaces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Emitted<'d> {
    object: &'d Object,
    emission: &'d Emission,
    description: &'d TextureDescription,
    texture: Texture<'d>,
    /// The largest value of each channel, and the mean.
    survey: [Rgb; 2],
}

impl<'d> Emitted<'d> {
    /// The picture that an object emits; `None` when it emits none.
    pub(super) fn new(object: &'d Object) -> Result<Option<Self>, BuildError> {
        let Some(emission) = &object.emission else { return Ok(None) };
        let Some(description) = &emission.texture else { return Ok(None) };
        let refused = |source| BuildError::Texture { of: object.name.clone(), source };
        let texture = description.texture().map_err(refused)?;
        let survey = [texture.largest(), texture.mean()];
        Ok(Some(Self { object, emission, description, texture, survey }))
    }
}

impl PaintedBuffer {
    /// The light that a shape with a picture is; `None` when it is black.
    pub(super) fn new(
        light: usize,
        emitted: &Emitted<'_>,
        shape: AnyShape,
        uvs: SurfaceUvs,
    ) -> Result<Option<Self>, BuildError> {
        let Emitted { object, emission, description, texture, survey } = *emitted;
        let factor = emission.radiance;
        let paint = match shape {
            AnyShape::Triangle(s) => Paint::surveyed(&s, &texture, uvs, factor, survey),
            AnyShape::Rectangle(s) => Paint::surveyed(&s, &texture, uvs, factor, survey),
            AnyShape::Disk(s) => Paint::surveyed(&s, &texture, uvs, factor, survey),
            AnyShape::Sphere(s) => Paint::surveyed(&s, &texture, uvs, factor, survey),
            AnyShape::Cylinder(s) => Paint::surveyed(&s, &texture, uvs, factor, survey),
        }
        .map_err(|source| BuildError::Light { object: object.name.clone(), source })?;
        let [largest, mean] = survey;
        if (largest * factor).is_black() {
            return Ok(None);
        }
        let (two_sided, texels) = (emission.two_sided, description.texels.clone());
        let mut buffer = Self { light, shape, two_sided, paint, texels, luminance: None };
        buffer.measure(mean * factor);
        Ok(Some(buffer))
    }

    /// Makes the table of a rectangle whose edges are those of its picture, with the given mean.
    fn measure(&mut self, mean: Rgb) {
        let AnyShape::Rectangle(shape) = self.shape else { return };
        let light = AreaLight::painted(shape, self.radiance());
        let Some(grid) = PaintedRectangle::grid(&light) else { return };
        let mut table = vec![0.0; grid.table_len()];
        if PaintedRectangle::fill(&light, &grid, &mut table) {
            self.luminance = Some((grid, table));
            self.paint = self.paint.with_mean(mean);
        }
    }

    fn radiance(&self) -> Painted<'_> {
        Painted::new(&self.paint, self.texels.as_ref().map_or(Texels::NONE, |t| t.texels()))
    }

    /// The light, borrowed.
    pub(super) fn bound(&self) -> AnyLight<'_> {
        AnyLight::Painted(match self.shape {
            AnyShape::Triangle(s) => PaintedLight::Triangle(self.area(s)),
            AnyShape::Disk(s) => PaintedLight::Disk(self.area(s)),
            AnyShape::Sphere(s) => PaintedLight::Sphere(self.area(s)),
            AnyShape::Cylinder(s) => PaintedLight::Cylinder(self.area(s)),
            AnyShape::Rectangle(s) => {
                let (light, table) = (self.area(s), self.luminance.as_ref());
                match table.and_then(|(grid, table)| PaintedRectangle::new(light, grid, table)) {
                    Some(bright) => PaintedLight::Bright(bright),
                    None => PaintedLight::Rectangle(light),
                }
            }
        })
    }

    fn area<S: SampledShape>(&self, shape: S) -> AreaLight<S, Painted<'_>> {
        let light = AreaLight::painted(shape, self.radiance());
        if self.two_sided { light.two_sided() } else { light }
    }

    /// The texels, to be counted once where several surfaces share them.
    pub(super) fn texels(&self) -> Option<&Arc<TexelBuffer>> {
        self.texels.as_ref()
    }

    /// Bytes of its own.
    pub(super) fn bytes(&self) -> usize {
        size_of::<Self>() + self.luminance.as_ref().map_or(0, |(_, table)| size_of_val(&**table))
    }
}
