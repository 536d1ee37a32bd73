//! How a pixel gathers the light that arrives around it.

use std::fmt;
use std::str::FromStr;

use crate::TapCounts;

/// How a pixel gathers the light that arrives around it: one estimator of the sum of Liang et al. 2023, eq. (22).
///
/// Every estimator works with every profile model. The enum is exhaustive: code that treats estimators apart must not
/// compile until it treats a new one too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Estimator {
    /// The energy within the pixel's own footprint stays there; the eight pixels around it and the eight blocks around
    /// its block are summed; what lies beyond comes from a lattice of taps that neighbouring pixels share.
    Interleaved {
        /// Taps per pixel, 1 to 64.
        taps: u32,
    },
    /// Radii drawn from the profile by low-discrepancy points, every tap weighted per channel (Liang et al. 2023,
    /// eq. 22). Noise falls with the taps.
    ImportanceSampled {
        /// Taps per pixel, 1 to 4096.
        taps: u32,
    },
    /// Two passes of one dimension, weights from the profile's edge spread (Jimenez et al. 2015, "Separable Subsurface
    /// Scattering"). Without noise, and wrong in two dimensions.
    Separable {
        /// Taps per pass, an odd number from 3 to 65.
        taps: u32,
        /// Whether each pixel turns its pair of axes: stars become noise.
        rotated: bool,
    },
    /// Every pixel within the radius of 99.9 % of the light, up to 120 pixels: slow, what the others are measured
    /// against.
    Dense,
}

impl Default for Estimator {
    fn default() -> Self {
        Self::ALL[0]
    }
}

impl Estimator {
    /// Every estimator with its usual number of taps, the default first.
    ///
    /// Neighbours share interleaved taps, so that few do; 17 is what the literature uses for the others.
    pub const ALL: [Self; 5] = [
        Self::Interleaved { taps: 4 },
        Self::ImportanceSampled { taps: 17 },
        Self::Separable { taps: 17, rotated: false },
        Self::Separable { taps: 17, rotated: true },
        Self::Dense,
    ];

