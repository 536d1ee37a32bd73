//! The rows of the parameter table as far as profile models fill them: coefficients, and what several rows may point
//! into.

use subsurface_profile::description::{Contents, SHAPE, Values};
use subsurface_profile::{GaussianTerm, Model, ModelKind, TabulatedModel};

use crate::curves::Curves;
use crate::unrolled::{gaussian_sums, table_search};
use crate::value::{Value, single};

/// Name of the struct of a model's coefficients.
pub(crate) fn structure(kind: ModelKind) -> String {
    format!("{}Model", kind.description().name)
}

/// Name of the constant that holds a model's number.
pub(crate) fn constant(kind: ModelKind) -> String {
    format!("MODEL_{}", kind.description().stem.to_ascii_uppercase())
}

/// Whether the model's functions take the `shape` of its row besides the coefficients.
pub(crate) fn has_shape(kind: ModelKind) -> bool {
    kind.fields().iter().any(|field| field.member == SHAPE)
}

/// The values of a model's struct, by member.
pub(crate) fn coefficients(model: &Model, shared: &mut Shared) -> Value {
    match model.contents() {
        Contents::Coefficients => Value::Struct(members(model)),
        Contents::Terms(terms) => {
            let (first, count) = shared.terms.add(terms);
            Value::Struct(vec![("first_term", Value::U32(first)), ("term_count", Value::U32(count))])
        }
        Contents::Table(table) => Value::Struct(vec![
            ("first_knot", Value::U32(shared.knots.add(table))),
            ("knot_count", Value::U32(number_of(table.radii().len()))),
            ("table_count", Value::U32(number_of(table.surface_albedos().len()))),
        ]),
    }
}

/// The numbers of all fields; those that share a member are its components.
fn members(model: &Model) -> Vec<(&'static str, Value)> {
    let mut members: Vec<(&'static str, Vec<f32>, bool)> = Vec::new();
    model.clone().visit(&mut |slot| {
        let numbers = slot.values.iter().map(|value| single(*value));
        match members.last_mut() {
            Some((name, components, is_number)) if *name == slot.field.member => {
                components.extend(numbers);
                *is_number = false;
            }
            _ => members.push((slot.field.member, numbers.collect(), slot.field.values == Values::One)),
        }
    });
    let value = |numbers: Vec<f32>, is_number| match numbers[..] {
        [number] if is_number => Value::F32(number),
        _ => Value::Vector(numbers),
    };
    members.into_iter().map(|(name, numbers, is_number)| (name, value(numbers, is_number))).collect()
}

/// What several rows may point into.
#[derive(Debug)]
pub(crate) struct Shared {
    pub(crate) terms: GaussianTerms,
    pub(crate) knots: TabulatedKnots,
}

impl Shared {
    /// Terms stand behind `curves`.
    pub(crate) fn after(curves: &Curves) -> Self {
        Self { terms: GaussianTerms::after(curves), knots: TabulatedKnots::default() }
    }

    /// How the shaders of a set reach what its rows point into, and what adds it up or searches it.
    pub(crate) fn emit(&self, text: &mut String) {
        if self.terms.longest > 0 {
            text.push_str(GAUSSIAN_TERMS);
            text.push_str(&gaussian_sums(self.terms.longest));
        }
        if self.knots.longest > 0 {
            text.push_str(TABULATED_KNOTS);
            text.push_str(&table_search(self.knots.longest));
        }
    }
}

/// Knots of all tables of a set; equal models share theirs.
#[derive(Debug, Default)]
pub(crate) struct TabulatedKnots {
    models: Vec<(TabulatedModel, u32)>,
    pub(crate) values: Vec<Value>,
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
pub(crate) struct GaussianTerms {
    sums: Vec<(Vec<GaussianTerm>, u32)>,
    /// Number of the first term: terms are counted like the texels of the curves before them.
    start: u32,
    /// Weights and variance of each term.
    pub(crate) texels: Vec<[f32; 4]>,
    /// Terms of the longest sum.
    longest: u32,
}

impl GaussianTerms {
    /// Terms that stand behind `curves`.
    fn after(curves: &Curves) -> Self {
        Self { sums: Vec::new(), start: curves.texels(), texels: Vec::new(), longest: 0 }
    }

    /// First term and number of terms of a sum.
    fn add(&mut self, terms: &[GaussianTerm]) -> (u32, u32) {
        let count = number_of(terms.len());
        if let Some((_, first)) = self.sums.iter().find(|(known, _)| known == terms) {
            return (*first, count);
        }
        self.longest = self.longest.max(count);
        let first = self.start + number_of(self.texels.len());
        self.sums.push((terms.to_vec(), first));
        let sums = [0, 1, 2].map(|channel| terms.iter().map(|term| term.weight[channel]).sum::<f64>());
        self.texels.extend(terms.iter().map(|term| {
            let [red, green, blue] = [0, 1, 2].map(|channel| single(term.weight[channel] / sums[channel]));
            [red, green, blue, single(term.variance_mm2)]
        }));
        (first, count)
    }
}
