//! A picture of the radiance from all directions around the scene.

mod density;
pub(crate) mod grid;
pub(crate) mod sky;
pub(crate) mod table;

pub use density::EnvironmentDensity;
pub use sky::{ClearSky, SkyPart, SkyView};
pub use table::{DrawsBy, EnvironmentTable, Lobe};

use super::{Density, Emitter, LightError, LightSample, Receiver, SurfaceDensity};
use crate::Rgb;
use crate::geom::Frame;
use crate::num;
use crate::warp;
use glam::{Mat3, Vec3};
use grid::{Grid, Place};
use table::{Chosen, Levels, Plain, Weigh};

/// How far a transform may be from a rotation.
const RIGID: f32 = 1e-4;

/// An environment map in longitude and latitude, borrowed.
///
/// Radiance is interpolated between texels, and so is the density: bilinearly, in the same cells.
/// (A sun of one texel, drawn by a density that is even over each cell instead, has a relative
/// variance of 0.78 where this one has none.)
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnvironmentMap<'a> {
    texels: &'a [Rgb],
    grid: Grid,
    to_local: Mat3,
    scale: f32,
    mean: f32,
    table: Option<EnvironmentTable<'a>>,
}

impl<'a> EnvironmentMap<'a> {
    /// Borrows a map. Directions are drawn by the receiver's cosine until there is a table.
    ///
    /// * `texels` – radiance (W m⁻² sr⁻¹), `width` × `height` of them, row by row from the zenith
    ///   (`+y`) down to the nadir; the middle column lies toward `+z`, the first and the last toward
    ///   `−z`, and columns go from `−x` to `+x`
    /// * `to_world` – a rotation, or one with a mirror
    ///
    /// # Errors
    /// When the number of texels is not `width` × `height`, one of them is negative or not finite, or
    /// the transform is no rotation.
    pub fn new(texels: &'a [Rgb], width: u32, height: u32, to_world: Mat3) -> Result<Self, LightError> {
        if texels.is_empty() || texels.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(LightError::TexelCount { width, height, texels: texels.len() });
        }
        if let Some(index) = texels.iter().position(|t| !t.is_valid()) {
            let (x, y) = (index as u32 % width, index as u32 / width);
            return Err(LightError::Texel { x, y, radiance: texels[index] });
        }
        let grid = Grid { width, height };
        let (to_local, mean) = (Mat3::IDENTITY, mean(texels, &grid));
        Self { texels, grid, to_local, scale: 1.0, mean, table: None }.turned(to_world)
    }

    /// Turns the map; its table stays right.
    ///
    /// * `to_world` – a rotation, or one with a mirror, in place of the one before
    ///
    /// # Errors
    /// When the transform is no rotation.
    pub fn turned(self, to_world: Mat3) -> Result<Self, LightError> {
        let to_local = to_world.transpose();
        let off = to_local * to_world - Mat3::IDENTITY;
        if off.to_cols_array().iter().all(|v| v.abs() <= RIGID) {
            Ok(Self { to_local, ..self })
        } else {
            Err(LightError::NotARotation)
        }
    }

    /// Makes the map brighter or darker; its table stays right.
    ///
    /// * `scale` – what the radiance of each texel is multiplied with, 0 or more, in place of the scale before
    ///
    /// # Errors
    /// When the scale is negative or not finite, or the brightest texel is no longer finite.
    pub fn scaled(self, scale: f32) -> Result<Self, LightError> {
        let emission = Rgb::splat(scale);
        if scale < 0.0 {
            return Err(LightError::NegativeEmission { emission });
        }
        if !emission.is_valid() {
            return Err(LightError::NotFinite { field: "scale" });
        }
        // No factor up to 1 takes a number out of range.
        let too_bright = |t: &Rgb| scale > 1.0 && !(*t * scale).is_valid();
        match self.texels.iter().position(too_bright) {
            Some(index) => {
                let (x, y) = (index as u32 % self.grid.width, index as u32 / self.grid.width);
                Err(LightError::Texel { x, y, radiance: self.texels[index] * scale })
            }
            None => Ok(Self { scale, ..self }),
        }
    }

    /// Draws directions by a table.
    ///
    /// # Errors
    /// When the table was made for a map of another size.
    pub fn with_table(self, table: EnvironmentTable<'a>) -> Result<Self, LightError> {
        if table.fits(&Levels::new(&self.grid)) {
            Ok(Self { table: Some(table), ..self })
        } else {
            Err(LightError::Table { width: self.grid.width, height: self.grid.height })
        }
    }

    /// The same map, borrowed anew from where its texels and its table are now: nothing is checked again.
    #[cfg(feature = "build")]
    pub(crate) const fn over<'b>(
        &self,
        texels: &'b [Rgb],
        table: Option<EnvironmentTable<'b>>,
    ) -> EnvironmentMap<'b> {
        let Self { grid, to_local, scale, mean, .. } = *self;
        EnvironmentMap { texels, grid, to_local, scale, mean, table }
    }

    /// Columns and rows.
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        [self.grid.width, self.grid.height]
    }

    /// The four texels around a cell.
    #[inline]
    fn corners(&self, x: u32, y: u32) -> [Rgb; 4] {
        self.grid.corners(x, y).map(|i| self.texels.get(i).copied().unwrap_or(Rgb::BLACK))
    }

    /// Density of the direction `d`, in the map's space, from what its cell is scaled by (sr⁻¹).
    #[inline]
    fn density(&self, table: &EnvironmentTable<'_>, place: &Place, d: Vec3, scale: f32) -> f32 {
        let corners = self.corners(place.x, place.y).map(|texel| table.importance(texel));
        bilinear(corners, place.s, self.grid.tau(place.y, d)) * scale
    }

    /// Draws a direction by the table, in the map's space, and says in which cell.
    #[inline]
    fn draw(
        &self,
        table: &EnvironmentTable<'_>,
        levels: &Levels,
        by: &impl Weigh,
        mut u: [f32; 2],
    ) -> Option<(Vec3, Chosen)> {
        let column = num::TAU / self.grid.width as f32;
        let mass = |[x, y]: [u32; 2]| {
            let [a, b, c, d] = self.corners(x, y).map(|texel| table.importance(texel));
            0.25 * (a + b + c + d) * (column * self.grid.drop(y))
        };
        let chosen = table.choose(levels, by, &mut u, mass)?;
        let [x, y] = chosen.cell;
        let [a, b, c, d] = self.corners(x, y).map(|texel| table.importance(texel));
        let tau = linear(a + b, c + d, u[1]);
        let s = linear(a + (c - a) * tau, b + (d - b) * tau, u[0]);
        Some((self.grid.direction(chosen.cell, s, tau), chosen))
    }

    /// A sample by the table. What is answered about it is answered for the direction as it was
    /// rounded, which may lie in the next cell.
    #[inline]
    fn sample_by(&self, table: &EnvironmentTable<'_>, by: &impl Weigh, u: [f32; 2]) -> Option<LightSample> {
        let levels = Levels::new(&self.grid);
        let (drawn, chosen) = self.draw(table, &levels, by, u)?;
        let wi = self.to_local.transpose() * drawn;
        let local = self.to_local * wi;
        let place = self.grid.place(local);
        let cell = [place.x, place.y];
        let scale = if cell == chosen.cell { chosen.scale } else { table.scale(&levels, by, cell) };
        let pdf = self.density(table, &place, local, scale);
        (pdf > 0.0).then(|| escaping(wi, self.lookup(&place), pdf))
    }

    /// Radiance from a place (W m⁻² sr⁻¹).
    #[inline]
    fn lookup(&self, place: &Place) -> Rgb {
        let corners = self.corners(place.x, place.y);
        let channel = |c: fn(&Rgb) -> f32| bilinear(corners.each_ref().map(c), place.s, place.t);
        Rgb::new(channel(|t| t.r), channel(|t| t.g), channel(|t| t.b)) * self.scale
    }
}

