//! A material whose model has no profile, where its file says so.

use subsurface_quality::NoProfile;

use crate::diagnostics::Diagnostic;
use crate::material::MaterialSet;
use crate::schema::rounded;

/// The error of a material of `set`.
pub(crate) fn no_profile(set: &MaterialSet, error: &NoProfile) -> Diagnostic {
    let at = rounded(error.surface_albedo);
    let reason = &error.reason;
    Diagnostic::error(format!("this model has no profile at surface albedo {at}: {reason}"))
        .label(
            set.materials[error.material].profile.span.clone(),
            "a texture may give any surface albedo from 0 to 1",
        )
        .help("change the coefficients of the model, or use a published profile")
}
