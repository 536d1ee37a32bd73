//! What a material set adds to the shaders: the row of its parameter table, the dispatch over the models in use, and
//! the rows themselves.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use subsurface_profile::{GaussianSumModel, Model, TabulatedModel};

use crate::compose::Glue;
use crate::identifier::screaming_case;
use crate::material::{Material, MaterialSet, ResolvedProfile};
use crate::source::Span;
use crate::value::{Value, single};

/// The profile models, in the order of their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ModelKind {
    Burley,
    ExponentialDipole,
    GaussianSum,
    Polynomial,
    Tabulated,
    TwoExponentialDipole,
}

impl ModelKind {
    fn of(model: &Model) -> Option<Self> {
        match model {
            Model::Burley(_) => Some(Self::Burley),
            Model::ExponentialDipole(_) => Some(Self::ExponentialDipole),
            Model::GaussianSum(_) => Some(Self::GaussianSum),
            Model::Polynomial(_) => Some(Self::Polynomial),
            Model::Tabulated(_) => Some(Self::Tabulated),
            Model::TwoExponentialDipole(_) => Some(Self::TwoExponentialDipole),
            _ => None,
        }
    }

    /// Stem of the shader module, prefix of its functions and name of the row's field.
    pub(crate) fn stem(self) -> &'static str {
        match self {
            Self::Burley => "burley",
            Self::ExponentialDipole => "exponential_dipole",
            Self::GaussianSum => "gaussian_sum",
            Self::Polynomial => "polynomial",
            Self::Tabulated => "tabulated",
            Self::TwoExponentialDipole => "two_exponential_dipole",
        }
    }

    fn structure(self) -> &'static str {
        match self {
            Self::Burley => "BurleyModel",
            Self::ExponentialDipole => "ExponentialDipoleModel",
            Self::GaussianSum => "GaussianSumModel",
            Self::Polynomial => "PolynomialModel",
            Self::Tabulated => "TabulatedModel",
            Self::TwoExponentialDipole => "TwoExponentialDipoleModel",
        }
    }

    /// Whether the model's functions take the `shape` of its row besides the coefficients.
    fn has_shape(self) -> bool {
        self == Self::TwoExponentialDipole
    }

    fn constant(self) -> String {
        format!("MODEL_{}", self.stem().to_ascii_uppercase())
    }
}

/// The glue text of a set and the values of its table.
#[derive(Debug)]
pub(crate) struct Emitted {
    pub(crate) glue: Glue,
    /// One value per material: fields as in the emitted `SubsurfaceMaterial`.
    pub(crate) rows: Vec<Value>,
    /// The knots of all tables, as in `TabulatedKnot` of the shaders; empty where the set uses none.
    pub(crate) knots: Vec<Value>,
    /// Models in use, by number.
    pub(crate) models: Vec<ModelKind>,
}

/// A model that this compiler knows no shader for.
#[derive(Clone, Debug)]
pub(crate) struct UnknownModel {
    pub(crate) span: Span,
}

/// Writes the glue of `set`.
pub(crate) fn emit(set: &MaterialSet) -> Result<Emitted, UnknownModel> {
    let mut kinds = Vec::with_capacity(set.materials.len());
    for material in &set.materials {
        let unknown = || UnknownModel { span: material.profile.span.clone() };
        kinds.push(ModelKind::of(&material.profile.model).ok_or_else(unknown)?);
    }
    let models: Vec<ModelKind> = kinds.iter().copied().collect::<BTreeSet<_>>().into_iter().collect();

    let mut shared = Shared::default();
    let rows = set
        .materials
        .iter()
        .zip(&kinds)
        .map(|(material, &kind)| row(material, kind, &models, &mut shared))
        .collect();

    let mut glue = Glue::default();
    emit_constants(&mut glue.text, set, &models);
    emit_row(&mut glue.text, &models);
    emit_dispatch(&mut glue.text, &models);
    if models.contains(&ModelKind::GaussianSum) {
        emit_gaussian_terms(&mut glue, &shared.terms);
    }
    if models.contains(&ModelKind::Tabulated) {
        glue.text.push_str(TABULATED_KNOTS);
    }
    Ok(Emitted { glue, rows, knots: shared.knots.values, models })
}

/// Number of `kind` among the models in use.
fn number(models: &[ModelKind], kind: ModelKind) -> u32 {
    let position = models.iter().position(|&model| model == kind);
    position.and_then(|p| u32::try_from(p).ok()).expect("a row's model is among the models in use")
}

