//! What a material set adds to the shaders: the row of its parameter table, the dispatch over the models in use, and
//! the rows themselves.

use std::fmt::Write as _;

use subsurface_profile::ModelKind;
use subsurface_profile::description::Description;

use crate::compose::Glue;
use crate::curves::{CurvePlace, Curves, NoProfile};
use crate::diagnostics::Diagnostic;
use crate::identifier::screaming_case;
use crate::material::{Material, MaterialSet};
use crate::mixture_text::{emit_mixtures, emit_shape};
use crate::model_row::{ModelsInUse, Shared, constant, has_shape, is_mixture, structure};
use crate::schema::rounded;
use crate::value::Value;
use subsurface_kernel::Estimator;
use subsurface_kernel::OutputFormat;
use subsurface_kernel::{Rejected, Rejection};

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

impl From<NoProfile> for Diagnostic {
    fn from(NoProfile { span, surface_albedo, reason }: NoProfile) -> Self {
        let at = rounded(surface_albedo);
        Diagnostic::error(format!("this model has no profile at surface albedo {at}: {reason}"))
            .label(span, "a texture may give any surface albedo from 0 to 1")
            .help("change the coefficients of the model, or use a published profile")
    }
}

/// Writes the glue of `set`.
///
/// # Errors
/// A model without a profile at a surface albedo that a texture may have.
pub(crate) fn emit(set: &MaterialSet, choices: &Choices) -> Result<Emitted, NoProfile> {
    let with_edges = matches!(choices.estimator, Estimator::Separable { .. });
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
    glue.text.push_str(PROFILE_CURVES);
    emit_row(&mut glue.text, &models.of_materials);
    emit_shape(&mut glue.text, models.most_parts);
    emit_dispatch(&mut glue.text, &models);
    if models.most_parts > 0 {
        emit_mixtures(&mut glue.text, &models);
    }
    shared.emit(&mut glue.text);
    curves.append(&shared.terms.texels);
    Ok(Emitted { glue, rows, knots: shared.knots.values, curves, models: models.all })
}

fn row(material: &Material, models: &ModelsInUse, place: &CurvePlace, shared: &mut Shared) -> Value {
    let (number, coefficients) = models.row(&material.profile.model, shared);
    let surface = Value::Struct(vec![
        ("length_mm", Value::vector(material.length_mm)),
        ("model", Value::U32(number)),
        ("surface_albedo", Value::vector(material.surface_albedo)),
        ("reflectance_at_normal", Value::scalar(material.reflectance_at_normal)),
        ("roughness", Value::scalar(material.roughness)),
        ("transmission_strength", Value::scalar(material.transmission_strength)),
        ("first_curve", Value::U32(place.first_curve)),
        ("curve_count", Value::U32(place.curve_count)),
        ("first_edge", Value::U32(place.first_edge)),
        ("edge_reach", Value::scalar(place.edge_reach)),
    ]);
    Value::Struct(std::iter::once(("surface", surface)).chain(coefficients).collect())
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
        ("Stages read pixels that an earlier one packed.", "PACKS_PIXELS", estimator.packs_pixels()),
    ] {
        let _ = writeln!(text, "/// {docs}\nconst {name}: bool = {value};\n");
    }
    text.push_str("/// What the compute path writes to.\nalias DiffusedTexture = texture_storage_2d<");
    let start = text.len();
    text.push_str(output_format.wgsl());
    glue.output_format = Some(start..text.len());
    text.push_str(", write>;\n\n");
}

/// The texture of `Curves`.
const PROFILE_CURVES: &str = "\
/// Radii by share of the energy: a row of 64 texels per profile and surface albedo. A texel holds the value where its
/// interval starts and the growth over it, of this row's surface albedo and of the next one's.
@group(0) @binding(2) var profile_curves: texture_2d<f32>;

";

