//! Surface albedos beyond those of a table.

use subsurface_profile::description::Contents;
use subsurface_profile::{Channel, TabulatedModel};

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;
use crate::schema::rounded;

/// Surface albedos are written with three decimals, so one that means the end of a table may miss it by half a unit of
/// the last.
const TOLERANCE: f64 = 0.0005;

/// Warns of surface albedos for which the nearest table stands in. Not of a single table, which is the shape for all;
/// and not of 0, which shows none.
pub(super) fn check(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    for (_, model) in material.profile.model.leaves() {
        if let Contents::Table(table) = model.contents() {
            check_table(material, table, diagnostics);
        }
    }
}

fn check_table(material: &Draft<'_>, model: &TabulatedModel, diagnostics: &mut Vec<Diagnostic>) {
    let mut known = model.surface_albedos();
    // What is left after the first has no last where there is only one.
    let (Some(least), Some(most)) = (known.next(), known.last()) else { return };
    let slack = TOLERANCE + 1e-9; // covers the rounding of the difference
    let outside: Vec<(Channel, f64)> = Channel::ALL
        .into_iter()
        .map(|channel| (channel, material.surface_albedo.values[channel.index()]))
        .filter(|&(_, value)| value > 0.0 && (value < least - slack || value > most + slack))
        .collect();
    let Some(&(first, _)) = outside.first() else { return };
    // The one channel, or all three together.
    let span = match outside.len() {
        1 => &material.surface_albedo.spans[first.index()],
        _ => &material.surface_albedo.span,
    };
    let nearest = |value: f64| rounded(value.clamp(least, most));
    let spread: Vec<String> = outside
        .iter()
        .map(|&(channel, value)| format!("{} in {channel} spreads as {}", rounded(value), nearest(value)))
        .collect();
    let (least, most) = (rounded(least), rounded(most));
    let mut diagnostic = Diagnostic::warning("the surface albedo is outside of the table")
        .label(span.clone(), spread.join(", "))
        .secondary(material.profile.span.clone(), format!("its surface albedos are {least} to {most}"))
        .help(format!(
            "give {least} to {most}, or add rows of this surface albedo to the table; a table of one surface albedo \
             is the shape for all"
        ));
    if let Some(span) = material.profile_name {
        diagnostic = diagnostic.secondary(span.clone(), "the profile is named here");
    }
    diagnostics.push(diagnostic);
}
