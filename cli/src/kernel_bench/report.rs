//! What came of one case with one subject.

use super::goal::Goal;
use super::score::Score;
use crate::scene::camera::Size;
use std::fmt::Write as _;
use subsurface_runtime::Path;

/// Taps from which on the witness is expected to be closer than the yardstick: eight times as many.
const FEWEST_WITNESS_TAPS: u32 = 136;

/// It then has at most half of the yardstick's error.
const CLOSER_THAN_YARDSTICK_DB: f64 = 6.0;

/// From here on pictures count as the same.
const CLOSE_DB: f64 = 45.0;

/// All contenders on one case with one subject.
#[derive(Clone, Debug)]
pub struct Report {
    /// Name of the case.
    pub case: String,
    /// Name of the profile.
    pub profile: String,
    /// The adapter that the times belong to.
    pub adapter: String,
    /// Size of the buffers.
    pub size: Size,
    /// How many pixels scatter.
    pub translucent_pixels: usize,
    /// Mean radius of the widest channel, mm.
    pub mean_radius_mm: f64,
    /// Millimetres that a translucent pixel spans, the median.
    pub millimetres_per_pixel: f64,
    /// Irradiance that PSNR is relative to.
    pub white: f64,
    /// Time of the reference picture, its pipeline included, ms.
    pub dense_ms: f64,
    /// PSNR of [`WITNESS`](super::WITNESS) against the reference, dB: another way to the same sum. Infinite where both are
    /// alike.
    pub witness_db: f64,
    /// Taps that the witness takes at the median footprint, which may have no room for all.
    pub witness_taps: u32,
    /// One line per contender, in the order in which they entered: the yardstick first.
    pub lines: Vec<Line>,
    /// Who did not enter.
    pub declined: Vec<Declined>,
}

/// What came of one contender.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its family.
    pub family: String,
    /// Its taps.
    pub taps: u32,
    /// What the default kernel has to reach against it.
    pub goal: Option<Goal>,
    /// The path that it took.
    pub path: Path,
    /// Its error.
    pub score: Score,
    /// Its time, once measured.
    pub time: Option<Time>,
}

/// Time per frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// Median, ms.
    pub milliseconds: f64,
    /// Median of the ratios to the yardstick's time in the same round.
    pub ratio: f64,
}

/// A contender that did not suit the case or the subject.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Declined {
    /// Its family.
    pub family: String,
    /// Its taps.
    pub taps: u32,
    /// Why it did not suit.
    pub reason: String,
}

impl Report {
    /// Mean radius of the widest channel in pixels.
    pub fn mean_radius_pixels(&self) -> f64 {
        self.mean_radius_mm / self.millimetres_per_pixel
    }

    /// Whether the reference picture may be wrong.
    ///
    /// With so many more taps than the yardstick the witness comes much closer, or as close as anybody; where it does
    /// neither, it is `Dense` that did not sum to the end, as on drivers that stop a shader after some rounds of its loops.
    /// Nothing is said of footprints that have no room for the taps: sums over them are short.
    pub fn is_reference_doubtful(&self) -> bool {
        let Some(yardstick) = self.lines.first() else { return false };
        self.witness_taps >= FEWEST_WITNESS_TAPS
            && self.witness_db < (yardstick.score.psnr_db + CLOSER_THAN_YARDSTICK_DB).min(CLOSE_DB)
    }

    /// A line that says what was measured.
    pub fn title(&self) -> String {
        let covered = 100.0 * self.translucent_pixels as f64 / self.size.pixels() as f64;
        format!(
            "{}, {}: {} pixels, {covered:.0} % translucent; the mean radius of the widest channel is {:.2} mm or \
             {:.2} pixels; PSNR against {:.3}",
            self.case,
            self.profile,
            self.size,
            self.mean_radius_mm,
            self.mean_radius_pixels(),
            self.white
        )
    }

    /// Every number of all reports, unrounded: one line per contender, with a head.
    pub fn csv(reports: &[Self]) -> String {
        let mut text = String::from(
            "case,profile,kernel,taps,path,width,height,translucent_pixels,mean_radius_mm,mean_radius_pixels,white,\
             rmse,rmse_red,rmse_green,rmse_blue,psnr_db,witness_psnr_db,milliseconds,time_ratio,adapter\n",
        );
        for report in reports {
            for line in &report.lines {
                let [red, green, blue] = line.score.channel_rmse;
                let Some(Time { milliseconds, ratio }) = line.time else { continue };
                // Writing to a string cannot fail.
                let _ = writeln!(
                    text,
                    "{},{},{},{},{},{},{},{},{},{},{},{},{red},{green},{blue},{},{},{milliseconds},{ratio},{}",
                    quoted(&report.case),
                    quoted(&report.profile),
                    quoted(&line.family),
                    line.taps,
                    path_name(line.path),
                    report.size.width,
                    report.size.height,
                    report.translucent_pixels,
                    report.mean_radius_mm,
                    report.mean_radius_pixels(),
                    report.white,
                    line.score.rmse,
                    line.score.psnr_db,
                    report.witness_db,
                    quoted(&report.adapter),
                );
            }
        }
        text
    }
}

/// A cell of text, RFC 4180.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// The path's name on the command line and in tables.
pub(super) fn path_name(path: Path) -> &'static str {
    match path {
        Path::Compute => "compute",
        Path::Fragment => "fragment",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(yardstick_db: f64, witness_db: f64, witness_taps: u32) -> Report {
        let score = Score { rmse: 0.01, channel_rmse: [0.01; 3], psnr_db: yardstick_db };
        Report {
            case: String::new(),
            profile: String::new(),
            adapter: String::new(),
            size: Size { width: 1, height: 1 },
            translucent_pixels: 1,
            mean_radius_mm: 1.0,
            millimetres_per_pixel: 1.0,
            white: 1.0,
            dense_ms: 1.0,
            witness_db,
            witness_taps,
            lines: vec![Line {
                family: String::new(),
                taps: 17,
                goal: None,
                path: Path::Compute,
                score,
                time: None,
            }],
            declined: Vec::new(),
        }
    }

    #[test]
    fn a_reference_is_doubtful_where_many_taps_are_no_closer_than_few() {
        for (yardstick_db, witness_db, taps, doubtful) in [
            (30.0, 31.0, 1024, true),
            (30.0, 36.1, 1024, false),
            (44.0, 45.0, 1024, false),
            (30.0, f64::INFINITY, 1024, false),
            // No room for more taps: the witness is the yardstick.
            (30.0, 30.0, 17, false),
        ] {
            let report = report(yardstick_db, witness_db, taps);
            assert_eq!(report.is_reference_doubtful(), doubtful, "{yardstick_db} {witness_db} {taps}");
        }
    }
}