fn emit_row(text: &mut String, models: &[ModelKind]) {
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

/// A function whose body is chosen by model: a plain call where the set uses one model only. What `call` returns may have
/// lines, which are indented.
pub(crate) fn emit_switch(
    text: &mut String,
    head: &str,
    selector: &str,
    models: &[ModelKind],
    call: impl Fn(ModelKind) -> String,
) {
    let _ = writeln!(text, "{head} {{");
    if let [only] = models {
        let _ = writeln!(text, "    return {};", call(*only).replace('\n', "\n    "));
    } else {
        let _ = writeln!(text, "    switch {selector} {{");
        for (index, model) in models.iter().enumerate() {
            if index + 1 == models.len() {
                text.push_str("        default: {\n");
            } else {
                let _ = writeln!(text, "        case {}: {{", constant(*model));
            }
            let returned = call(*model).replace('\n', "\n            ");
            let _ = writeln!(text, "            return {returned};\n        }}");
        }
        text.push_str("    }\n");
    }
    text.push_str("}\n\n");
}

/// The call of a model's function that evaluates its coefficients, which are a member of `owner`.
pub(crate) fn profile_call(kind: ModelKind, owner: &str) -> String {
    let Description { stem, lengths, .. } = kind.description();
    let arguments = if lengths.is_empty() { "channel" } else { "surface_albedo, length_mm" };
    format!("{stem}_profile({owner}.{stem}, {arguments})")
}

/// What every profile answers: name of the function, its argument, its documentation.
pub(crate) const FUNCTIONS: [(&str, &str, &str); 4] = [
    ("area_pdf", "radius_mm", "R(r) / A per unit area, mm⁻². May diverge at r = 0."),
    ("radial_pdf", "radius_mm", "2πr R(r) / A per unit radius, mm⁻¹."),
    ("radial_cdf", "radius_mm", "Fraction of the reflected energy that leaves within `radius_mm`."),
    ("sample_radius", "u", "Inverse of `profile_radial_cdf`: the radius, mm, for u in [0, 1)."),
];

fn emit_dispatch(text: &mut String, models: &ModelsInUse) {
    text.push_str("/// The profiles of the three channels of a material at a given surface albedo.\n");
    text.push_str(
        "fn material_profiles(row: SubsurfaceMaterial, surface_albedo: vec3f) -> ChannelProfiles {\n    \
         return ChannelProfiles(\n        material_profile(row, surface_albedo.r, row.surface.length_mm.r, 0u),\n        \
         material_profile(row, surface_albedo.g, row.surface.length_mm.g, 1u),\n        \
         material_profile(row, surface_albedo.b, row.surface.length_mm.b, 2u),\n    );\n}\n\n",
    );
    let (kinds, has_parts) = (&models.of_materials, models.most_parts > 0);
    text.push_str("/// The profile of one channel (0 red, 1 green, 2 blue) of a material.\n");
    let head = "fn material_profile(\n    row: SubsurfaceMaterial,\n    surface_albedo: f32,\n    length_mm: f32,\n    \
                channel: u32,\n) -> Profile";
    emit_switch(text, head, "row.surface.model", kinds, |kind| {
        let Description { stem, lengths, .. } = kind.description();
        let is_mixture = is_mixture(kind);
        let coefficients = if is_mixture { "vec4f()".to_owned() } else { profile_call(kind, "row") };
        let shape = match (is_mixture, has_shape(kind), has_parts) {
            (true, ..) => format!("{stem}_shape(row.{stem}, surface_albedo, length_mm, channel)"),
            (_, true, true) => format!("ProfileShape(row.{stem}.shape, array<MixturePart, MIXTURE_PARTS>())"),
            (_, true, false) => format!("row.{stem}.shape"),
            (_, false, true) => "ProfileShape()".to_owned(),
            (_, false, false) => "vec4f()".to_owned(),
        };
        let curve = match (is_mixture, lengths) {
            (true, _) => "channel_albedo_curve(row.surface, channel, surface_albedo)",
            (_, []) => "channel_curve(row.surface, channel)",
            _ => "albedo_curve(row.surface, surface_albedo, length_mm)",
        };
        format!("Profile(\n    {},\n    {coefficients},\n    {shape},\n    {curve},\n)", constant(kind))
    });
    let constants = if has_parts { "profile.shape.constants" } else { "profile.shape" };
    for (function, argument, docs) in FUNCTIONS {
        let _ = writeln!(text, "/// {docs}");
        let head = format!("fn profile_{function}(profile: Profile, {argument}: f32) -> f32");
        emit_switch(text, &head, "profile.model", kinds, |kind| {
            if is_mixture(kind) {
                return format!("{}_{function}(profile.shape, {argument})", kind.description().stem);
            }
            function_call(kind, function, ["profile.coefficients", constants, argument])
        });
    }
}

/// The call of one of a model's [`FUNCTIONS`].
pub(crate) fn function_call(
    kind: ModelKind,
    function: &str,
    [coefficients, shape, argument]: [&str; 3],
) -> String {
    let shape = if has_shape(kind) { format!("{shape}, ") } else { String::new() };
    format!("{}_{function}({coefficients}, {shape}{argument})", kind.description().stem)
}
