//! What a material set adds to the shaders: the row of its parameter table, the dispatch over the models in use, and
//! the rows themselves.

use std::fmt::Write as _;

use subsurface_profile::ModelKind;

use crate::compose::Glue;
use crate::curves::Curves;
use crate::dispatch_text::emit_dispatch;
use crate::identifier::screaming_case;
use crate::material::{Material, MaterialSet, Transmittance};
use crate::material_row::{emit_row, row};
use crate::mixture_text::{emit_mixtures, emit_shape};
use crate::model_row::{ModelsInUse, Shared, constant};
use crate::specular_albedo::{self, ROUGHNESSES};
use crate::value::Value;
use subsurface_kernel::Estimator;
use subsurface_kernel::OutputFormat;
use subsurface_kernel::{Rejected, Rejection};
use subsurface_quality::NoProfile;

/// The glue text of a set and the values of its table.
#[derive(Debug)]
pub(crate) struct Emitted {
    pub(crate) glue: Glue,
    /// One value per material: fields as in the emitted `SubsurfaceMaterial`.
    pub(crate) rows: Vec<Value>,
    /// The knots of all tables, as in `TabulatedKnot` of the shaders; empty where the set uses none.
    pub(crate) knots: Vec<Value>,
    /// The profiles as a texture of radii.
    pub(crate) curves: Curves,
    /// Models in use, by number.
    pub(crate) models: Vec<ModelKind>,
}

/// What a set is compiled for, beside its materials.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Choices {
    pub(crate) estimator: Estimator,
    pub(crate) rejection: Rejection,
    pub(crate) output_format: OutputFormat,
}

/// Writes the glue of `set`.
///
/// # Errors
/// A model without a profile at a surface albedo that a texture may have.
pub(crate) fn emit(set: &MaterialSet, choices: &Choices) -> Result<Emitted, NoProfile> {
    let with_edges = choices.estimator.reads_edge_curves();
    let mut curves = Curves::bake(set, with_edges)?;
    let models = ModelsInUse::of(set.materials.iter().map(|material| &material.profile.model));

    let mut shared = Shared::after(&curves);
    let rows = set
        .materials
        .iter()
        .zip(&curves.places)
        .map(|(material, place)| row(material, &models, place, &mut shared))
        .collect();

    let mut glue = Glue::default();
    emit_constants(&mut glue, set, &models.all);
    emit_choices(&mut glue, choices);
    emit_features(&mut glue.text, set);
    glue.text.push_str(PROFILE_CURVES);
    emit_row(&mut glue.text, &models.of_materials);
    emit_shape(&mut glue.text, models.most_parts);
    emit_dispatch(&mut glue.text, &models);
    if models.most_parts > 0 {
        emit_mixtures(&mut glue.text, &models);
    }
    shared.emit(&mut glue.text);
    curves.append(&shared.terms.texels);
    emit_specular_albedo(&mut glue, &mut curves);
    Ok(Emitted { glue, rows, knots: shared.knots.values, curves, models: models.all })
}

/// The constant that holds a material's number.
pub(crate) fn material_constant(name: &str) -> String {
    format!("MATERIAL_{}", screaming_case(name))
}

fn emit_constants(glue: &mut Glue, set: &MaterialSet, models: &[ModelKind]) {
    let text = &mut glue.text;
    let material_count = set.materials.len();
    let _ = writeln!(text, "/// Materials in the set.\nconst MATERIALS_IN_SET: u32 = {material_count}u;\n");
    let bits = usize::BITS - material_count.leading_zeros();
    let _ = writeln!(
        text,
        "/// Bits that hold a material number + 1, 0 for none.\nconst MATERIAL_BITS: u32 = {bits}u;\n"
    );
    // Nothing of ours names a material, but a pass of the caller's own may; unused ones are dropped.
    for (number, material) in set.materials.iter().enumerate() {
        let name = material_constant(&material.name);
        let _ = write!(text, "/// Number of the material `{}`.\nconst ", material.name);
        glue.origins.push((text.len()..text.len() + name.len(), material.span.clone()));
        let _ = writeln!(text, "{name}: u32 = {number}u;\n");
    }
    for (number, model) in models.iter().enumerate() {
        let _ = writeln!(text, "const {}: u32 = {number}u;\n", constant(*model));
    }
}

