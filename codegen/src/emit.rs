//! What a material set adds to the shaders: the row of its parameter table, the dispatch over the models in use, and
//! the rows themselves.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use subsurface_profile::{GaussianSumModel, Model, TabulatedModel};

use crate::compose::Glue;
use crate::curves::{CurvePlace, Curves, NoProfile};
use crate::diagnostics::Diagnostic;
use crate::identifier::screaming_case;
use crate::material::{Material, MaterialSet};
use crate::model_kind::ModelKind;
use crate::schema::rounded;
use crate::source::Span;
use crate::unrolled::{gaussian_sums, table_search};
use crate::value::{Value, single};
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

/// Why nothing can be emitted for a set.
#[derive(Clone, Debug)]
pub(crate) enum EmitError {
    /// A model that this compiler knows no shader for, and where it is written.
    UnknownModel(Span),
    /// A model without a profile at a surface albedo that a texture may have.
    NoProfile(NoProfile),
}

impl From<EmitError> for Diagnostic {
    fn from(error: EmitError) -> Self {
        match error {
            EmitError::UnknownModel(span) => Diagnostic::error("this profile model has no shader yet")
                .label(span, "not supported by this version of the compiler")
                .help("use another model, or a newer version of subsurface-codegen"),
            EmitError::NoProfile(NoProfile { span, surface_albedo, reason }) => {
                let at = rounded(surface_albedo);
                Diagnostic::error(format!("this model has no profile at surface albedo {at}: {reason}"))
                    .label(span, "a texture may give any surface albedo from 0 to 1")
                    .help("change the coefficients of the model, or use a published profile")
            }
        }
    }
}

/// Writes the glue of `set`.
pub(crate) fn emit(set: &MaterialSet, choices: &Choices) -> Result<Emitted, EmitError> {
    let mut kinds = Vec::with_capacity(set.materials.len());
    for material in &set.materials {
        let unknown = || EmitError::UnknownModel(material.profile.span.clone());
        kinds.push(ModelKind::of(&material.profile.model).ok_or_else(unknown)?);
    }
    let with_edges = matches!(choices.estimator, Estimator::Separable { .. });
    let mut curves = Curves::bake(set, with_edges).map_err(EmitError::NoProfile)?;
    let models: Vec<ModelKind> = kinds.iter().copied().collect::<BTreeSet<_>>().into_iter().collect();

    let mut shared = Shared { terms: GaussianTerms::after(&curves), knots: TabulatedKnots::default() };
    let rows = set
        .materials
        .iter()
        .zip(kinds.iter().zip(&curves.places))
        .map(|(material, (&kind, place))| row(material, kind, &models, place, &mut shared))
        .collect();

    let mut glue = Glue::default();
    emit_constants(&mut glue, set, &models);
    emit_choices(&mut glue, choices);
    glue.text.push_str(PROFILE_CURVES);
    emit_row(&mut glue.text, &models);
    emit_dispatch(&mut glue.text, &models);
    if models.contains(&ModelKind::GaussianSum) {
        glue.text.push_str(GAUSSIAN_TERMS);
        glue.text.push_str(&gaussian_sums(shared.terms.longest));
        curves.append(&shared.terms.texels);
    }
    if models.contains(&ModelKind::Tabulated) {
        glue.text.push_str(TABULATED_KNOTS);
        glue.text.push_str(&table_search(shared.knots.longest));
    }
    Ok(Emitted { glue, rows, knots: shared.knots.values, curves, models })
}

/// Number of `kind` among the models in use.
fn number(models: &[ModelKind], kind: ModelKind) -> u32 {
    let position = models.iter().position(|&model| model == kind);
    position.and_then(|p| u32::try_from(p).ok()).expect("a row's model is among the models in use")
}

fn row(
    material: &Material,
    kind: ModelKind,
    models: &[ModelKind],
    place: &CurvePlace,
    shared: &mut Shared,
) -> Value {
    let surface = Value::Struct(vec![
        ("length_mm", Value::vector(material.length_mm)),
        ("model", Value::U32(number(models, kind))),
        ("surface_albedo", Value::vector(material.surface_albedo)),
        ("reflectance_at_normal", Value::scalar(material.reflectance_at_normal)),
        ("roughness", Value::scalar(material.roughness)),
        ("transmission_strength", Value::scalar(material.transmission_strength)),
        ("first_curve", Value::U32(place.first_curve)),
        ("curve_count", Value::U32(place.curve_count)),
        ("first_edge", Value::U32(place.first_edge)),
        ("edge_reach", Value::scalar(place.edge_reach)),
    ]);
    let mut fields = vec![("surface", surface)];
    let own = coefficients(material, shared);
    // Models are told apart by number: the row has room for all of the set, and nothing to say of the others.
    fields.extend(
        models.iter().map(|&model| (model.stem(), if model == kind { own.clone() } else { Value::Zero })),
    );
    Value::Struct(fields)
}

