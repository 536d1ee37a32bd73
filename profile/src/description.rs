//! What a profile model says of itself: one description that files, fits, messages, tables and kernels are driven by.
//!
//! A model implements [`ProfileModel`] in its own file, and stands in the list of `model.rs`. Nothing else in this
//! crate, in the compiler or on the command line asks for a model by its name.

use crate::single_scattering_albedo::Entry;
use crate::{Channel, Length, Medium, Model, ModelError, Quantity, RadialData, RadialProfile};

/// What is the same for every member of a model.
#[derive(Clone, Copy, Debug)]
pub struct Description {
    /// The word that begins the model in a profile file: `Burley`.
    pub name: &'static str,
    /// Stem of the model's files in Rust and WGSL, prefix of its WGSL functions, name of its family: `burley`.
    pub stem: &'static str,
    /// What tables and captions call it: `two exponentials + dipole`.
    pub caption: &'static str,
    /// The equation, as text.
    pub equation: &'static str,
    /// What else to know before writing coefficients; may be empty.
    pub notes: &'static str,
    /// Author and year, or where else the form comes from.
    pub source: &'static str,
    /// How a file writes it.
    pub notation: Notation,
    /// The shortest way to write it.
    pub example: &'static str,
    /// The lengths that a member may be parametrized by: a file says which, where there are several. Empty for a model
    /// that carries its own lengths, or those of its parts.
    pub lengths: &'static [Length],
    /// The variable that lists of coefficients are powers of.
    pub variable: Variable,
}

/// How the coefficients of a model are written in a profile file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// Named fields, or the word of a published set in the field `key`.
    Fields {
        /// Name of the field that takes a word; empty where no set has one.
        key: &'static str,
        /// The word before the brackets of coefficients of one's own, `key: Own(…)`; empty where these stand in place
        /// of `key`.
        own: &'static str,
    },
    /// A list of terms, each with the same named fields.
    Terms {
        /// What a term is called: `Gaussian`.
        term: &'static str,
        /// One term, written out.
        example: &'static str,
    },
    /// The path of a table in the field `file`.
    Table,
    /// A list of parts, each with the named fields and a `model`.
    Parts,
}

/// A function of the surface albedo A that lists of coefficients are powers of.
#[derive(Clone, Copy, Debug)]
pub struct Variable {
    /// `A`, or another letter.
    pub symbol: &'static str,
    /// How it follows from A: `x = 6A/(1 + 5A)`; empty for A itself.
    pub definition: &'static str,
    /// Its value.
    pub at: fn(f64) -> f64,
}

impl Variable {
    /// A itself.
    pub const SURFACE_ALBEDO: Variable =
        Variable { symbol: "A", definition: "", at: |surface_albedo| surface_albedo };
}

/// How many numbers a field holds, and what tells them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Values {
    /// One number.
    One,
    /// Coefficients of 1, x, x² and so on: as many numbers.
    Powers(usize),
    /// One number for each channel: red, green, blue. A file may give one for all.
    Channels,
}

impl Values {
    /// How many numbers there are.
    pub const fn count(self) -> usize {
        match self {
            Values::One => 1,
            Values::Powers(count) => count,
            Values::Channels => 3,
        }
    }
}

/// Member of a WGSL struct for constants that are no functions of the surface albedo: the model's functions take it
/// besides what the coefficients make at a surface albedo.
pub const SHAPE: &str = "shape";

/// A field of a model: one coefficient, or a list of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Path from the model, such as `dipole_depth` or `a.linear`, where `a` is the group that it belongs to.
    pub path: &'static str,
    /// Its symbol in the equation.
    pub symbol: &'static str,
    /// What it is, for a table.
    pub about: &'static str,
    /// What each of its numbers means.
    pub quantity: Quantity,
    /// How many numbers it holds.
    pub values: Values,
    /// How many other terms of the same function of the surface albedo come before it: data of so many surface albedos
    /// and one more tell it apart in a fit. `None` for what a fit leaves as it is.
    pub order: Option<usize>,
    /// Member of the model's WGSL struct; numbers that name the same one are its components, in order.
    pub member: &'static str,
}

