//! The rows of the parameter table as far as profile models fill them: coefficients, and what several rows may point
//! into.

use std::collections::BTreeMap;

use subsurface_profile::description::{Contents, Notation, SHAPE, Values};
use subsurface_profile::{GaussianTerm, MixtureModel, Model, ModelKind, TabulatedModel};

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

/// Whether the model is made of parts, which are evaluated in its place.
pub(crate) fn is_mixture(kind: ModelKind) -> bool {
    kind.description().notation == Notation::Parts
}

/// The models of a set. Each has a number: its position by name among all.
#[derive(Debug, Default)]
pub(crate) struct ModelsInUse {
    /// Models of materials, by name.
    pub(crate) of_materials: Vec<ModelKind>,
    /// Models of parts of mixtures, by name.
    pub(crate) of_parts: Vec<ModelKind>,
    /// Both, by name.
    pub(crate) all: Vec<ModelKind>,
    /// Parts of the mixture that has most of them; 0 without mixtures.
    pub(crate) most_parts: usize,
}

impl ModelsInUse {
    pub(crate) fn of<'m>(models: impl Iterator<Item = &'m Model>) -> Self {
        let by_name = |kinds: &BTreeMap<&'static str, ModelKind>| kinds.values().copied().collect();
        let (mut of_materials, mut of_parts, mut most_parts) = (BTreeMap::new(), BTreeMap::new(), 0);
        for model in models {
            of_materials.insert(model.description().stem, model.kind());
            if let Contents::Parts(mixture) = model.contents() {
                let parts = parts(mixture);
                most_parts = most_parts.max(parts.len());
                of_parts.extend(parts.iter().map(|(_, part)| (part.description().stem, part.kind())));
            }
        }
        let mut all = of_materials.clone();
        all.extend(of_parts.clone());
        Self {
            of_materials: by_name(&of_materials),
            of_parts: by_name(&of_parts),
            all: by_name(&all),
            most_parts,
        }
    }

    /// Number of a model in use.
    fn number(&self, kind: ModelKind) -> u32 {
        let position = self.all.iter().position(|&model| model == kind);
        position.map(number_of).expect("a row's model is among the models in use")
    }

    /// The members of a row or a part that are a model's coefficients: they are told apart by number, so there is room
    /// for each of `kinds`, and nothing to say of the others.
    fn members(&self, kinds: &[ModelKind], model: &Model, shared: &mut Shared) -> Vec<(&'static str, Value)> {
        let own = coefficients(model, self, shared);
        let value = |kind| if kind == model.kind() { own.clone() } else { Value::Zero };
        kinds.iter().map(|&kind| (kind.description().stem, value(kind))).collect()
    }

    /// The number of a material's model, and the members of its row.
    pub(crate) fn row(&self, model: &Model, shared: &mut Shared) -> (u32, Vec<(&'static str, Value)>) {
        (self.number(model.kind()), self.members(&self.of_materials, model, shared))
    }
}

/// The parts of a mixture that have a share, with their models, which are no mixtures themselves.
fn parts(mixture: &MixtureModel) -> Vec<(f64, &Model)> {
    mixture.leaves().into_iter().filter(|(weight, _)| *weight > 0.0).collect()
}

/// Members of the struct of a mixture.
pub(crate) const PARTS: [&str; MixtureModel::MAXIMUM_PARTS] =
    ["part_0", "part_1", "part_2", "part_3", "part_4", "part_5", "part_6", "part_7"];

/// The values of a model's struct, by member.
fn coefficients(model: &Model, models: &ModelsInUse, shared: &mut Shared) -> Value {
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
        Contents::Parts(mixture) => {
            let parts = parts(mixture);
            // A shorter mixture ends in copies of its last part, which have no share.
            let part = |index: usize| {
                let (weight, part) = parts.get(index).map_or((0.0, parts[parts.len() - 1].1), |part| *part);
                let mut members = vec![
                    ("weight", Value::scalar(weight)),
                    ("model", Value::U32(models.number(part.kind()))),
                ];
                members.extend(models.members(&models.of_parts, part, shared));
                Value::Struct(members)
            };
            let values: Vec<Value> = (0..models.most_parts).map(part).collect();
            Value::Struct(PARTS.into_iter().zip(values).collect())
        }
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
