//! The GPUs that are asked.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// A family of AMD GPUs that Mesa's RADV compiles for, present or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Family {
    /// GCN 4, 2016: RX 470 to 590.
    Polaris10,
    /// GCN 5, 2017: RX Vega 56 and 64.
    Vega10,
    /// RDNA 2, 2020: RX 6800 and 6900; the consoles of that year.
    Navi21,
    /// RDNA 3, 2022: RX 7900.
    Gfx1100,
}

impl Family {
    /// Every family, the oldest first.
    pub(crate) const ALL: [Self; 4] = [Self::Polaris10, Self::Vega10, Self::Navi21, Self::Gfx1100];

    /// Its name in `RADV_FORCE_FAMILY` and on the command line.
    #[must_use]
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Polaris10 => "polaris10",
            Self::Vega10 => "vega10",
            Self::Navi21 => "navi21",
            Self::Gfx1100 => "gfx1100",
        }
    }
}
