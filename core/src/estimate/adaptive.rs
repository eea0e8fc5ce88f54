//! Samples where the error is: a tile is refined, block by block, until its own estimate says that it is
//! good enough.
//!
//! What a tile becomes depends on the job, the target and the tile alone: not on the rest of the picture,
//! the threads, or the machine that renders it. Every tile meets the target, and so does the picture.
//! Within the tile, error is left where removing it is dear. If doubling the samples `n` of a block
//! divides its error `e` by a rate that is the same for all, the least samples for a given sum of
//! errors are those for which `e / n` is the same everywhere (Lagrange); so the blocks with the
//! largest `e / n` are doubled, until the tile's sum is what it may be. Giving every block the same
//! error gains little: with independent samples, nothing at all. Measured at 1 % on the peers' scenes
//! `rect`, `veach` and `env` and on `still-life`, by samples that a uniform picture needs: equal
//! blocks 0.7 to 1.2, this rule in tiles of 32² pixels 0.3 to 0.75, in one tile for all 0.2 to 0.66, if
//! the errors were known. (Derived here.) Tiles are large, since those in which there is nothing to do end up
//! better than the target: at 1 % and 320×240 pixels the error of `rect` is 0.60 % with tiles of 32² pixels,
//! 0.64 % with 64², and 0.91 % with 128², for 25.6, 21.0 and 13.6 samples per pixel.
//!
//! Estimates of so few pixels are noisy, and who stops at the first low one stops too early. Hence:
//! samples are only ever doubled; no tile stops before [`Target::fewest`]; a block's error is the
//! largest that its last three doublings tell of, and a part of it is its neighbours'; what samples
//! may have missed is added; the decision to stop is the tile's. Blocks are small, so that few pixels
//! beside an edge are refined with it: blocks of 4² pixels take a fifth more samples, of 8² half as many
//! again.

mod words;

use super::convergence::{ErrorEstimate, PRIOR_RATE, RATE};
use super::hidden::behind_samples;
use super::lamps::Sighting;
use super::sky::Sky;
use super::{DifferenceSums, Known, Pixel, Target};
use crate::film::PixelRect;
use crate::num;
use core::{array, mem};

/// Side of a tile (pixels), at most.
pub const TILE: u32 = 128;

/// Side of a block (pixels).
const BLOCK: u32 = 2;

/// Blocks along a side of a tile.
const SIDE: usize = (TILE / BLOCK) as usize;

/// Blocks of a tile.
pub(super) const BLOCKS: usize = SIDE * SIDE;

/// Blocks along a side of a group, of whose sky is known the same: 8² pixels.
const GROUP: usize = 4;

/// Groups along a side of a tile.
const GROUPS: usize = SIDE / GROUP;

/// Doublings that a block remembers. The blocks that are refined most are those that changed most: the farther
/// back, the more their changes tell of why they were chosen, and the less of convergence. With four, the rate
/// was 3 to 5 at an error of 0.5 %, and the true error up to 1.3 of the target.
const MEMORY: usize = 3;

/// Factor of the estimate of a block with at most [`FEW`] samples, and of one with more. The largest of
/// three is too large, the more so the faster the first samples converged; but blocks that are thought
/// better than they are, are not looked at again, and those thought worse are. Found on the peers'
/// scenes and the built-in ones: true errors are 0.80, 0.84 and 0.89 of targets of 2, 1 and 0.5 %, with a
/// standard deviation of 0.09.
const CAUTION: (f32, f32) = (0.5, 1.1);

/// Samples of a block that has hardly been refined.
const FEW: u32 = 16;

/// Samples that tell how much a smooth block changes from one to the next.
const FEWEST_OF_SMOOTH: u32 = 2;

/// Factor of what is expected to hide. It shows in few pixels, so that the mean of many pictures says
/// little of one. From the same scenes.
const HIDDEN_CAUTION: f32 = 2.0;

/// How much of a block's error is what it tells itself; the rest is its neighbours'. From the same scenes.
const OWN: f32 = 0.7;

/// How much of the rate is what the tile tells (as exponent); the rest is what is usual. From the same
/// scenes.
const RATE_OWN: f32 = 0.7;