    /// Name in material files: `Interleaved`, `ImportanceSampled`, `Separable` or `Dense`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Interleaved { .. } => "Interleaved",
            Self::ImportanceSampled { .. } => "ImportanceSampled",
            Self::Separable { .. } => "Separable",
            Self::Dense => "Dense",
        }
    }

    /// Name on command lines, which tells rotated axes apart: `separable-rotated`.
    #[must_use]
    pub const fn command_name(self) -> &'static str {
        match self {
            Self::Interleaved { .. } => "interleaved",
            Self::ImportanceSampled { .. } => "importance-sampled",
            Self::Separable { rotated: false, .. } => "separable",
            Self::Separable { rotated: true, .. } => "separable-rotated",
            Self::Dense => "dense",
        }
    }

    /// Stem of its WGSL files, and of its twin in f64 if it has one.
    #[must_use]
    pub const fn stem(self) -> &'static str {
        match self {
            Self::Interleaved { .. } => "interleaved",
            Self::ImportanceSampled { .. } => "importance_sampled",
            Self::Separable { .. } => "separable",
            Self::Dense => "dense",
        }
    }

    /// Taps per pixel (of [`Separable`](Self::Separable): per pass). [`Dense`](Self::Dense) reads every pixel in reach
    /// and says 1, since 0 turns an estimator off.
    #[must_use]
    pub const fn taps(self) -> u32 {
        match self {
            Self::Interleaved { taps } | Self::ImportanceSampled { taps } | Self::Separable { taps, .. } => {
                taps
            }
            Self::Dense => 1,
        }
    }

    /// The same estimator with another number of taps, which [`refused_taps`](Self::refused_taps) checks.
    /// [`Dense`](Self::Dense) has no number of its own and stays as it is.
    #[must_use]
    pub const fn with_taps(self, taps: u32) -> Self {
        match self {
            Self::Interleaved { .. } => Self::Interleaved { taps },
            Self::ImportanceSampled { .. } => Self::ImportanceSampled { taps },
            Self::Separable { rotated, .. } => Self::Separable { taps, rotated },
            Self::Dense => Self::Dense,
        }
    }

    /// The numbers of taps that it may have; `None` for one that has no choice.
    #[must_use]
    pub const fn tap_counts(self) -> Option<TapCounts> {
        match self {
            Self::Interleaved { .. } => Some(TapCounts { least: 1, most: 64, odd: false }),
            Self::ImportanceSampled { .. } => {
                Some(TapCounts { least: 1, most: crate::constants::LARGEST_TAP_COUNT, odd: false })
            }
            Self::Separable { .. } => Some(TapCounts { least: 3, most: 65, odd: true }),
            Self::Dense => None,
        }
    }

    /// The numbers that were expected, if its own is none of them.
    #[must_use]
    pub fn refused_taps(self) -> Option<TapCounts> {
        self.tap_counts().filter(|counts| !counts.contains(self.taps()))
    }

    /// Whether a stage comes before the last: the far field of blocks, or the blur along the first axis.
    #[must_use]
    pub const fn has_two_stages(self) -> bool {
        matches!(self, Self::Separable { .. } | Self::Interleaved { .. })
    }

    /// Whether its stages read pixels that an earlier one packed.
    #[must_use]
    pub const fn packs_pixels(self) -> bool {
        matches!(self, Self::Interleaved { .. })
    }

    /// Whether its last compute stage has another shape for software drivers: see [`ComputeShape`](crate::ComputeShape).
    #[must_use]
    pub const fn has_software_shape(self) -> bool {
        matches!(self, Self::Interleaved { .. })
    }

    /// Whether it reads the edge-spread curves of the profiles beside their quantiles, and the reach of lines.
    #[must_use]
    pub const fn reads_edge_curves(self) -> bool {
        matches!(self, Self::Separable { .. })
    }

    /// Whether each pixel turns the axes of the estimator.
    #[must_use]
    pub const fn is_rotated(self) -> bool {
        matches!(self, Self::Separable { rotated: true, .. })
    }

    /// Entry points of the subsurface pass in its module, those of the fragment path first.
    pub fn entry_points(self) -> impl Iterator<Item = &'static str> {
        let always = [
            "subsurface_vertex",
            "subsurface_fragment",
            "passthrough_fragment",
            "classify_compute",
            "subsurface_compute",
        ];
        let first = ["first_fragment", "first_compute"].into_iter().filter(move |_| self.has_two_stages());
        // The compute path packs pixels and squares as it classifies them.
        let pack = ["pack_fragment", "block_fragment", "square_fragment"]
            .into_iter()
            .filter(move |_| self.packs_pixels());
        let software = ["subsurface_software_compute"].into_iter().filter(move |_| self.has_software_shape());
        always.into_iter().chain(first).chain(pack).chain(software)
    }
}

/// As the header of a module has it: `Separable, 17 taps, rotated`.
impl fmt::Display for Estimator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        if self.tap_counts().is_some() {
            let taps = self.taps();
            write!(f, ", {taps} tap{}", if taps == 1 { "" } else { "s" })?;
        }
        if self.is_rotated() {
            f.write_str(", rotated")?;
        }
        Ok(())
    }
}

/// Why a text names no estimator.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EstimatorError {
    /// No estimator has this name.
    #[error("no estimator is called `{name}`; there are {}", names())]
    UnknownName {
        /// The name.
        name: String,
    },
    /// What follows the colon is no number.
    #[error("`{text}` is no number of taps; write for example {name}:{usual}")]
    NoNumber {
        /// The estimator's name.
        name: &'static str,
        /// The text.
        text: String,
        /// The usual number.
        usual: u32,
    },
    /// A number that the estimator cannot have.
    #[error("{name} has {}, not {taps}", of_taps(*expected))]
    Taps {
        /// The estimator's name.
        name: &'static str,
        /// The numbers that it may have.
        expected: TapCounts,
        /// The number.
        taps: u32,
    },
    /// A number for an estimator that has none.
    #[error("{name} reads every pixel in reach: it has no number of taps")]
    NoTaps {
        /// The estimator's name.
        name: &'static str,
    },
}

/// The numbers as a phrase with its noun.
fn of_taps(TapCounts { least, most, odd }: TapCounts) -> String {
    if odd {
        format!("an odd number of taps from {least} to {most}")
    } else {
        format!("{least} to {most} taps")
    }
}

fn names() -> String {
    Estimator::ALL.map(Estimator::command_name).join(", ")
}

