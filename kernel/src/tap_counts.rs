//! Numbers of taps that an estimator may have.

use std::fmt;

/// Numbers of taps that an estimator may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TapCounts {
    /// The smallest.
    pub least: u32,
    /// The largest.
    pub most: u32,
    /// Whether only odd numbers do: an estimator that is symmetric about a centre tap has one.
    pub odd: bool,
}

impl TapCounts {
    /// Whether `taps` is one of them.
    #[must_use]
    pub fn contains(self, taps: u32) -> bool {
        (self.least..=self.most).contains(&taps) && !(self.odd && taps.is_multiple_of(2))
    }
}

/// In words that complete "expected …".
impl fmt::Display for TapCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.odd { "an odd" } else { "a whole" };
        write!(f, "{kind} number from {} to {}", self.least, self.most)
    }
}