impl Field {
    /// The name in a file: the last part of the path.
    pub fn name(&self) -> &'static str {
        self.path.rsplit('.').next().unwrap_or(self.path)
    }

    /// The group that the field belongs to, if any: the path without the name.
    pub fn group(&self) -> Option<&'static str> {
        self.path.rsplit_once('.').map(|(group, _)| group)
    }
}

/// A field, and where it stands in the model `M`.
#[derive(Clone, Copy, Debug)]
pub struct Coefficient<M> {
    /// What it is.
    pub field: Field,
    /// Where it stands: as many numbers as [`Field::values`] says.
    pub place: fn(&mut M) -> &mut [f64],
}

impl<M> Coefficient<M> {
    /// A number that may take any value, is free in every fit, and has a member of its own name.
    pub(crate) const fn new(
        path: &'static str,
        symbol: &'static str,
        about: &'static str,
        place: fn(&mut M) -> &mut [f64],
    ) -> Self {
        let field = Field {
            path,
            symbol,
            about,
            quantity: Quantity::COEFFICIENT,
            values: Values::One,
            order: Some(0),
            member: path,
        };
        Coefficient { field, place }
    }

    pub(crate) const fn values(self, values: Values) -> Self {
        Coefficient { field: Field { values, ..self.field }, ..self }
    }

    pub(crate) const fn quantity(self, quantity: Quantity) -> Self {
        Coefficient { field: Field { quantity, ..self.field }, ..self }
    }

    pub(crate) const fn order(self, order: usize) -> Self {
        Coefficient { field: Field { order: Some(order), ..self.field }, ..self }
    }

    /// A fit leaves it as it is.
    pub(crate) const fn never_fitted(self) -> Self {
        Coefficient { field: Field { order: None, ..self.field }, ..self }
    }

    pub(crate) const fn member(self, member: &'static str) -> Self {
        Coefficient { field: Field { member, ..self.field }, ..self }
    }
}

/// A function of the surface albedo that the coefficients make: what `subsurface profile coefficients` draws.
#[derive(Clone, Copy, Debug)]
pub struct Function<M> {
    /// Its symbol, such as `w`.
    pub symbol: &'static str,
    /// Symbol and unit, for an axis.
    pub label: &'static str,
    /// Its value at a surface albedo.
    pub at: fn(&M, f64) -> f64,
    /// The power of the length that the function grows with, if lengths are counted in another unit.
    pub length_power: i32,
    /// Whether a factor of it is free, since the profile is divided by its own integral.
    pub is_scaled_by_energy: bool,
}

impl<M> Function<M> {
    /// A function that no unit and no factor changes.
    pub(crate) const fn new(symbol: &'static str, label: &'static str, at: fn(&M, f64) -> f64) -> Self {
        Function { symbol, label, at, length_power: 0, is_scaled_by_energy: false }
    }

    pub(crate) const fn length_power(self, length_power: i32) -> Self {
        Function { length_power, ..self }
    }

    pub(crate) const fn scaled_by_energy(self) -> Self {
        Function { is_scaled_by_energy: true, ..self }
    }
}

/// The horizontal axis that a model's functions are drawn over.
#[derive(Clone, Copy, Debug)]
pub struct Argument {
    /// Name and symbol.
    pub label: &'static str,
    /// Its value at a surface albedo.
    pub at: fn(f64) -> f64,
}

impl Argument {
    /// The surface albedo itself.
    pub const SURFACE_ALBEDO: Argument =
        Argument { label: "surface albedo A", at: |surface_albedo| surface_albedo };
}

