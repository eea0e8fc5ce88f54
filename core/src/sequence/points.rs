//! Four-dimensional Sobol points, Owen-scrambled by hashing.
//!
//! Everything works on numbers whose bits are reversed: a digit of a point is decided by the digits
//! before it, and a multiplication carries from low bits to high ones.

use crate::num;

/// Coordinates of a point.
const LANES: usize = 4;

/// Primitive polynomials of the coordinates: degree, and coefficients between the first and the last.
/// The first coordinate, the radical inverse, has none.
///
/// Source: Joe, Kuo 2008, *Constructing Sobol' sequences with better two-dimensional projections*,
/// SIAM J. Sci. Comput. 30(5), table `new-joe-kuo-6`; also [`FIRST`].
const POLYNOMIALS: [(usize, u32); LANES - 1] = [(1, 0), (2, 1), (3, 1)];

/// Their first direction numbers.
const FIRST: [[u32; 3]; LANES - 1] = [[1, 0, 0], [1, 3, 0], [1, 3, 1]];

/// What each bit adds: a quarter of [`TABLE`], for four times the steps.
#[cfg(feature = "small")]
static COLUMNS: [[u32; LANES]; 32] = directions();

/// What each value of each four bits of a reversed index adds to the reversed point: 2 KiB.
#[cfg(not(feature = "small"))]
static TABLE: [[[u32; LANES]; 16]; 8] = table();

/// Direction numbers, bits reversed: column `i` of the generator matrices, for bit `i` of the index.
///
/// Source: Bratley, Fox 1988, *Algorithm 659*, ACM Trans. Math. Softw. 14(1), section 2.
const fn directions() -> [[u32; LANES]; 32] {
    let mut columns = [[0; LANES]; 32];
    let mut i = 0;
    while i < 32 {
        columns[i][0] = 1 << i;
        let mut lane = 1;
        while lane < LANES {
            let (degree, coefficients) = POLYNOMIALS[lane - 1];
            columns[i][lane] = if i < degree {
                (FIRST[lane - 1][i] << (31 - i)).reverse_bits()
            } else {
                let mut v = columns[i - degree][lane] ^ (columns[i - degree][lane] << degree);
                let mut k = 1;
                while k < degree {
                    v ^= (coefficients >> (degree - 1 - k) & 1) * columns[i - k][lane];
                    k += 1;
                }
                v
            };
            lane += 1;
        }
        i += 1;
    }
    columns
}

/// The sum of the columns for a reversed index.
#[cfg(feature = "small")]
fn sum(index: u32) -> [u32; LANES] {
    let columns = COLUMNS.iter().rev().enumerate().filter(|(bit, _)| index >> bit & 1 == 1);
    columns.fold([0; LANES], |x, (_, column)| core::array::from_fn(|lane| x[lane] ^ column[lane]))
}

/// The sum of the columns for a reversed index.
#[cfg(not(feature = "small"))]
#[inline]
fn sum(index: u32) -> [u32; LANES] {
    let mut x = [0; LANES];
    for (nibble, sums) in TABLE.iter().enumerate() {
        let sum = sums[(index >> (4 * nibble) & 15) as usize];
        for lane in 0..LANES {
            x[lane] ^= sum[lane];
        }
    }
    x
}

/// One coordinate of it.
#[cfg(feature = "small")]
fn sum_of_lane(index: u32, lane: usize) -> u32 {
    sum(index)[lane]
}

/// One coordinate of it.
#[cfg(not(feature = "small"))]
#[inline]
fn sum_of_lane(index: u32, lane: usize) -> u32 {
    let digit = |nibble: usize| (index >> (4 * nibble) & 15) as usize;
    (0..8).fold(0, |x, nibble| x ^ TABLE[nibble][digit(nibble)][lane])
}

/// Sums of the columns, for four bits at a time. Bit `i` of the index is bit `31 − i` of the reversed one.
#[cfg(not(feature = "small"))]
const fn table() -> [[[u32; LANES]; 16]; 8] {
    let (columns, mut table) = (directions(), [[[0; LANES]; 16]; 8]);
    let mut entry = 0;
    while entry < 8 * 16 * 4 {
        let (nibble, value, bit) = (entry / 64, entry / 4 % 16, entry % 4);
        if value >> bit & 1 == 1 {
            let mut lane = 0;
            while lane < LANES {
                table[nibble][value][lane] ^= columns[31 - 4 * nibble - bit][lane];
                lane += 1;
            }
        }
        entry += 1;
    }
    table
}