/// What is known of a block.
#[derive(Debug, Clone, Copy, Default)]
struct Block {
    pixels: u32,
    samples: u32,
    /// Mean squared changes of its pixels at its last doublings, newest first.
    changes: [f32; MEMORY],
    /// Mean error of what may hide in its pixels, beside brighter ones or where a lamp is.
    hidden: f32,
    /// Radiance of the brightest lamp whose middle is seen in it (W m⁻² sr⁻¹).
    lamp: f32,
    /// A bit for each pixel that an edge of a lamp is seen in.
    edges: u8,
    known: Known,
    /// True when so much is known that nothing can hide, and a few samples will do.
    smooth: bool,
}

impl Block {
    /// Samples that it gets at least.
    fn fewest(&self, target: &Target) -> u32 {
        let fewest = target.fewest();
        if self.smooth { fewest.min(FEWEST_OF_SMOOTH) } else { fewest }
    }
}

/// A tile that is refined step by step.
///
/// Its pixels are the caller's: row by row from the top, as many as the tile has.
#[derive(Debug, Clone)]
pub struct AdaptiveTile {
    rect: PixelRect,
    blocks: [Block; BLOCKS],
    skies: [Sky; GROUPS * GROUPS],
}

impl AdaptiveTile {
    /// A tile of which nothing is known yet; of `rect`, at most [`TILE`] columns and rows are taken.
    #[must_use]
    pub fn new(rect: PixelRect) -> Self {
        let PixelRect { x0, y0, x1, y1 } = rect;
        let rect = PixelRect { x0, y0, x1: x1.min(x0 + TILE), y1: y1.min(y0 + TILE) };
        let mut tile =
            Self { rect, blocks: [Block::default(); BLOCKS], skies: [Sky::Unasked; GROUPS * GROUPS] };
        tile.blocks = array::from_fn(|i| {
            let pixels = tile.part(i).map_or(0, |part| part.area() as u32);
            Block { pixels, ..Block::default() }
        });
        tile
    }

    /// The part of the film.
    #[must_use]
    pub const fn rect(&self) -> PixelRect {
        self.rect
    }

    /// The pixels of a block; `None` for one beyond the edge of the tile.
    fn part(&self, block: usize) -> Option<PixelRect> {
        let PixelRect { x0, y0, x1, y1 } = self.rect;
        let (x, y) = (x0 + (block % SIDE) as u32 * BLOCK, y0 + (block / SIDE) as u32 * BLOCK);
        let part = PixelRect { x0: x, y0: y, x1: x1.min(x + BLOCK), y1: y1.min(y + BLOCK) };
        (x < x1 && y < y1).then_some(part)
    }

    /// The pixels of a group.
    pub(super) fn group(&self, group: usize) -> PixelRect {
        let PixelRect { x0, y0, x1, y1 } = self.rect;
        let side = GROUP as u32 * BLOCK;
        let (x, y) = (x0 + (group % GROUPS) as u32 * side, y0 + (group / GROUPS) as u32 * side);
        PixelRect { x0: x, y0: y, x1: x1.min(x + side), y1: y1.min(y + side) }
    }

    /// What is known of the sky above a group.
    pub(super) fn sky(&mut self, group: usize) -> &mut Sky {
        &mut self.skies[group]
    }

    /// The blocks that are there.
    fn inhabited(&self) -> impl Iterator<Item = (usize, &Block)> {
        self.blocks.iter().enumerate().filter(|(_, b)| b.pixels > 0)
    }

    /// Fewest samples of a pixel.
    #[must_use]
    pub fn fewest_samples(&self) -> u32 {
        self.inhabited().map(|(_, b)| b.samples).min().unwrap_or(0)
    }

    /// Sum of the squared changes at the last doubling (0), or one before it.
    fn changes(&self, ago: usize) -> f32 {
        self.inhabited().map(|(_, b)| b.changes[ago] * b.pixels as f32).sum()
    }