/// A published set of coefficients of the model `M`.
#[derive(Clone, Copy, Debug)]
pub struct Published<M> {
    /// Stem of its profile file.
    pub stem: &'static str,
    /// The word that stands for it in a file; empty for none.
    pub word: &'static str,
    /// Where the coefficients come from, for a table.
    pub source: &'static str,
    /// The set.
    pub model: fn() -> M,
    /// Surface albedos of the stored truth that the set was fitted to; empty where that is not known.
    pub fitted_surface_albedos: &'static [f64],
    /// How light enters the medium, index-matched, that the set is a profile of; `None` where that is another medium.
    pub entry: Option<Entry>,
}

impl<M> Published<M> {
    pub(crate) const fn new(
        stem: &'static str,
        word: &'static str,
        source: &'static str,
        model: fn() -> M,
    ) -> Self {
        Published { stem, word, source, model, fitted_surface_albedos: &[], entry: None }
    }

    pub(crate) const fn entering(self, entry: Entry) -> Self {
        Published { entry: Some(entry), ..self }
    }

    pub(crate) const fn fitted_to(self, fitted_surface_albedos: &'static [f64]) -> Self {
        Published { fitted_surface_albedos, ..self }
    }
}

/// What the shape of a profile depends on besides its coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dependence {
    /// On the surface albedo; the medium's length scales it, and channels differ by these two alone.
    Medium,
    /// On the channel: its lengths are absolute, in mm, and neither the surface albedo nor the medium's length plays a
    /// part.
    Channel,
    /// On all of these: a mixture of both kinds.
    MediumAndChannel,
}

impl Dependence {
    /// Whether the medium's length scales at least a part of the profile.
    pub fn on_length(self) -> bool {
        self != Dependence::Channel
    }

    /// Whether channels of one surface albedo and length may differ.
    pub fn on_channel(self) -> bool {
        self != Dependence::Medium
    }
}

/// One field of a member, with its numbers.
#[derive(Debug)]
pub struct Slot<'a> {
    /// What comes before the path of the field: `terms[2].`, or nothing.
    pub prefix: &'a str,
    /// What it is.
    pub field: &'static Field,
    /// Its numbers.
    pub values: &'a mut [f64],
}

impl Slot<'_> {
    /// Path of the field from the model, with the position in a list of terms: `terms[2].variance_mm2`.
    pub fn path(&self) -> String {
        format!("{}{}", self.prefix, self.field.path)
    }

    /// Path of one of its numbers: `dipole_depth[0]`.
    pub fn path_of(&self, index: usize) -> String {
        match self.field.values {
            Values::One => self.path(),
            Values::Powers(_) | Values::Channels => format!("{}[{index}]", self.path()),
        }
    }
}

