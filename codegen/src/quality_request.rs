//! What a set asks of its kernel in place of a number of taps.

use subsurface_kernel::Estimator;
use subsurface_quality::{Device, Quality};

use crate::source::Span;

/// A quality, where it is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct QualityRequest {
    /// What is asked for.
    pub quality: Quality,
    /// The kind of kernel that it is asked of, whatever its taps; `None` for the cheapest of all.
    pub estimator: Option<Estimator>,
    /// What the kernel is to be cheap on.
    pub device: Device,
    /// The value of `quality`.
    pub span: Span,
}
