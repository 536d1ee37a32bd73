//! How the goals of a report came out.

use super::goal::{CLOSER_DB, Goal, LARGEST_SHARE};
use super::report::{Line, Report};

/// What is held against the others.
pub const OURS: &str = "interleaved";

/// Which of a family's contenders are not beaten in both time and error by another, from fast to slow.
#[derive(Clone, Debug, PartialEq)]
pub struct Front {
    /// Time ratio and PSNR (dB), both rising.
    points: Vec<(f64, f64)>,
}

/// What is said of a front at a PSNR.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AtPsnr {
    /// Its time ratio there: between its points along straight lines of PSNR over the logarithm of time.
    Ratio(f64),
    /// Even its fastest point, of this time ratio, is better.
    AtMost(f64),
    /// Even its best point, of this PSNR (dB), is worse.
    OutOfReach(f64),
}

impl Front {
    /// The front of `family` in a report; `None` if none of it ran.
    pub fn of(report: &Report, family: &str) -> Option<Self> {
        let own = report.lines.iter().filter(|line| line.family == family);
        Self::new(own.filter_map(|line| Some((line.time?.ratio, line.score.psnr_db))).collect())
    }

    fn new(mut points: Vec<(f64, f64)>) -> Option<Self> {
        points.retain(|(ratio, psnr)| ratio.is_finite() && psnr.is_finite());
        // Of equal times the best comes first, and keeps the others out.
        points.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1)));
        let mut best = f64::NEG_INFINITY;
        points.retain(|(_, psnr)| {
            let rises = *psnr > best;
            best = best.max(*psnr);
            rises
        });
        (!points.is_empty()).then_some(Self { points })
    }

    /// Time ratio at a PSNR.
    pub fn at_psnr(&self, psnr_db: f64) -> AtPsnr {
        let (first, last) = (self.points[0], self.points[self.points.len() - 1]);
        if psnr_db <= first.1 {
            return AtPsnr::AtMost(first.0);
        }
        let Some(pair) = self.points.windows(2).find(|pair| psnr_db <= pair[1].1) else {
            return AtPsnr::OutOfReach(last.1);
        };
        let share = (psnr_db - pair[0].1) / (pair[1].1 - pair[0].1);
        AtPsnr::Ratio(pair[0].0 * (pair[1].0 / pair[0].0).powf(share))
    }

    /// The best point that takes less time than `ratio`, as time ratio and PSNR (dB).
    pub fn best_below(&self, ratio: f64) -> Option<(f64, f64)> {
        self.points.iter().rev().find(|point| point.0 < ratio).copied()
    }
}

/// How the goal against one rival came out.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Of [`Goal::Faster`]: our time at the rival's PSNR, as a share of the rival's.
    Faster(AtPsnr),
    /// Of [`Goal::FasterAndCloser`]: our best kernel below the rival's time, if there is one: its share of that time,
    /// and by how many dB it is better.
    FasterAndCloser(Option<(f64, f64)>),
}

impl Outcome {
    /// Whether the goal is met.
    pub fn is_met(&self) -> bool {
        match self {
            Self::Faster(AtPsnr::Ratio(share) | AtPsnr::AtMost(share)) => *share <= LARGEST_SHARE,
            Self::Faster(AtPsnr::OutOfReach(_)) | Self::FasterAndCloser(None) => false,
            Self::FasterAndCloser(Some((_, gain_db))) => *gain_db >= CLOSER_DB,
        }
    }
}

/// The rivals of a report that have a goal, and how it came out.
pub fn outcomes(report: &Report) -> Vec<(&Line, Outcome)> {
    let Some(front) = Front::of(report, OURS) else { return Vec::new() };
    let outcome = |line: &Line| {
        let ratio = line.time?.ratio;
        Some(match line.goal? {
            Goal::Faster => Outcome::Faster(match front.at_psnr(line.score.psnr_db) {
                AtPsnr::Ratio(own) => AtPsnr::Ratio(own / ratio),
                AtPsnr::AtMost(own) => AtPsnr::AtMost(own / ratio),
                AtPsnr::OutOfReach(best_db) => AtPsnr::OutOfReach(best_db),
            }),
            Goal::FasterAndCloser => {
                let best = front.best_below(ratio);
                Outcome::FasterAndCloser(best.map(|(own, psnr)| (own / ratio, psnr - line.score.psnr_db)))
            }
        })
    };
    report.lines.iter().filter_map(|line| Some((line, outcome(line)?))).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    fn front() -> Front {
        // The third is beaten by the second, the last by the fourth.
        Front::new(vec![(0.1, 30.0), (0.2, 40.0), (0.3, 35.0), (0.8, 44.0), (0.9, 44.0)]).unwrap()
    }

    #[test]
    fn what_is_beaten_is_not_on_the_front() {
        assert_eq!(front().points, [(0.1, 30.0), (0.2, 40.0), (0.8, 44.0)]);
        assert_eq!(Front::new(vec![(0.1, f64::NAN)]), None);
        assert_eq!(Front::new(vec![(0.5, 30.0), (0.5, 31.0)]).unwrap().points, [(0.5, 31.0)]);
    }

    #[test]
    fn a_point_of_the_front_is_found_at_its_own_psnr() {
        let ratio = |psnr| match front().at_psnr(psnr) {
            AtPsnr::Ratio(ratio) => ratio,
            other => panic!("{other:?}"),
        };
        // A few roundings.
        assert!((ratio(40.0) - 0.2).abs() < 1e-12 && (ratio(44.0) - 0.8).abs() < 1e-12);
        // Half of the way in dB is half of the way in the logarithm of time.
        assert!((ratio(42.0) - 0.4).abs() < 1e-12);
        assert_eq!(front().at_psnr(29.0), AtPsnr::AtMost(0.1));
        assert_eq!(front().at_psnr(44.1), AtPsnr::OutOfReach(44.0));
    }

    #[test]
    fn the_best_below_a_time_takes_less_than_it() {
        assert_eq!(front().best_below(0.8), Some((0.2, 40.0)));
        assert_eq!(front().best_below(0.81), Some((0.8, 44.0)));
        assert_eq!(front().best_below(0.1), None);
    }

    #[test]
    fn goals_are_met_at_their_bounds() {
        assert!(
            Outcome::Faster(AtPsnr::Ratio(0.4)).is_met() && !Outcome::Faster(AtPsnr::Ratio(0.41)).is_met()
        );
        assert!(Outcome::Faster(AtPsnr::AtMost(0.3)).is_met());
        assert!(!Outcome::Faster(AtPsnr::OutOfReach(60.0)).is_met());
        assert!(Outcome::FasterAndCloser(Some((0.9, 4.0))).is_met());
        assert!(!Outcome::FasterAndCloser(Some((0.9, 3.9))).is_met());
        assert!(!Outcome::FasterAndCloser(None).is_met());
    }
}
