//! A search that has found nothing.

use subsurface_kernel::Estimator;

use crate::no_profile::NoProfile;

/// Why a search has found nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum SearchError {
    /// No candidate is within the error.
    OutOfReach {
        /// The best of them.
        best: Estimator,
        /// Its error, stated as [`QualityReport::error`](crate::QualityReport::error) is.
        error: f64,
    },
    /// A material without a profile.
    NoProfile(NoProfile),
}