    /// By how much doubling divides the variance: what the last doublings tell, held to what is usual.
    fn rate(&self) -> f32 {
        // Smooth blocks have no error to speak of.
        let noisy = self.inhabited().filter(|(_, b)| !b.smooth).map(|(_, b)| b.samples).min();
        let doublings = noisy.unwrap_or(1).max(1).ilog2() as usize;
        let oldest = doublings.saturating_sub(1).min(MEMORY - 1);
        let (last, first) = (self.changes(0), self.changes(oldest));
        if oldest == 0 || !(last > 0.0) {
            return PRIOR_RATE as f32;
        }
        let seen = num::clamp(num::pow(first / last, 1.0 / oldest as f32), RATE.0 as f32, RATE.1 as f32);
        num::pow(seen, RATE_OWN) * num::pow(PRIOR_RATE as f32, 1.0 - RATE_OWN)
    }

    /// Estimated relMSE of each block; 0 where there is none.
    fn errors(&self, rate: f32) -> [f32; BLOCKS] {
        let own: [f32; BLOCKS] = array::from_fn(|i| {
            let [last, before, earlier] = self.blocks[i].changes;
            let caution = if self.blocks[i].samples > FEW { CAUTION.1 } else { CAUTION.0 };
            let worst = last.max(before / rate).max(earlier / (rate * rate));
            caution * worst / (rate - 1.0) + HIDDEN_CAUTION * self.blocks[i].hidden
        });
        let shared = |i: usize| {
            if self.blocks[i].smooth { own[i] } else { OWN * own[i] + (1.0 - OWN) * self.around(i, &own) }
        };
        array::from_fn(|i| if self.blocks[i].pixels > 0 { shared(i) } else { 0.0 })
    }

    /// Mean of a block and its neighbours.
    fn around(&self, block: usize, values: &[f32; BLOCKS]) -> f32 {
        let there = neighbourhood(block).filter(|&i| self.blocks[i].pixels > 0);
        let (sum, count) = there.fold((0.0, 0), |(sum, count), i| (sum + values[i], count + 1));
        sum / count as f32
    }

    /// The pixels of a block, their samples, and what is known of them; `None` for one beyond the edge.
    pub(super) fn block(&self, index: usize) -> Option<(PixelRect, u32, Known)> {
        let Block { samples, known, .. } = self.blocks[index];
        self.part(index).map(|part| (part, samples, known))
    }

    /// Notes what is known of a block before its first sample, and whether a few will do.
    pub(super) fn note_known(&mut self, index: usize, known: Known, smooth: bool) {
        (self.blocks[index].known, self.blocks[index].smooth) = (known, smooth);
    }

    /// Notes that the pixels of a block have got more samples, and how they have changed. Returns how many
    /// samples that were.
    pub(super) fn note_samples(&mut self, index: usize, samples: u32, sums: &DifferenceSums) -> u64 {
        let block = &mut self.blocks[index];
        let before = mem::replace(&mut block.samples, samples);
        if before > 0 {
            block.changes.rotate_right(1);
            block.changes[0] = sums.mean().unwrap_or(0.0) as f32;
        }
        u64::from(block.pixels) * u64::from(samples - before)
    }

    /// Notes a lamp that is seen in a pixel of the tile.
    pub(super) fn note_lamp(&mut self, seen: &Sighting) {
        let (x, y) = (seen.pixel.0 - self.rect.x0, seen.pixel.1 - self.rect.y0);
        let block = &mut self.blocks[(y / BLOCK) as usize * SIDE + (x / BLOCK) as usize];
        block.lamp = num::larger(block.lamp, seen.radiance);
        block.edges |= u8::from(seen.is_edge) << pixel_of_block(x, y);
    }

    /// Works out what may hide in the pixels, now that those of some blocks have `changed`.
    pub(super) fn look_for_hidden<P: Pixel>(&mut self, pixels: &[P], changed: &[bool; BLOCKS]) {
        let (rect, width) = (self.rect, self.rect.width() as usize);
        for i in 0..BLOCKS {
            let Some(part) = self.part(i).filter(|_| neighbourhood(i).any(|near| changed[near])) else {
                continue;
            };
            if self.blocks[i].smooth {
                continue;
            }
            let Block { lamp, edges, .. } = self.blocks[i];
            let places = (part.y0..part.y1).flat_map(|y| (part.x0..part.x1).map(move |x| (x, y)));
            let index = |(x, y): (u32, u32)| (y - rect.y0) as usize * width + (x - rect.x0) as usize;
            let is_edge = |(x, y): (u32, u32)| edges >> pixel_of_block(x - rect.x0, y - rect.y0) & 1 == 1;
            let sum: f32 = places.map(|p| behind_samples(pixels, width, index(p), lamp, is_edge(p))).sum();
            self.blocks[i].hidden = sum / part.area() as f32;
        }
    }

