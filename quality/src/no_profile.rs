//! A material without a profile.

/// A surface albedo at which the model of a material has no profile.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct NoProfile {
    /// The material, by its place in the list.
    pub material: usize,
    /// The surface albedo.
    pub surface_albedo: f64,
    /// What the model says.
    pub reason: String,
}

impl NoProfile {
    /// The material at `material` of a list has no profile at `surface_albedo`, for this `reason`.
    pub fn new(material: usize, surface_albedo: f64, reason: String) -> Self {
        Self { material, surface_albedo, reason }
    }
}