impl EnvironmentTable<'_> {
    /// How much a texel draws directions toward it.
    #[inline]
    pub(crate) fn importance(&self, texel: Rgb) -> f32 {
        let luminance = texel.luminance() * self.gain;
        num::larger(luminance - self.offset, luminance * EnvironmentDensity::KEPT)
    }
}

/// A sample from infinitely far away.
#[inline]
fn escaping(wi: Vec3, incident: Rgb, pdf: f32) -> LightSample {
    LightSample { wi, distance: f32::INFINITY, incident, density: Density::SolidAngle(pdf) }
}

/// Between four values: above left, above right, below left, below right.
#[inline]
fn bilinear([a, b, c, d]: [f32; 4], s: f32, t: f32) -> f32 {
    // As a weighted sum, which cannot leave the range of the values.
    let (above, below) = (a * (1.0 - s) + b * s, c * (1.0 - s) + d * s);
    above * (1.0 - t) + below * t
}

/// A number in `[0, 1]` with a density that goes linearly from `a` to `b`, not both 0, from a uniform.
///
/// Source: Pharr, Jakob, Humphreys 2023, *Physically Based Rendering*, 4th edition, section A.4.1.
/// Differs: the ends are scaled first, so that their squares do not vanish.
#[inline]
fn linear(a: f32, b: f32, u: f32) -> f32 {
    let sum = a + b;
    if !(sum > 0.0) {
        return u;
    }
    let (a, b) = (a / sum, b / sum);
    let slope = a + num::sqrt(a * a * (1.0 - u) + b * b * u);
    if slope > 0.0 { (u / slope).min(1.0) } else { 0.0 }
}

