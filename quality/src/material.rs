//! What a search knows of a material.

use subsurface_profile::Model;

/// What of a material bears on how its light diffuses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material<'a> {
    /// Its profile model.
    pub model: &'a Model,
    /// Length that scales the profile, per channel (red, green, blue), mm, > 0: the mean free path or the diffuse mean
    /// free path, as [`Model::length`] says.
    pub mean_free_path_mm: [f64; 3],
    /// Surface albedo per channel, in [0, 1].
    pub surface_albedo: [f64; 3],
}
