//! Choosing in proportion to power.

/// Cumulative powers in the caller's slice: entry `i` is the share of the lights `0..=i`, the last
/// is 1. A light without power has no share and is never chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerTable<'a> {
    cumulative: &'a [f32],
}

impl<'a> PowerTable<'a> {
    /// Borrows a table; `None` unless it rises from 0 or above to exactly 1 and is not empty.
    #[must_use]
    pub fn new(cumulative: &'a [f32]) -> Option<Self> {
        let rises = cumulative.windows(2).all(|w| w[0] <= w[1]);
        let starts = cumulative.first().is_some_and(|&c| c >= 0.0);
        let ends = cumulative.last() == Some(&1.0);
        (rises && starts && ends).then_some(Self { cumulative })
    }

    /// Fills a table from powers, summed in double precision; false when there is no power at all
    /// or the lengths differ.
    pub fn fill(cumulative: &mut [f32], power: impl Fn(usize) -> f32) -> bool {
        let usable = |p: f32| if p > 0.0 && p.is_finite() { f64::from(p) } else { 0.0 };
        let total: f64 = (0..cumulative.len()).map(|i| usable(power(i))).sum();
        if !(total > 0.0) {
            return false;
        }
        let (mut sum, mut last) = (0.0, 0);
        for (i, entry) in cumulative.iter_mut().enumerate() {
            let p = usable(power(i));
            sum += p;
            last = if p > 0.0 { i } else { last };
            *entry = (sum / total) as f32;
        }
        // The last light with power closes the table; those behind it get nothing.
        cumulative[last..].fill(1.0);
        true
    }

    /// The first light whose share ends above `u`.
    #[inline]
    pub(super) fn choose(&self, u: f32) -> Option<usize> {
        let index = self.cumulative.partition_point(|&c| c <= u);
        (index < self.cumulative.len()).then_some(index)
    }

    /// Share of a light; 0 for one that is not in the table.
    #[inline]
    #[must_use]
    pub fn pmf(&self, light: usize) -> f32 {
        let Some(&end) = self.cumulative.get(light) else { return 0.0 };
        let start = if light == 0 { 0.0 } else { self.cumulative[light - 1] };
        end - start
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_follow_power_and_add_up() {
        let powers = [1.0, 0.0, 3.0, 4.0, 0.0];
        let mut table = [0.0; 5];
        assert!(PowerTable::fill(&mut table, |i| powers[i]));
        let t = PowerTable::new(&table).unwrap();
        assert_eq!([0, 1, 2, 3, 4, 5].map(|i| t.pmf(i)), [0.125, 0.0, 0.375, 0.5, 0.0, 0.0]);
        for i in 0..1024 {
            let chosen = t.choose(i as f32 / 1024.0).unwrap();
            assert!(powers[chosen] > 0.0);
        }
        assert_eq!(t.choose(0.124), Some(0));
        assert_eq!(t.choose(0.125), Some(2));
        assert_eq!(t.choose(crate::num::ONE_MINUS_EPSILON), Some(3));
    }

    #[test]
    fn no_power_gives_no_table() {
        let mut table = [0.0; 2];
        assert!(!PowerTable::fill(&mut table, |_| 0.0));
        assert!(!PowerTable::fill(&mut table, |_| f32::NAN));
        assert!(!PowerTable::fill(&mut [], |_| 1.0));
        assert_eq!(PowerTable::new(&[]), None);
        assert_eq!(PowerTable::new(&[0.5, 0.25, 1.0]), None);
        assert_eq!(PowerTable::new(&[0.5, 0.9]), None);
        assert_eq!(PowerTable::new(&[f32::NAN, 1.0]), None);
    }
}
