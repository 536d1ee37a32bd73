//! The length that a model is parametrized by.

use std::fmt;

/// Which length of the medium a [`Model`](crate::Model) expects in
/// [`Medium::mean_free_path_mm`](crate::Medium::mean_free_path_mm).
///
/// The two are different quantities, not two units of one: no conversion happens behind the caller's back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Length {
    /// ℓ = 1/σt, the mean distance between two collisions inside the medium.
    MeanFreePath,
    /// ℓ_d = 1/σtr, the distance in which the diffuse flux falls by a factor e (\[CB15\] §5).
    DiffuseMeanFreePath,
}

impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Length::MeanFreePath => "mean free path",
            Length::DiffuseMeanFreePath => "diffuse mean free path",
        })
    }
}