/// Constants that the passes branch on: a driver drops the branch that is not taken.
fn emit_choices(glue: &mut Glue, choices: &Choices) {
    let text = &mut glue.text;
    let Choices { estimator, rejection, output_format } = choices;
    let returned = rejection.rejected == Rejected::ReturnedToCentre;
    for (docs, name, value) in [
        ("Taps on another material are left out.", "REJECT_BY_MATERIAL", rejection.by_material),
        (
            "Taps are weighted by their distance in space, not on the screen.",
            "REJECT_BY_DISTANCE",
            rejection.by_distance,
        ),
        (
            "Taps count by the cosine between their normal and the centre's.",
            "REJECT_BY_NORMAL",
            rejection.by_normal,
        ),
        (
            "Rejected weight goes to the pixel itself; else the other taps share it.",
            "RETURN_TO_CENTRE",
            returned,
        ),
        ("Each pixel turns the two axes of the kernel.", "SEPARABLE_ROTATED", estimator.is_rotated()),
    ] {
        let _ = writeln!(text, "/// {docs}\nconst {name}: bool = {value};\n");
    }
    text.push_str("/// What the compute path writes to.\nalias DiffusedTexture = texture_storage_2d<");
    let start = text.len();
    text.push_str(output_format.wgsl());
    glue.output_format = Some(start..text.len());
    text.push_str(", write>;\n\n");
}

/// What at least one material of the set has: what none has costs nothing.
fn emit_features(text: &mut String, set: &MaterialSet) {
    let any = |has: fn(&Material) -> bool| set.materials.iter().any(has);
    for (docs, name, value) in [
        (
            "Materials have a second specular lobe.",
            "SECOND_LOBES",
            any(|material| material.second_lobe.is_some()),
        ),
        (
            "Materials have a diffuse lobe of their own.",
            "DIFFUSE_LOBES",
            any(|material| material.diffuse.is_brdf()),
        ),
        (
            "Light is multiplied by a part of the surface albedo where it enters.",
            "ALBEDO_MIXES",
            any(|material| material.surface_albedo_mix > 0.0 && material.thin_thickness_mm.is_none()),
        ),
        ("Materials are sheets.", "THIN_SHEETS", any(|material| material.thin_thickness_mm.is_some())),
        (
            "What comes through is what the profile says.",
            "PROFILES_TRANSMIT",
            any(|material| {
                material.transmittance == Transmittance::Profile && material.thin_thickness_mm.is_none()
            }),
        ),
        (
            "Light that came through diffuses.",
            "TRANSMISSION_DIFFUSES",
            any(|material| material.transmission_diffused),
        ),
    ] {
        let _ = writeln!(text, "/// {docs}\nconst {name}: bool = {value};\n");
    }
}

/// Adds the rows of the specular albedo, and the constants that say where they are.
fn emit_specular_albedo(glue: &mut Glue, curves: &mut Curves) {
    let [at_normal, at_grazing] = specular_albedo::by_cosine();
    let first = curves.append_rows(&at_normal);
    curves.append_rows(&at_grazing);
    let means = curves.append_rows(&specular_albedo::means());
    let text = &mut glue.text;
    for (docs, name, value) in [
        (
            "First row of the specular albedo by roughness: what F₀ is multiplied by. As many rows on is that of F₉₀.",
            "SPECULAR_ALBEDO_ROW",
            first,
        ),
        ("Row of their means over the hemisphere, by roughness.", "SPECULAR_MEAN_ROW", means),
        ("Roughnesses with a row of the specular albedo.", "SPECULAR_ROUGHNESSES", ROUGHNESSES as u32),
    ] {
        let _ = writeln!(text, "/// {docs}\nconst {name}: i32 = {value};\n");
    }
}

/// The texture of `Curves`.
const PROFILE_CURVES: &str = "\
/// Radii by share of the energy: a row of 64 texels per profile and surface albedo. A texel holds the value where its
/// interval starts and the growth over it, of this row's surface albedo and of the next one's.
@group(0) @binding(2) var profile_curves: texture_2d<f32>;

";