/// A random permutation that keeps nested blocks together, on reversed bits: each bit is flipped or
/// not as the bits below it say.
///
/// Source: Laine, Karras 2011, *Stratified Sampling for Stochastic Transparency*, section 3, with the
/// constants of Vegdahl 2021, *Building a Better LK Hash*.
#[inline]
const fn scramble(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul(seed >> 16 | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

/// The seed of one coordinate.
#[inline]
const fn lane_seed(seed: u32, lane: usize) -> u32 {
    num::hash(seed.wrapping_add((lane as u32 + 1).wrapping_mul(0x9e37_79b9)))
}

/// The shuffled index, bits reversed. Every aligned block of a power of two of indices remains one.
#[inline]
const fn shuffled(index: u32, seed: u32) -> u32 {
    scramble(index.reverse_bits(), seed)
}

/// All four coordinates of point `index` in `[0, 1)`, of the scramble that `seed` chooses.
///
/// Source: Burley 2020, *Practical Hash-based Owen Scrambling*, JCGT 9(4), listings 1 to 3.
#[inline]
pub(super) fn point(index: u32, seed: u32) -> [f32; LANES] {
    let x = sum(shuffled(index, seed));
    let mut u = [0.0; LANES];
    for lane in 0..LANES {
        u[lane] = num::unit_f32(scramble(x[lane], lane_seed(seed, lane)).reverse_bits());
    }
    u
}

/// One coordinate of the same point.
#[inline]
pub(super) fn coordinate(index: u32, lane: usize, seed: u32) -> f32 {
    let x = sum_of_lane(shuffled(index, seed), lane);
    num::unit_f32(scramble(x, lane_seed(seed, lane)).reverse_bits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// The points without any scramble.
    fn plain(index: u32) -> [u32; LANES] {
        let columns = directions();
        core::array::from_fn(|lane| {
            let sum = (0..32).filter(|i| index >> i & 1 == 1).fold(0, |x, i| x ^ columns[i as usize][lane]);
            sum.reverse_bits()
        })
    }

    #[test]
    fn the_first_points_are_those_of_the_sequence() {
        // In eighths; Joe and Kuo's program gives the same ones, in the order of the Gray code.
        let eighths: Vec<_> = (0..8).map(|i| plain(i).map(|x| x >> 29)).collect();
        assert_eq!(eighths[1], [4, 4, 4, 4]);
        assert_eq!(eighths[2], [2, 6, 6, 6]);
        assert_eq!(eighths[3], [6, 2, 2, 2]);
        assert_eq!(eighths[6], [3, 3, 5, 7]);
        assert_eq!(eighths[7], [7, 7, 1, 3]);
    }

    #[test]
    fn blocks_of_powers_of_two_fill_every_elementary_interval() {
        // The first two coordinates are a (0, 2)-sequence: any aligned block of 2^k points has one
        // point in each of 2^k intervals of any shape, also scrambled and far from the origin.
        for k in [0_u32, 1, 4, 7, 10] {
            for first in [0, 5 << k, 1 << 17, u32::MAX - (1 << k) + 1] {
                for wide in 0..=k {
                    let mut counts = std::vec![0; 1 << k];
                    for i in 0..1 << k {
                        let [x, y, ..] = point(first + i, 77);
                        let column = (x * (1_u32 << wide) as f32) as usize;
                        counts[column << (k - wide) | (y * (1_u32 << (k - wide)) as f32) as usize] += 1;
                    }
                    assert!(counts.iter().all(|&n| n == 1), "{k} {first} {wide}");
                }
            }
        }
    }

    #[test]
    fn every_coordinate_of_a_block_is_stratified() {
        for lane in 0..LANES {
            let mut counts = [0; 256];
            for i in 256..512 {
                counts[(coordinate(i, lane, 3) * 256.0) as usize] += 1;
            }
            assert_eq!(counts, [1; 256]);
        }
    }

    #[test]
    fn one_coordinate_is_that_of_the_point() {
        for i in (0..u32::MAX).step_by(0x0123_4567) {
            assert_eq!(point(i, i), core::array::from_fn(|lane| coordinate(i, lane, i)));
        }
    }
}
