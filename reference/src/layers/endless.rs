//! How long a packet wanders in a layer.

/// Order of magnitude of the mean number of scattering events of a packet in one layer, or of its reflections there where
/// these are more; coefficients in cm⁻¹, the thickness in cm.
///
/// A walk that enters a slab of τ scattering lengths leaves it after τ steps on average, most walks much earlier, a few
/// after τ². Absorption with a probability ε = μa/μs per step ends walks longer than 1/ε, and the mean with them: the
/// number of steps of a walk that returns to its plane has the density n^(−3/2) (Sparre Andersen 1953), whose mean cut
/// at 1/ε is ε^(−1/2).
///
/// Of diffuse light that meets the surface of a medium whose index is `trap` times that outside, one part in trap² is
/// within the critical angle: so many times it comes back before it leaves, but never more than 1/ε scatterings.
pub(super) fn expected_scatterings(scattering: f64, absorption: f64, thickness: f64, trap: f64) -> f64 {
    if scattering == 0.0 {
        return 0.0;
    }
    let returns = (trap * trap).max(1.0);
    let longest = scattering / absorption;
    let by_thickness = (scattering * thickness).max(1.0) * returns;
    let by_absorption = longest.sqrt() * returns;
    by_thickness.min(by_absorption).min(longest)
}