fn row(material: &Material, kind: ModelKind, models: &[ModelKind], shared: &mut Shared) -> Value {
    let surface = Value::Struct(vec![
        ("length_mm", Value::vector(material.length_mm)),
        ("model", Value::U32(number(models, kind))),
        ("surface_albedo", Value::vector(material.surface_albedo)),
        ("reflectance_at_normal", Value::scalar(material.reflectance_at_normal)),
        ("roughness", Value::scalar(material.roughness)),
        ("transmission_strength", Value::scalar(material.transmission_strength)),
    ]);
    let mut fields = vec![("surface", surface), (kind.stem(), coefficients(material, shared))];
    // Models are told apart by number; the coefficients of the others stay zero.
    fields.sort_by_key(|(name, _)| *name != "surface");
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
            let (first, count) = shared.terms.add(model, &material.profile);
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
#[derive(Debug, Default)]
struct Shared {
    terms: GaussianTerms,
    knots: TabulatedKnots,
}

/// Knots of all tables of a set; equal models share theirs.
#[derive(Debug, Default)]
struct TabulatedKnots {
    models: Vec<(TabulatedModel, u32)>,
    values: Vec<Value>,
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

/// A number of knots; a model has at most `TabulatedModel::MAXIMUM_ENTRIES` of them, a set at most 2048 models.
fn number_of(knots: usize) -> u32 {
    u32::try_from(knots).expect("2048 models of 2^18 knots are fewer than 2^32")
}

/// How the shaders reach the knots: in a buffer, since a variable would be copied to every invocation. By this
/// declaration the runtime's `SubsurfaceKernel::new` sees that a kernel needs tables.
const TABULATED_KNOTS: &str = "\
/// The knots of all tables: table by table, by surface albedo, by radius.
@group(0) @binding(1) var<storage, read> profile_tables: array<TabulatedKnot>;

/// Knot `index` of all tables.
fn tabulated_knot(index: u32) -> TabulatedKnot {
    return profile_tables[index];
}
";

/// Terms of all Gaussian sums of a set; equal sums share theirs.
#[derive(Debug, Default)]
struct GaussianTerms {
    sums: Vec<(GaussianSumModel, u32, ResolvedProfile)>,
    count: u32,
}

impl GaussianTerms {
    /// First term and number of terms of `model`.
    fn add(&mut self, model: &GaussianSumModel, profile: &ResolvedProfile) -> (u32, u32) {
        let count =
            u32::try_from(model.terms.len()).expect("a file of at most 1 MiB lists fewer than 2^32 terms");
        if let Some((_, first, _)) = self.sums.iter().find(|(known, ..)| known == model) {
            return (*first, count);
        }
        let first = self.count;
        self.sums.push((model.clone(), first, profile.clone()));
        self.count += count;
        (first, count)
    }
}

fn emit_constants(text: &mut String, set: &MaterialSet, models: &[ModelKind]) {
    let material_count = set.materials.len();
    let _ = writeln!(text, "/// Materials in the set.\nconst MATERIALS_IN_SET: u32 = {material_count}u;\n");
    // Nothing of ours names a material, but a pass of the caller's own may; unused ones are dropped.
    for (number, material) in set.materials.iter().enumerate() {
        let name = screaming_case(&material.name);
        let _ = writeln!(
            text,
            "/// Number of the material `{}`.\nconst MATERIAL_{name}: u32 = {number}u;\n",
            material.name
        );
    }
    for (number, model) in models.iter().enumerate() {
        let _ = writeln!(text, "const {}: u32 = {number}u;\n", model.constant());
    }
}

fn emit_row(text: &mut String, models: &[ModelKind]) {
    text.push_str("/// One row of the parameter table: a material.\nstruct SubsurfaceMaterial {\n");
    text.push_str("    /// What every material has.\n    surface: MaterialSurface,\n");
    for model in models {
        let (stem, structure) = (model.stem(), model.structure());
        let _ = writeln!(text, "    /// Coefficients, if `surface.model` is {}.", model.constant());
        let _ = writeln!(text, "    {stem}: {structure},");
    }
    text.push_str("}\n\n");
}

/// A function whose body is chosen by model: a plain call where the set uses one model only.
fn emit_switch(
    text: &mut String,
    head: &str,
    selector: &str,
    models: &[ModelKind],
    call: impl Fn(ModelKind) -> String,
) {
    let _ = writeln!(text, "{head} {{");
    if let [only] = models {
        let _ = writeln!(text, "    return {};", call(*only));
    } else {
        let _ = writeln!(text, "    switch {selector} {{");
        for (index, model) in models.iter().enumerate() {
            if index + 1 == models.len() {
                text.push_str("        default: {\n");
            } else {
                let _ = writeln!(text, "        case {}: {{", model.constant());
            }
            let _ = writeln!(text, "            return {};\n        }}", call(*model));
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
    let head = "fn material_profile(row: SubsurfaceMaterial, surface_albedo: f32, length_mm: f32, channel: u32) -> Profile";
    emit_switch(text, head, "row.surface.model", models, |model| {
        let stem = model.stem();
        let arguments = match model {
            ModelKind::GaussianSum => "channel",
            _ => "surface_albedo, length_mm",
        };
        let shape = if model.has_shape() { format!("row.{stem}.shape") } else { "vec4f()".to_owned() };
        format!("Profile({}, {stem}_profile(row.{stem}, {arguments}), {shape})", model.constant())
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

fn emit_gaussian_terms(glue: &mut Glue, terms: &GaussianTerms) {
    let text = &mut glue.text;
    text.push_str("/// Term `index` of the Gaussian sums: weight (red, green, blue) and variance, mm².\n");
    text.push_str(
        "fn gaussian_sum_term(index: u32) -> vec4f {\n    return GAUSSIAN_SUM_TERMS[index];\n}\n\n",
    );
    text.push_str(
        "/// Weights (red, green, blue; their sum is 1 per channel and model) and variance, mm².\n\
         /// A variable, though nothing writes it: drivers copy a constant array each time it is indexed.\n",
    );
    let _ = writeln!(
        text,
        "var<private> GAUSSIAN_SUM_TERMS: array<vec4f, {0}> = array<vec4f, {0}>(",
        terms.count
    );
    for (model, _, profile) in &terms.sums {
        let sum = |channel: usize| model.terms.iter().map(|term| term.weight[channel]).sum::<f64>();
        let sums = [sum(0), sum(1), sum(2)];
        for (index, term) in model.terms.iter().enumerate() {
            let [red, green, blue] = [0, 1, 2].map(|channel| single(term.weight[channel] / sums[channel]));
            let start = text.len() + 4;
            let _ =
                writeln!(text, "    vec4f({red:?}, {green:?}, {blue:?}, {:?}),", single(term.variance_mm2));
            let spelled = profile.coefficient_spans.get(&format!("terms[{index}].variance_mm2"));
            let origin = spelled.unwrap_or(&profile.span).clone();
            glue.origins.push((start..text.len() - 2, origin));
        }
    }
    text.push_str(");\n");
}
