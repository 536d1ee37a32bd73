//! The row of a material in the parameter table: its struct in WGSL, and its values.
//!
//! What all materials have stands in `shaders/gather/material.wgsl`; the models' part is `model_row`'s.

use std::fmt::Write as _;

use subsurface_profile::ModelKind;
use subsurface_profile::single_scattering_albedo::coefficients_below;

use crate::curves::CurvePlace;
use crate::material::{Material, Transmittance};
use crate::model_row::{ModelsInUse, Shared, constant, structure};
use crate::value::Value;

/// The struct of a row of a set with these models.
pub(crate) fn emit_row(text: &mut String, models: &[ModelKind]) {
    text.push_str("/// One row of the parameter table: a material.\nstruct SubsurfaceMaterial {\n");
    text.push_str("    /// What every material has.\n    surface: MaterialSurface,\n");
    // The alignment that a uniform buffer demands of a struct in a struct, and that costs a storage buffer little.
    for model in models {
        let (stem, structure) = (model.description().stem, structure(*model));
        let _ = writeln!(text, "    /// Coefficients, if `surface.model` is {}.", constant(*model));
        let _ = writeln!(text, "    @align(16) {stem}: {structure},");
    }
    text.push_str("}\n\n");
}

/// The values of a row.
pub(crate) fn row(
    material: &Material,
    models: &ModelsInUse,
    place: &CurvePlace,
    shared: &mut Shared,
) -> Value {
    let (number, coefficients) = models.row(&material.profile.model, shared);
    let is_slab = material.transmittance == Transmittance::Slab || material.thin_thickness_mm.is_some();
    let scales = material.profile.model.dependence().on_length();
    let slab_length = match (is_slab, scales) {
        (true, _) => material.slab_mean_free_path_mm(),
        (false, true) => material.slab_mean_free_path_mm().map(|length| -length),
        (false, false) => [0.0; 3],
    };
    let surface = Value::Struct(vec![
        ("mean_free_path_mm", Value::vector(material.mean_free_path_mm)),
        ("model", Value::U32(number)),
        ("surface_albedo", Value::vector(material.surface_albedo)),
        ("reflectance_at_normal", Value::scalar(material.reflectance_at_normal)),
        ("slab_mean_free_path_mm", Value::vector(slab_length)),
        ("thin_thickness_mm", Value::scalar(material.thin_thickness_mm.unwrap_or_default())),
        ("roughness", Value::scalar(material.roughness)),
        ("coupling", Value::U32(material.coupling.number())),
        ("diffuse", Value::U32(material.diffuse.number())),
        (
            "albedo_coefficients",
            Value::vector(coefficients_below(
                material.entry(),
                material.refractive_index.unwrap_or_else(|| material.boundary_index()),
            )),
        ),
        ("is_medium", Value::U32(u32::from(material.refractive_index.is_some()))),
        ("diffuse_shape", Value::vector(material.diffuse.shape())),
        ("second_roughness", Value::scalar(material.second_lobe.map_or(0.0, |lobe| lobe.roughness))),
        ("second_weight", Value::scalar(material.second_lobe.map_or(0.0, |lobe| lobe.weight))),
        ("transmission_strength", Value::scalar(material.transmission_strength)),
        ("transmission_diffused", Value::U32(u32::from(material.transmission_diffused))),
        ("surface_albedo_mix", Value::scalar(material.surface_albedo_mix)),
        ("first_curve", Value::U32(place.first_curve)),
        ("curve_count", Value::U32(place.curve_count)),
        ("first_edge", Value::U32(place.first_edge)),
        ("edge_reach", Value::scalar(place.edge_reach)),
    ]);
    Value::Struct(std::iter::once(("surface", surface)).chain(coefficients).collect())
}
