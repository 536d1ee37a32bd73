//! Lengths that look like another unit, or another quantity.

use subsurface_profile::Length;
use subsurface_profile::single_scattering_albedo::{self, Entry, from_surface_albedo};

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;
use crate::schema::rounded;

/// Longest plausible mean free path in mm. Clear materials reach centimetres; a metre is a unit error, or glass.
const LONGEST_MM: f64 = 1000.0;
/// Shortest plausible mean free path in mm: 1 µm, about the wavelength of light.
const SHORTEST_MM: f64 = 1e-3;

/// ℓ_d/ℓ of the medium that has this surface albedo; infinite at 1.
pub(crate) fn diffuse_per_mean_free_path(surface_albedo: f64) -> f64 {
    single_scattering_albedo::diffuse_per_mean_free_path(from_surface_albedo(
        Entry::Searchlight,
        surface_albedo,
    ))
}

pub(super) fn check(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let length = &material.length;
    for (value, span) in length.value.values.into_iter().zip(&length.value.spans) {
        let (what, help) = if value > LONGEST_MM {
            ("long", "lengths are in mm: a value in µm must be divided by 1000, one in nm by 1000000")
        } else if value < SHORTEST_MM {
            ("short", "lengths are in mm: a value in m must be multiplied by 1000, one in cm by 10")
        } else {
            continue;
        };
        let shown = rounded(value);
        diagnostics.push(
            Diagnostic::warning(format!("{} of {shown} mm is suspiciously {what}", length.kind))
                .label(
                    span.clone(),
                    format!("expected {} to {} mm", rounded(SHORTEST_MM), rounded(LONGEST_MM)),
                )
                .help(help),
        );
    }
    check_parametrization(material, diagnostics);
}

fn check_parametrization(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let length = &material.length;
    let is_scaled = material.profile.model.dependence().on_length();
    let takes_diffuse = material.profile.model.length() == Length::DiffuseMeanFreePath;
    if !(is_scaled && takes_diffuse && length.kind == Length::MeanFreePath) {
        return;
    }
    let converted = [0, 1, 2].map(|index| {
        let ratio = diffuse_per_mean_free_path(material.surface_albedo.values[index]);
        rounded(length.value.values[index] * ratio)
    });
    let converted = format!("({})", converted.join(", "));
    let as_written = length.value.values.map(rounded).join(", ");
    let mut diagnostic = Diagnostic::warning("the mean free path is read as the diffuse mean free path")
        .label(length.key.clone(), "this profile is parametrized by the diffuse mean free path")
        .help(format!(
            "if it is the diffuse mean free path, write `diffuse_mean_free_path_mm: ({as_written})`"
        ));
    diagnostic = if converted.contains("inf") {
        diagnostic.help(
            "if it is the mean free path ℓ: a medium of surface albedo 1 has no finite ℓ_d = ℓ √((2 - α)/(3 (1 - α)))",
        )
    } else {
        diagnostic.help(format!(
            "if it is the mean free path ℓ, write ℓ_d = ℓ √((2 - α)/(3 (1 - α))) for this surface albedo: \
             `diffuse_mean_free_path_mm: {converted}`"
        ))
    };
    if let Some(span) = material.profile_name {
        diagnostic = diagnostic.secondary(span.clone(), "the profile is named here");
    }
    diagnostics.push(diagnostic);
}
