//! Warnings: values that are legal but suspect. One file per family.

mod diffuse;
mod gaussian_weights;
mod length;
mod mixture_weights;
mod specular;
mod surface_albedo;
mod table_range;
mod thin;
mod transmission;

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;

pub(crate) use length::diffuse_per_mean_free_path;

/// Adds the warnings about one material.
pub(crate) fn check(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    length::check(material, diagnostics);
    surface_albedo::check(material, diagnostics);
    table_range::check(material, diagnostics);
    gaussian_weights::check(material, diagnostics);
    mixture_weights::check(material, diagnostics);
    specular::check(material, diagnostics);
    diffuse::check(material, diagnostics);
    transmission::check(material, diagnostics);
    thin::check(material, diagnostics);
}
