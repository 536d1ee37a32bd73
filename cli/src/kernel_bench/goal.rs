//! What the default kernel has to reach against another.

/// What [`Interleaved`](subsurface_codegen::Estimator::Interleaved) has to reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// The rival's PSNR in at most [`LARGEST_SHARE`] of its time.
    Faster,
    /// At least [`CLOSER_DB`] more than the rival in less time.
    FasterAndCloser,
}

/// The largest share of the rival's time.
pub const LARGEST_SHARE: f64 = 0.4;

/// The least gain in PSNR, dB.
pub const CLOSER_DB: f64 = 4.0;
