//! The families of models that can be fitted, and where their fits start.

use crate::description::Notation;
use crate::{Model, ModelKind, RadialData};

/// A family of models, with its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Family {
    kind: ModelKind,
    terms: usize,
}

impl Family {
    /// Terms that a model of terms gets where nobody says how many.
    pub const TERMS: usize = 4;

    /// All families.
    pub fn all() -> impl Iterator<Item = Family> {
        ModelKind::ALL.iter().filter_map(|kind| Family::of(*kind))
    }

    /// The family of a model; `None` for a model that has nothing to fit.
    pub fn of(kind: ModelKind) -> Option<Family> {
        kind.start(&[], Self::TERMS).map(|_| Family { kind, terms: Self::TERMS })
    }

    /// A family by its name, that of the model: `gaussian_sum`.
    pub fn from_name(name: &str) -> Option<Family> {
        ModelKind::of_stem(name).and_then(Self::of)
    }

    /// The same with another number of terms, at least 1; `None` for a model that is not one of terms.
    pub fn with_terms(self, terms: usize) -> Option<Family> {
        self.has_terms().then_some(Family { terms: terms.max(1), ..self })
    }

    /// Which model it is.
    pub fn kind(self) -> ModelKind {
        self.kind
    }

    /// Its name: that of the model.
    pub fn name(self) -> &'static str {
        let description = self.kind.description();
        description.stem
    }

    /// What a legend calls it.
    pub fn label(self) -> String {
        match (self.kind.description().notation, self.terms) {
            (Notation::Terms { term, .. }, 1) => format!("a {term}"),
            (Notation::Terms { term, .. }, terms) => format!("{terms} {term}s"),
            _ => self.name().replace('_', " "),
        }
    }

    /// Whether members have a number of terms that one may choose.
    pub fn has_terms(self) -> bool {
        matches!(self.kind.description().notation, Notation::Terms { .. })
    }

    /// Where a fit of this family to `data` starts.
    pub fn start(self, data: &[RadialData]) -> Model {
        self.kind.start(data, self.terms).unwrap_or_else(|| unreachable!("{self:?} has a start"))
    }
}