/// Mean of the radiance over the sphere, as average over the channels (W m⁻² sr⁻¹).
fn mean(texels: &[Rgb], grid: &Grid) -> f32 {
    let row_mean = |y: u32| {
        let start = y as usize * grid.width as usize;
        let row = texels.get(start..start + grid.width as usize).unwrap_or(&[]);
        row.iter().map(|t| f64::from(t.average())).sum::<f64>() / f64::from(grid.width)
    };
    let (mut sum, mut above) = (0.0, row_mean(0));
    for y in 0..grid.rows() {
        let below = row_mean((y + 1).min(grid.height - 1));
        sum += 0.25 * (above + below) * f64::from(grid.drop(y));
        above = below;
    }
    sum.min(f64::from(f32::MAX)) as f32
}

impl Emitter for EnvironmentMap<'_> {
    /// By the table, or by the cosine about the receiver's normal, `cos θ / π` (sr⁻¹).
    #[inline]
    fn sample(&self, from: &Receiver, _: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        match &self.table {
            Some(table) if table.draws_by == DrawsBy::Product => {
                return self.sample_by(table, &(self.to_local * from.normal), u);
            }
            Some(table) if table.draws_by == DrawsBy::Importance => {
                return self.sample_by(table, &Plain, u);
            }
            _ => {}
        }
        let wi = Frame::from_normal(from.normal).to_world(warp::cosine_hemisphere(u));
        let pdf = self.pdf_escaping(from, wi);
        (pdf > 0.0).then(|| escaping(wi, self.radiance_escaping(wi), pdf))
    }

    #[inline]
    fn pdf_escaping(&self, from: &Receiver, wi: Vec3) -> f32 {
        let Some(table) = self.table.as_ref().filter(|table| table.draws_by != DrawsBy::Cosine) else {
            return warp::cosine_hemisphere_pdf(from.normal.dot(wi));
        };
        let local = self.to_local * wi;
        let place = self.grid.place(local);
        let (levels, cell) = (Levels::new(&self.grid), [place.x, place.y]);
        let scale = if table.draws_by == DrawsBy::Product {
            table.scale(&levels, &(self.to_local * from.normal), cell)
        } else {
            table.scale(&levels, &Plain, cell)
        };
        self.density(table, &place, local, scale)
    }

    #[inline]
    fn radiance_escaping(&self, wi: Vec3) -> Rgb {
        self.lookup(&self.grid.place(self.to_local * wi))
    }

    fn is_environment(&self) -> bool {
        true
    }

    fn environment_map(&self) -> Option<&EnvironmentMap<'_>> {
        Some(self)
    }

    fn leaves_to_bsdf(&self) -> bool {
        self.table.is_some_and(|table| table.offset > 0.0)
    }

    /// `4π² R²` times the mean radiance (W).
    fn power(&self, scene_radius: f32) -> f32 {
        4.0 * num::PI * num::PI * scene_radius * scene_radius * self.mean * self.scale
    }
}