    /// The blocks that are to be doubled next; none when the tile is good enough.
    pub(super) fn next(&self, target: &Target) -> [bool; BLOCKS] {
        let begun = |i: usize| self.blocks[i].samples >= self.blocks[i].fewest(target);
        if self.inhabited().any(|(i, _)| !begun(i)) {
            return array::from_fn(|i| self.blocks[i].pixels > 0 && !begun(i));
        }
        let rate = self.rate();
        let errors = self.errors(rate);
        let open = |i: usize| self.blocks[i].pixels > 0 && !self.misses(i, &errors, target);
        // How far the tile is above what it may have, without the blocks that are given up.
        let weighed = |i: usize| errors[i] * self.blocks[i].pixels as f32;
        let may_have = |i: usize| target.relative_mse() * self.blocks[i].pixels as f32;
        let mut excess: f32 = (0..BLOCKS).filter(|&i| open(i)).map(|i| weighed(i) - may_have(i)).sum();
        let gain = |i: usize| errors[i] / self.blocks[i].samples.max(1) as f32;
        let can_grow = |i: usize| open(i) && self.blocks[i].samples < target.most();
        let best = (0..BLOCKS).filter(|&i| can_grow(i)).map(gain).fold(0.0, num::larger);
        // After doubling, the best would be as good as those that are 2 × rate below it.
        let is_worthwhile = |i: &usize| can_grow(*i) && gain(*i) >= best / (2.0 * rate);
        let (mut order, mut count) = ([0; BLOCKS], 0);
        for (place, i) in order.iter_mut().zip((0..BLOCKS).filter(is_worthwhile)) {
            (*place, count) = (i, count + 1);
        }
        let order = &mut order[..count];
        order.sort_unstable_by(|&a, &b| gain(b).total_cmp(&gain(a)).then(a.cmp(&b)));
        let mut chosen = [false; BLOCKS];
        for &mut i in order {
            if !(excess > 0.0) {
                break;
            }
            chosen[i] = true;
            excess -= weighed(i) * (1.0 - 1.0 / rate);
        }
        chosen
    }

    /// True for a block that has all samples that it may have, and more error than its share.
    fn misses(&self, block: usize, errors: &[f32; BLOCKS], target: &Target) -> bool {
        self.blocks[block].samples >= target.most() && errors[block] > target.relative_mse()
    }

    /// Pixels that have all samples that they may have, and more error than their share.
    #[must_use]
    pub fn missed(&self, target: &Target) -> u32 {
        let errors = self.errors(self.rate());
        self.inhabited().filter(|(i, _)| self.misses(*i, &errors, target)).map(|(_, b)| b.pixels).sum()
    }

    /// Estimated error; add those of all tiles up for that of the picture.
    #[must_use]
    pub fn error(&self) -> ErrorEstimate {
        let rate = self.rate();
        let errors = self.errors(rate);
        let mut all = ErrorEstimate::default();
        for (i, block) in self.inhabited().filter(|(_, b)| b.samples > 1) {
            all.add_part(block.pixels, f64::from(errors[i]), f64::from(rate));
        }
        all
    }
}

/// Which pixel of its block one is, by its place in the tile.
const fn pixel_of_block(x: u32, y: u32) -> u32 {
    y % BLOCK * BLOCK + x % BLOCK
}

/// The blocks, group by group: the one at a place, and its group.
pub(super) const fn in_groups(place: usize) -> (usize, usize) {
    let (group, within) = (place / (GROUP * GROUP), place % (GROUP * GROUP));
    let (x, y) = (group % GROUPS * GROUP + within % GROUP, group / GROUPS * GROUP + within / GROUP);
    (y * SIDE + x, group)
}

/// A block and those around it, whether they are there or not.
fn neighbourhood(block: usize) -> impl Iterator<Item = usize> {
    let near = |i: usize| i.saturating_sub(1)..(i + 2).min(SIDE);
    near(block / SIDE).flat_map(move |y| near(block % SIDE).map(move |x| y * SIDE + x))
}

#[cfg(test)]
mod tests;