/// A profile model: its description, its coefficients and its functions.
///
/// The methods with a body are what most models need. A new model overrides those in which it differs.
pub trait ProfileModel: Clone + PartialEq + std::fmt::Debug + Into<Model> + Sized + 'static {
    /// What is the same for every member.
    const DESCRIPTION: Description;

    /// The fields of a model that has a fixed number of them, in the order in which a file writes them.
    const COEFFICIENTS: &'static [Coefficient<Self>] = &[];

    /// The published sets, the one that fits start from first.
    const PUBLISHED: &'static [Published<Self>];

    /// The functions of the surface albedo that the coefficients make.
    const FUNCTIONS: &'static [Function<Self>] = &[];

    /// What these functions are drawn over.
    const ARGUMENT: Argument = Argument::SURFACE_ALBEDO;

    /// The fields in the order in which a file writes them; those of a term for a model of terms.
    fn fields() -> Vec<&'static Field> {
        Self::COEFFICIENTS.iter().map(|coefficient| &coefficient.field).collect()
    }

    /// A member to write coefficients to, of so many terms for a model of terms; `None` for a model that is not made
    /// of coefficients alone.
    fn blank(_terms: usize) -> Option<Self> {
        Self::PUBLISHED.first().map(|set| (set.model)())
    }

    /// Calls `visitor` with every field, in the order of [`fields`](Self::fields), term by term.
    fn visit(&mut self, visitor: &mut dyn FnMut(Slot<'_>)) {
        visit_all(Self::COEFFICIENTS, self, "", visitor);
    }

    /// The profile of one channel of a medium. The coefficients have passed the bounds of their fields.
    fn boxed_profile(&self, medium: Medium, channel: Channel) -> Result<Box<dyn RadialProfile>, ModelError>;

    /// Adds what is wrong with the coefficients together, whatever the medium, where each is within its bounds.
    fn collect_errors(&self, _errors: &mut Vec<ModelError>) {}

    /// All that is wrong with the coefficients alone, whatever the medium.
    fn errors(&self) -> Vec<ModelError> {
        let mut errors = Vec::new();
        self.clone().visit(&mut |slot| {
            let field = slot.field;
            for (index, &value) in slot.values.iter().enumerate() {
                if !value.is_finite() {
                    errors.push(ModelError::NotFinite { coefficient: slot.path_of(index) });
                } else if !field.quantity.bounds.contain(value) {
                    let (coefficient, quantity) = (slot.path_of(index), &field.quantity);
                    errors.push(ModelError::OutOfBounds { coefficient, value, quantity });
                }
            }
        });
        self.collect_errors(&mut errors);
        errors
    }

    /// The first of [`errors`](Self::errors).
    fn validate(&self) -> Result<(), ModelError> {
        self.errors().into_iter().next().map_or(Ok(()), Err)
    }

    /// The length that the member is parametrized by.
    fn length(&self) -> Length {
        Self::DESCRIPTION.lengths.first().copied().unwrap_or(Length::MeanFreePath)
    }

    /// Chooses one of the lengths of the description.
    fn set_length(&mut self, _length: Length) {}

    /// What the shape depends on.
    fn dependence(&self) -> Dependence {
        if Self::DESCRIPTION.lengths.is_empty() { Dependence::Channel } else { Dependence::Medium }
    }

    /// The integral of the equation before the profile is divided by it, over the surface albedo; `None` for a model
    /// whose equation integrates to the surface albedo.
    fn energy(&self, _surface_albedo: f64) -> Option<Result<f64, ModelError>> {
        None
    }

    /// Takes the dependence on the surface albedo out: what the member is at A, it becomes everywhere.
    fn make_constant(&mut self, surface_albedo: f64) {
        let x = (Self::DESCRIPTION.variable.at)(surface_albedo);
        self.visit(&mut |slot| {
            if let Values::Powers(_) = slot.field.values {
                let value = slot.values.iter().rev().fold(0.0, |sum, term| sum * x + term);
                slot.values.fill(0.0);
                slot.values[0] = value;
            }
        });
    }

    /// Where a fit to `data` starts; `None` for a model that has nothing to fit. `terms` is how many terms a model of
    /// terms gets.
    fn start(_data: &[RadialData], _terms: usize) -> Option<Self> {
        Self::PUBLISHED.first().map(|set| (set.model)())
    }

    /// Divides what only ratios matter of by its sum, as papers print it.
    fn normalise(&mut self) {}

    /// What the member is made of, for those who cannot see it through its fields.
    fn contents(&self) -> Contents<'_> {
        Contents::Coefficients
    }
}

/// What a member of a model is made of.
#[derive(Clone, Copy, Debug)]
pub enum Contents<'a> {
    /// A fixed number of coefficients: [`Model::visit`].
    Coefficients,
    /// Gaussians.
    Terms(&'a [crate::GaussianTerm]),
    /// A table.
    Table(&'a crate::TabulatedModel),
    /// Other models.
    Parts(&'a crate::MixtureModel),
}

/// Calls `visitor` with the fields of a model that has a fixed number of them.
pub(crate) fn visit_all<M>(
    coefficients: &'static [Coefficient<M>],
    model: &mut M,
    prefix: &str,
    visitor: &mut dyn FnMut(Slot<'_>),
) {
    for Coefficient { field, place } in coefficients {
        visitor(Slot { prefix, field, values: place(model) });
    }
}
