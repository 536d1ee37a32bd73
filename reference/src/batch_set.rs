//! Which batches of a seed are done.

/// A set of batch numbers, kept as ranges.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct BatchSet {
    /// `begin..end`, rising, with gaps between.
    ranges: Vec<(u64, u64)>,
}

impl BatchSet {
    /// Ranges that rise and leave gaps; anything else is not a set in its normal form.
    pub(crate) fn from_ranges(ranges: Vec<(u64, u64)>) -> Option<BatchSet> {
        let each = ranges.iter().all(|&(begin, end)| begin < end);
        let gaps = ranges.windows(2).all(|pair| pair[0].1 < pair[1].0);
        (each && gaps).then_some(BatchSet { ranges })
    }

    pub(crate) fn ranges(&self) -> &[(u64, u64)] {
        &self.ranges
    }

    pub(crate) fn len(&self) -> u64 {
        self.ranges.iter().map(|&(begin, end)| end - begin).sum()
    }

    /// The first `count` batches that are not in the set, in order.
    pub(crate) fn missing(&self, count: u64) -> Vec<u64> {
        let mut missing = Vec::new();
        let mut next = 0;
        for &(begin, end) in &self.ranges {
            let wanted = count - missing.len() as u64;
            missing.extend(next..begin.min(next + wanted));
            next = end;
        }
        let wanted = count - missing.len() as u64;
        missing.extend(next..next + wanted);
        missing
    }

    pub(crate) fn overlaps(&self, other: &BatchSet) -> bool {
        self.ranges.iter().any(|&(begin, end)| other.ranges.iter().any(|&(b, e)| begin < e && b < end))
    }

    /// Adds batches that are not yet in the set.
    pub(crate) fn extend(&mut self, ranges: impl IntoIterator<Item = (u64, u64)>) {
        self.ranges.extend(ranges);
        self.ranges.sort_unstable();
        self.ranges.dedup_by(|next, last| {
            let touching = next.0 <= last.1;
            if touching {
                last.1 = last.1.max(next.1);
            }
            touching
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_comes_first() {
        let mut set = BatchSet::default();
        set.extend([(2, 4), (6, 7)]);
        assert_eq!(set.missing(6), [0, 1, 4, 5, 7, 8]);
        assert_eq!(set.missing(1), [0]);
        set.extend([(0, 1), (4, 6), (1, 2)]);
        assert_eq!(set.ranges(), [(0, 7)]);
        assert_eq!(set.len(), 7);
    }

    #[test]
    fn ranges_have_one_form() {
        assert!(BatchSet::from_ranges(vec![(0, 2), (3, 4)]).is_some());
        assert!(BatchSet::from_ranges(vec![(0, 2), (2, 4)]).is_none());
        assert!(BatchSet::from_ranges(vec![(3, 3)]).is_none());
        let [one, two] =
            [vec![(0, 3)], vec![(2, 5)]].map(BatchSet::from_ranges).map(Option::unwrap_or_default);
        assert!(one.overlaps(&two) && !one.overlaps(&BatchSet::default()));
    }
}