fn coefficients(material: &Material, shared: &mut Shared) -> Value {
    match &material.profile.model {
        Model::Burley(burley) => Value::Struct(vec![
            ("constant", Value::scalar(burley.shape.constant)),
            ("slope", Value::scalar(burley.shape.slope)),
            ("amplitude", Value::scalar(burley.shape.amplitude)),
            ("pivot", Value::scalar(burley.shape.pivot)),
            ("exponent", Value::scalar(burley.shape.exponent)),
        ]),
        Model::ExponentialDipole(model) => Value::Struct(vec![
            ("exponential_weight", Value::vector(model.exponential_weight)),
            ("exponential_length", Value::vector(model.exponential_length)),
            ("dipole_depth", Value::vector(model.dipole_depth)),
            ("dipole_attenuation", Value::vector(model.dipole_attenuation)),
        ]),
        Model::TwoExponentialDipole(model) => Value::Struct(vec![
            ("exponential_weight", Value::vector(model.exponential_weight)),
            ("exponential_length", Value::vector(model.exponential_length)),
            ("dipole_depth", Value::vector(model.dipole_depth)),
            ("dipole_attenuation", Value::vector(model.dipole_attenuation)),
            (
                "shape",
                Value::vector([
                    model.short_weight,
                    model.short_length,
                    model.second_weight,
                    model.second_depth,
                ]),
            ),
        ]),
        Model::Polynomial(model) => Value::Struct(vec![
            ("a_linear", Value::scalar(model.a.linear)),
            ("a_amplitude", Value::scalar(model.a.amplitude)),
            ("a_decades", Value::scalar(model.a.decades)),
            ("b_scale", Value::scalar(model.b.scale)),
            ("b_curvature", Value::scalar(model.b.curvature)),
            ("b_pivot", Value::scalar(model.b.pivot)),
            ("b_offset", Value::scalar(model.b.offset)),
            ("b_exponent", Value::scalar(model.b.exponent)),
            ("c_amplitude", Value::scalar(model.c.amplitude)),
            ("c_rate", Value::scalar(model.c.rate)),
            ("c_offset", Value::scalar(model.c.offset)),
        ]),
        Model::GaussianSum(model) => {
            let (first, count) = shared.terms.add(model);
            Value::Struct(vec![("first_term", Value::U32(first)), ("term_count", Value::U32(count))])
        }
        Model::Tabulated(model) => Value::Struct(vec![
            ("first_knot", Value::U32(shared.knots.add(model))),
            ("knot_count", Value::U32(number_of(model.radii().len()))),
            ("table_count", Value::U32(number_of(model.surface_albedos().len()))),
        ]),
        _ => Value::Struct(Vec::new()),
    }
}

/// What several rows may point into.
#[derive(Debug)]
struct Shared {
    terms: GaussianTerms,
    knots: TabulatedKnots,
}

/// Knots of all tables of a set; equal models share theirs.
#[derive(Debug, Default)]
struct TabulatedKnots {
    models: Vec<(TabulatedModel, u32)>,
    values: Vec<Value>,
    /// Knots of the longest table.
    longest: u32,
}

impl TabulatedKnots {
    /// First knot of `model`.
    fn add(&mut self, model: &TabulatedModel) -> u32 {
        if let Some((_, first)) = self.models.iter().find(|(known, _)| known == model) {
            return *first;
        }
        let first = number_of(self.values.len());
        self.models.push((model.clone(), first));
        let radii = model.radii().len();
        self.longest = self.longest.max(number_of(radii));
        let surface_albedos = model.surface_albedos().flat_map(|a| std::iter::repeat_n(a, radii));
        self.values.extend(model.knots().zip(surface_albedos).map(|(knot, surface_albedo)| {
            Value::Struct(vec![
                ("radius", Value::scalar(knot.radius)),
                ("cdf", Value::scalar(knot.cdf)),
                ("density", Value::scalar(knot.density)),
                ("mean_density", Value::scalar(knot.mean_density)),
                ("surface_albedo", Value::scalar(surface_albedo)),
            ])
        }));
        first
    }
}

/// A number of knots or terms: a model has at most `TabulatedModel::MAXIMUM_ENTRIES` knots, a file of 1 MiB fewer terms,
/// a set at most 2048 models.
fn number_of(entries: usize) -> u32 {
    u32::try_from(entries).expect("2048 models of 2^18 entries are fewer than 2^32")
}

/// How the shaders reach the knots: in a buffer, since a variable would be copied to every invocation.
const TABULATED_KNOTS: &str = "\
/// The knots of all tables: table by table, by surface albedo, by radius.
@group(0) @binding(1) var<storage, read> profile_tables: array<TabulatedKnot>;

/// Knot `index` of all tables.
fn tabulated_knot(index: u32) -> TabulatedKnot {
    return profile_tables[index];
}

";

/// How the shaders reach the terms of Gaussian sums: as texels behind the curves. An array in the module, constant or
/// not, is copied by drivers each time it is indexed.
const GAUSSIAN_TERMS: &str = "\
/// Term `index` of the Gaussian sums: weight (red, green, blue; their sum is 1 per channel and model), variance in mm².
fn gaussian_sum_term(index: u32) -> vec4f {
    return textureLoad(profile_curves, curve_place(i32(index / CURVE_STEPS), i32(index % CURVE_STEPS)), 0);
}

