//! What the fields of a material must be to each other.

use subsurface_profile::{Channel, Length, Medium};

use super::Resolution;
use crate::diagnostics::Diagnostic;
use crate::lint;
use crate::material::{ResolvedProfile, Transmittance};
use crate::schema::{LengthGiven, Triple, rounded};
use crate::source::{Span, Spanned};

impl Resolution {
    /// Whether the given length is one that the profile can use.
    pub(super) fn check_length(
        &mut self,
        profile: &ResolvedProfile,
        length: &LengthGiven,
        surface_albedo: &Triple,
        profile_name: Option<&Span>,
    ) -> bool {
        let scales = profile.model.dependence().on_length();
        if !scales || length.kind == profile.model.length() || length.kind == Length::MeanFreePath {
            return true; // a mean free path given as the diffuse one is a lint: the field's name is the usual one
        }
        let converted = [0, 1, 2].map(|index| {
            let factor = lint::diffuse_per_mean_free_path(surface_albedo.values[index]);
            rounded(length.value.values[index] / factor)
        });
        let mut diagnostic = Diagnostic::error("this profile takes the mean free path, not the diffuse one")
            .label(length.key.clone(), "the profile is not parametrized by this length")
            .help(format!(
                "with ℓ = ℓ_d √(3 (1 - α)/(2 - α)) and this surface albedo, write `mean_free_path_mm: ({})`",
                converted.join(", ")
            ))
            .help("or use a profile that takes it: `\"burley_dmfp\"`");
        if let Some(span) = profile_name {
            diagnostic = diagnostic.secondary(span.clone(), "the profile is named here");
        }
        self.diagnostics.push(diagnostic);
        false
    }

    /// Whether the model has a profile for this very medium.
    pub(super) fn check_profile(
        &mut self,
        profile: &ResolvedProfile,
        length: &LengthGiven,
        surface_albedo: &Triple,
        profile_name: Option<&Span>,
    ) -> bool {
        let error = Channel::ALL.into_iter().find_map(|channel| {
            let index = channel.index();
            match Medium::new(surface_albedo.values[index], length.value.values[index]) {
                Ok(medium) => {
                    profile.model.profile(medium, channel).err().map(|error| (index, error.to_string()))
                }
                Err(error) => Some((index, error.to_string())),
            }
        });
        let Some((index, error)) = error else { return true };
        let mut diagnostic = Diagnostic::error(format!("this material has no profile: {error}"))
            .label(profile.span.clone(), "the model fails for this medium")
            .secondary(surface_albedo.spans[index].clone(), "at this surface albedo")
            .secondary(length.value.spans[index].clone(), "and this length")
            .help("change the coefficients of the model, or use a published profile");
        if let Some(span) = profile_name {
            diagnostic = diagnostic.secondary(span.clone(), "used here");
        }
        self.diagnostics.push(diagnostic);
        false
    }

    /// Whether the law of transmittance is one that a sheet can have.
    pub(super) fn check_thin(
        &mut self,
        law: Option<&Spanned<Transmittance>>,
        thin: Option<&Spanned<f64>>,
    ) -> bool {
        let (Some(law), Some(thin)) = (law.filter(|law| law.value == Transmittance::Profile), thin) else {
            return true;
        };
        self.diagnostics.push(
            Diagnostic::error("a thin sheet lets through what a slab does")
                .label(law.span.clone(), "this law is for what is thick")
                .secondary(thin.span.clone(), "the sheet is given here")
                .help("remove `transmittance: Profile`, or remove `thin`"),
        );
        false
    }
}
