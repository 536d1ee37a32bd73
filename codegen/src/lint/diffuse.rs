//! Diffuse lobes that send back more than arrives.

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;
use crate::material::DiffuseLobe;
use crate::schema::rounded;

/// Surface albedo above which Lommel's and Seeliger's lobe sends back more than all of the light that grazes it: its
/// albedo there is 2 over 8/3 (1 - ln 2), times the mean one.
const WHITEST_LOMMEL_SEELIGER: f64 = 0.409;

pub(super) fn check(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let Some(place) = material.diffuse_given else { return };
    match material.diffuse {
        DiffuseLobe::Disney { .. } => diagnostics.push(
            Diagnostic::warning("Disney's diffuse lobe does not conserve energy")
                .label(place.span.clone(), "up to 1.46 times the surface albedo at grazing angles")
                .help("its sources have it so; `Chandrasekhar` or `Coupled` conserve energy"),
        ),
        DiffuseLobe::LommelSeeliger { .. } => {
            let whitest = material.surface_albedo.values.into_iter().fold(0.0, f64::max);
            if whitest > WHITEST_LOMMEL_SEELIGER {
                diagnostics.push(
                    Diagnostic::warning(format!(
                        "at a surface albedo of {} this lobe sends back more than all of the light that grazes it",
                        rounded(whitest)
                    ))
                    .label(place.span.clone(), format!("it is for dark media, up to {WHITEST_LOMMEL_SEELIGER}"))
                    .secondary(material.surface_albedo.span.clone(), "the surface albedo")
                    .help("`Chandrasekhar` is the lobe of bright media"),
                );
            }
        }
        _ => (),
    }
}
