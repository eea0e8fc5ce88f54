//! Choosing in proportion to power.

/// Shares are whole numbers of this fraction: what uniforms of 23 or more bits tell apart, so that
/// each light is chosen exactly as often as its share says.
const STEPS: u32 = 1 << 23;

/// Cumulative powers in the caller's slice: entry `i` is the share of the lights `0..=i`, the last
/// is 1. A light without power has no share and is never chosen; one with power has at least 2⁻²³,
/// so that it does not vanish where it is the only one seen.
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

    /// Fills a table from powers, summed in double precision; false when there is no power at all.
    /// Beyond 2²³ lights not every one has a share.
    pub fn fill(cumulative: &mut [f32], power: impl Fn(usize) -> f32) -> bool {
        cumulative.iter_mut().enumerate().for_each(|(i, entry)| *entry = power(i));
        Self::accumulate(cumulative)
    }

    /// [`PowerTable::fill`] where the powers are: each gives way to the end of its share.
    pub(crate) fn accumulate(entries: &mut [f32]) -> bool {
        // Beyond `f32` is very bright, not dark.
        let usable = |p: f32| if p > 0.0 { f64::from(p.min(f32::MAX)) } else { 0.0 };
        let (mut total, mut left) = (0.0, 0_u32);
        for p in entries.iter().map(|&p| usable(p)).filter(|&p| p > 0.0) {
            total += p;
            left = left.saturating_add(1);
        }
        let (mut sum, mut end) = (0.0, 0);
        for entry in entries {
            let p = usable(*entry);
            if p > 0.0 {
                sum += p;
                left = left.saturating_sub(1);
                // The nearest step, but one for each light before it and one for each behind.
                let nearest = (sum / total * f64::from(STEPS) + 0.5) as u32;
                end = nearest.max(end + 1).min(STEPS.saturating_sub(left));
            }
            *entry = end as f32 / STEPS as f32;
        }
        end == STEPS
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

    /// The cumulative shares.
    #[must_use]
    pub const fn as_slice(&self) -> &'a [f32] {
        self.cumulative
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
    fn every_light_with_power_is_chosen_exactly_as_often_as_its_share_says() {
        for powers in [
            [1e-30, 1.0, 0.0, 1e-9, 1e6, 3e-7, 1e-20],
            [0.0, 1e30, 1e-30, 1e-30, 1e-30, 0.0, 0.0],
            [1.0 / 3.0, 1e-8, 1.0 / 7.0, 0.2, 0.0, 1e-8, 0.1],
        ] {
            let mut table = [0.0; 7];
            assert!(PowerTable::fill(&mut table, |i| powers[i]));
            let t = PowerTable::new(&table).unwrap();
            let mut chosen = [0_u32; 7];
            for step in 0..STEPS {
                chosen[t.choose(step as f32 / STEPS as f32).unwrap()] += 1;
            }
            assert_eq!(chosen.map(|n| n as f32 / STEPS as f32), core::array::from_fn(|i| t.pmf(i)));
            assert_eq!(chosen.map(|n| n > 0), powers.map(|p| p > 0.0));
        }
    }

    #[test]
    fn no_power_gives_no_table() {
        let mut table = [0.0; 2];
        assert!(!PowerTable::fill(&mut table, |_| 0.0));
        assert!(!PowerTable::fill(&mut table, |_| f32::NAN));
        assert!(PowerTable::fill(&mut table, |i| [1.0, f32::INFINITY][i]));
        assert!(!PowerTable::fill(&mut [], |_| 1.0));
        assert_eq!(PowerTable::new(&[]), None);
        assert_eq!(PowerTable::new(&[0.5, 0.25, 1.0]), None);
        assert_eq!(PowerTable::new(&[0.5, 0.9]), None);
        assert_eq!(PowerTable::new(&[f32::NAN, 1.0]), None);
    }
}