";

/// Terms of all Gaussian sums of a set; equal sums share theirs.
#[derive(Debug)]
struct GaussianTerms {
    sums: Vec<(GaussianSumModel, u32)>,
    /// Number of the first term: terms are counted like the texels of the curves before them.
    start: u32,
    /// Weights and variance of each term.
    texels: Vec<[f32; 4]>,
    /// Terms of the longest sum.
    longest: u32,
}

impl GaussianTerms {
    /// Terms that stand behind `curves`.
    fn after(curves: &Curves) -> Self {
        Self { sums: Vec::new(), start: curves.texels(), texels: Vec::new(), longest: 0 }
    }

    /// First term and number of terms of `model`.
    fn add(&mut self, model: &GaussianSumModel) -> (u32, u32) {
        let count = number_of(model.terms.len());
        if let Some((_, first)) = self.sums.iter().find(|(known, _)| known == model) {
            return (*first, count);
        }
        self.longest = self.longest.max(count);
        let first = self.start + number_of(self.texels.len());
        self.sums.push((model.clone(), first));
        let sums = [0, 1, 2].map(|channel| model.terms.iter().map(|term| term.weight[channel]).sum::<f64>());
        self.texels.extend(model.terms.iter().map(|term| {
            let [red, green, blue] = [0, 1, 2].map(|channel| single(term.weight[channel] / sums[channel]));
            [red, green, blue, single(term.variance_mm2)]
        }));
        (first, count)
    }
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
        let _ = writeln!(text, "const {}: u32 = {number}u;\n", model.constant());
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
        let (stem, structure) = (model.stem(), model.structure());
        let _ = writeln!(text, "    /// Coefficients, if `surface.model` is {}.", model.constant());
        let _ = writeln!(text, "    @align(16) {stem}: {structure},");
    }
    text.push_str("}\n\n");
}

/// A function whose body is chosen by model: a plain call where the set uses one model only. What `call` returns may have
/// lines, which are indented.
fn emit_switch(
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
                let _ = writeln!(text, "        case {}: {{", model.constant());
            }
            let returned = call(*model).replace('\n', "\n            ");
            let _ = writeln!(text, "            return {returned};\n        }}");
        }
        text.push_str("    }\n");
    }
    text.push_str("}\n\n");
}

fn emit_dispatch(text: &mut String, models: &[ModelKind]) {
    text.push_str("/// The profiles of the three channels of a material at a given surface albedo.\n");
    text.push_str(
        "fn material_profiles(row: SubsurfaceMaterial, surface_albedo: vec3f) -> ChannelProfiles {\n    \
         return ChannelProfiles(\n        material_profile(row, surface_albedo.r, row.surface.length_mm.r, 0u),\n        \
         material_profile(row, surface_albedo.g, row.surface.length_mm.g, 1u),\n        \
         material_profile(row, surface_albedo.b, row.surface.length_mm.b, 2u),\n    );\n}\n\n",
    );
    text.push_str("/// The profile of one channel (0 red, 1 green, 2 blue) of a material.\n");
    let head = "fn material_profile(\n    row: SubsurfaceMaterial,\n    surface_albedo: f32,\n    length_mm: f32,\n    \
                channel: u32,\n) -> Profile";
    emit_switch(text, head, "row.surface.model", models, |model| {
        let stem = model.stem();
        let (arguments, curve) = match model {
            ModelKind::GaussianSum => ("channel", "channel_curve(row.surface, channel)"),
            _ => ("surface_albedo, length_mm", "albedo_curve(row.surface, surface_albedo, length_mm)"),
        };
        let shape = if model.has_shape() { format!("row.{stem}.shape") } else { "vec4f()".to_owned() };
        let coefficients = format!("{stem}_profile(row.{stem}, {arguments})");
        format!("Profile(\n    {},\n    {coefficients},\n    {shape},\n    {curve},\n)", model.constant())
    });
    for (function, argument, docs) in [
        ("area_pdf", "radius_mm", "R(r) / A per unit area, mm⁻². May diverge at r = 0."),
        ("radial_pdf", "radius_mm", "2πr R(r) / A per unit radius, mm⁻¹."),
        ("radial_cdf", "radius_mm", "Fraction of the reflected energy that leaves within `radius_mm`."),
        ("sample_radius", "u", "Inverse of `profile_radial_cdf`: the radius, mm, for u in [0, 1)."),
    ] {
        let _ = writeln!(text, "/// {docs}");
        let head = format!("fn profile_{function}(profile: Profile, {argument}: f32) -> f32");
        emit_switch(text, &head, "profile.model", models, |model| {
            let shape = if model.has_shape() { "profile.shape, " } else { "" };
            format!("{}_{function}(profile.coefficients, {shape}{argument})", model.stem())
        });
    }
}
