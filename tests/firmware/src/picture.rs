//! The picture that every machine renders, and its checksum.

use halflight::estimate::{Direct, Job, PixelStats};
use halflight::film::{Film, PixelRect};
use halflight::light::Emitter;
use halflight::material::Material;
use halflight::sequence::Sobol;
use halflight::shape::Shape;
use halflight::{Camera, Scene};

/// Samples for each pixel.
pub const SAMPLES: u32 = 4;

/// Checksum of the Cornell box under its lamp.
pub const CORNELL: u64 = 0x368d_fd94_3160_93bc;

/// Checksum of the Cornell box under a sky.
pub const SKY: u64 = 0x0320_eded_da83_d016;

/// Renders a picture and hands out its pixels, row by row, each when it is done.
pub fn render<S: Shape, L: Emitter, M: Material>(
    scene: Scene<'_, S, L, M>,
    camera: Camera,
    film: Film,
    mut each: impl FnMut(u32, u32, &PixelStats),
) {
    let job = Job { scene, camera, film, estimator: Direct::default(), sequence: Sobol::new(1) };
    for y in 0..film.height() {
        for x in 0..film.width() {
            let mut pixel = [PixelStats::NEW];
            job.render(PixelRect { x0: x, y0: y, x1: x + 1, y1: y + 1 }, 0..SAMPLES, &mut pixel);
            each(x, y, &pixel[0]);
        }
    }
}

/// A checksum of 64 bits over words.
///
/// Source: Fowler, Noll, Vo, *The FNV Non-Cryptographic Hash Algorithm*, variant 1a. Differs: a word at a
/// time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Checksum(pub u64);

impl Checksum {
    /// Of nothing.
    pub const NEW: Self = Self(0xcbf2_9ce4_8422_2325);

    /// With some more words.
    #[must_use]
    pub fn with(self, words: &[u32]) -> Self {
        Self(
            words
                .iter()
                .fold(self.0, |sum, &word| (sum ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3)),
        )
    }
}