/// `NAME` or `NAME:TAPS`, by [`command_name`](Estimator::command_name); without a number it has its usual one.
impl FromStr for Estimator {
    type Err = EstimatorError;

    fn from_str(text: &str) -> Result<Self, EstimatorError> {
        let (name, taps) = match text.split_once(':') {
            Some((name, taps)) => (name, Some(taps)),
            None => (text, None),
        };
        let usual = Self::ALL
            .into_iter()
            .find(|estimator| estimator.command_name() == name)
            .ok_or_else(|| EstimatorError::UnknownName { name: name.to_owned() })?;
        let Some(text) = taps else { return Ok(usual) };
        let name = usual.command_name();
        let taps = text.parse().map_err(|_| EstimatorError::NoNumber {
            name,
            text: text.to_owned(),
            usual: usual.taps(),
        })?;
        usual.checked_taps(taps)
    }
}

impl Estimator {
    /// The same estimator with another number of taps.
    ///
    /// # Errors
    /// A number that it cannot have.
    pub fn checked_taps(self, taps: u32) -> Result<Self, EstimatorError> {
        let name = self.command_name();
        if self.tap_counts().is_none() {
            return Err(EstimatorError::NoTaps { name });
        }
        let estimator = self.with_taps(taps);
        match estimator.refused_taps() {
            Some(expected) => Err(EstimatorError::Taps { name, expected, taps }),
            None => Ok(estimator),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    #[test]
    fn taps_end_where_their_range_does() {
        type WithTaps = fn(u32) -> Estimator;
        let estimators: [(WithTaps, &[u32], &[u32]); 3] = [
            (|taps| Estimator::ImportanceSampled { taps }, &[1, 2, 4096], &[0, 4097, u32::MAX]),
            (|taps| Estimator::Separable { taps, rotated: false }, &[3, 17, 65], &[0, 1, 2, 4, 64, 66, 67]),
            (|taps| Estimator::Interleaved { taps }, &[1, 4, 64], &[0, 65]),
        ];
        for (with_taps, legal, illegal) in estimators {
            for &taps in legal {
                assert_eq!(with_taps(taps).refused_taps(), None, "{}", with_taps(taps));
            }
            for &taps in illegal {
                assert!(with_taps(taps).refused_taps().is_some(), "{}", with_taps(taps));
            }
        }
        assert!(Estimator::ALL.iter().all(|estimator| estimator.refused_taps().is_none()));
    }

    #[test]
    fn estimators_in_words() {
        assert_eq!(Estimator::default().to_string(), "Interleaved, 4 taps");
        assert_eq!(Estimator::ImportanceSampled { taps: 1 }.to_string(), "ImportanceSampled, 1 tap");
        assert_eq!(
            Estimator::Separable { taps: 17, rotated: true }.to_string(),
            "Separable, 17 taps, rotated"
        );
        assert_eq!(Estimator::Dense.to_string(), "Dense");
    }

    #[test]
    fn every_estimator_is_read_by_its_name() {
        for estimator in Estimator::ALL {
            assert_eq!(estimator.command_name().parse(), Ok(estimator));
            if estimator.tap_counts().is_some() {
                let text = format!("{}:{}", estimator.command_name(), estimator.taps());
                assert_eq!(text.parse(), Ok(estimator));
            }
        }
        assert_eq!("separable-rotated:5".parse(), Ok(Estimator::Separable { taps: 5, rotated: true }));
    }

    #[test]
    fn a_wrong_name_or_number_says_what_is_right() {
        for (text, says) in [
            ("gauss", "there are interleaved, importance-sampled, separable, separable-rotated, dense"),
            ("interleaved:", "`` is no number of taps; write for example interleaved:4"),
            ("interleaved:0", "interleaved has 1 to 64 taps, not 0"),
            ("interleaved:65", "1 to 64"),
            ("importance-sampled:4097", "1 to 4096"),
            ("separable:16", "an odd number of taps from 3 to 65, not 16"),
            ("separable:99999999999", "no number of taps"),
            ("dense:3", "no number of taps"),
        ] {
            let error = text.parse::<Estimator>().unwrap_err().to_string();
            assert!(error.contains(says), "{text}: {error}");
        }
    }
}
