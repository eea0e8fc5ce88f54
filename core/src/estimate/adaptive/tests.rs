use super::*;
use std::vec::Vec;

const RECT: PixelRect = PixelRect { x0: 64, y0: 32, x1: 64 + TILE, y1: 32 + TILE };

/// A tile whose blocks have `samples` samples and changed as `change` says.
fn tile(samples: u32, change: impl Fn(usize) -> f32) -> AdaptiveTile {
    let mut tile = AdaptiveTile::new(RECT);
    for (i, block) in tile.blocks.iter_mut().enumerate() {
        block.samples = samples;
        block.changes = array::from_fn(|ago| change(i) * PRIOR_RATE.powi(ago as i32) as f32);
    }
    tile
}

fn chosen(tile: &AdaptiveTile, target: &Target) -> Vec<usize> {
    let chosen = tile.next(target);
    (0..BLOCKS).filter(|&i| chosen[i]).collect()
}

#[test]
fn blocks_cover_a_tile_whatever_its_size() {
    for (width, height) in [(TILE, TILE), (1, 1), (31, 5), (4, 29), (TILE + 8, 8)] {
        let rect = PixelRect { x0: 7, y0: 9, x1: 7 + width, y1: 9 + height };
        let tile = AdaptiveTile::new(rect);
        let parts = || (0..BLOCKS).filter_map(|i| tile.part(i));
        assert_eq!(parts().map(|p| p.area()).sum::<usize>(), (width.min(TILE) * height) as usize);
        assert_eq!(parts().map(|p| p.x1).max(), Some(tile.rect().x1));
        assert_eq!(parts().map(|p| p.y1).max(), Some(rect.y1));
    }
}

#[test]
fn a_tile_without_noise_stops_at_the_fewest_samples() {
    for error in [0.05, 0.01] {
        let target = Target::new(error, 1 << 16);
        let fewest = target.fewest();
        assert_eq!(chosen(&tile(fewest / 2, |_| 0.0), &target).len(), BLOCKS);
        assert!(chosen(&tile(fewest, |_| 0.0), &target).is_empty());
    }
}

#[test]
fn samples_go_where_the_error_is_and_no_farther_than_needed() {
    let target = Target::new(0.01, 1 << 16);
    let noisy = [27, 28, SIDE + 27, SIDE + 28];
    let found = chosen(&tile(16, |i| if noisy.contains(&i) { 0.8 } else { 0.0 }), &target);
    assert!(noisy.iter().all(|i| found.contains(i)), "{found:?}");
    assert!(found.len() < BLOCKS / 8, "{found:?}");
    // The same error everywhere, a little too large: doubling a few will do.
    let error = CAUTION.0 / (PRIOR_RATE as f32 - 1.0);
    let found = chosen(&tile(16, |_| 1.05e-4 / error), &target).len();
    assert!((BLOCKS / 13..=BLOCKS / 8).contains(&found), "{found}");
}

#[test]
fn a_block_that_has_seen_nothing_shares_its_neighbours_error() {
    let tile = tile(16, |i| if i == 27 { 0.0 } else { 0.01 });
    let errors = tile.errors(PRIOR_RATE as f32);
    assert!(errors[27] > 0.25 * errors[28], "{} {}", errors[27], errors[28]);
}

#[test]
fn a_bright_sample_is_remembered() {
    let mut tile = tile(64, |_| 1e-9);
    tile.blocks[9].changes[2] = 1.0;
    assert!(tile.errors(PRIOR_RATE as f32)[9] > 1e-2);
}

#[test]
fn what_cannot_be_reached_is_counted_and_costs_the_others_nothing() {
    let target = Target::new(0.01, 64);
    let mut tile = tile(64, |i| if i == 0 { 1.0 } else { 0.0 });
    for block in &mut tile.blocks[1..] {
        block.samples = 16;
    }
    let found = chosen(&tile, &target);
    assert!(found.iter().all(|i| [1, SIDE, SIDE + 1].contains(i)), "only neighbours: {found:?}");
    assert_eq!(tile.missed(&target), BLOCK * BLOCK);
}

#[test]
fn a_rate_is_believed_in_part() {
    let mut tile = tile(16, |_| 1e-3);
    assert!((tile.rate() / PRIOR_RATE as f32 - 1.0).abs() < 1e-4);
    for block in &mut tile.blocks {
        block.changes = [0.0, 1.0, 1.0];
    }
    assert_eq!(tile.rate(), PRIOR_RATE as f32, "nothing changes any more");
    for block in &mut tile.blocks {
        block.changes = [1.0, 8.0, 64.0];
    }
    assert!(tile.rate() > 1.5 * PRIOR_RATE as f32 && tile.rate() < RATE.1 as f32);
}
