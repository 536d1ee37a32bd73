//! The list of the profile models, and what all of them answer.

use crate::description::{Argument, Contents, Dependence, Description, Field, ProfileModel, Slot};
use crate::single_scattering_albedo::Entry;
use crate::{
    BurleyModel, Channel, DipoleModel, ExponentialDipoleModel, GaussianSumModel, Length, Medium,
    MixtureModel, ModelError, PolynomialModel, RadialData, RadialProfile, TabulatedModel,
    TwoExponentialDipoleModel,
};

/// Makes the enums of all models from their list. (The dollar is handed in for the macros within.)
macro_rules! models {
    ($dollar:tt $($(#[$doc:meta])+ $variant:ident($model:ident)),+ $(,)?) => {
        /// A family of radial profiles, given by its coefficients.
        #[derive(Clone, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum Model {
            $($(#[$doc])+ $variant($model)),+
        }

        /// Which model it is, without coefficients.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum ModelKind {
            $($(#[$doc])+ $variant),+
        }

        $(impl From<$model> for Model {
            fn from(model: $model) -> Model {
                Model::$variant(model)
            }
        })+

        impl ModelKind {
            /// All models.
            pub const ALL: &'static [ModelKind] = &[$(ModelKind::$variant),+];
        }

        impl Model {
            /// The stems that [`published`](Self::published) knows.
            pub const PUBLISHED: [&'static str; 0 $(+ <$model as ProfileModel>::PUBLISHED.len())+] = {
                let mut stems = [""; 0 $(+ <$model as ProfileModel>::PUBLISHED.len())+];
                let mut count = 0;
                $(
                    let mut index = 0;
                    while index < <$model as ProfileModel>::PUBLISHED.len() {
                        stems[count] = <$model as ProfileModel>::PUBLISHED[index].stem;
                        (index, count) = (index + 1, count + 1);
                    }
                )+
                stems
            };

            /// Which model it is.
            pub fn kind(&self) -> ModelKind {
                match self {
                    $(Model::$variant(_) => ModelKind::$variant),+
                }
            }
        }

        /// An expression in which `$name` is the model of a [`Model`], whichever it is.
        macro_rules! each_member {
            ($dollar self:expr, $dollar name:ident => $dollar answer:expr) => {
                match $dollar self {
                    $(Model::$variant($dollar name) => $dollar answer),+
                }
            };
        }

        /// An expression in which `M` is the type that a [`ModelKind`] stands for.
        macro_rules! each_kind {
            ($dollar self:expr, $dollar m:ident => $dollar answer:expr) => {
                match $dollar self {
                    $(ModelKind::$variant => {
                        type $dollar m = $model;
                        $dollar answer
                    })+
                }
            };
        }
    };
}

models! { $
    /// Burley's normalised diffusion.
    Burley(BurleyModel),
    /// The rational profile that Liang et al. call polynomial.
    Polynomial(PolynomialModel),
    /// A sum of Gaussians.
    GaussianSum(GaussianSumModel),
    /// An exponential plus a dipole.
    ExponentialDipole(ExponentialDipoleModel),
    /// Two exponentials plus a dipole of two sources.
    TwoExponentialDipole(TwoExponentialDipoleModel),
    /// The dipole of diffusion theory.
    Dipole(DipoleModel),
    /// A mixture of any of them.
    Mixture(MixtureModel),
    /// Tables by surface albedo.
    Tabulated(TabulatedModel),
}

impl ModelKind {
    /// What is the same for every member of the model.
    pub fn description(self) -> &'static Description {
        each_kind!(self, M => &<M as ProfileModel>::DESCRIPTION)
    }

    /// The model whose word begins a profile file so: `Burley`.
    pub fn named(name: &str) -> Option<ModelKind> {
        Self::ALL.iter().copied().find(|kind| kind.description().name == name)
    }

    /// The model of this stem: `burley`.
    pub fn of_stem(stem: &str) -> Option<ModelKind> {
        Self::ALL.iter().copied().find(|kind| kind.description().stem == stem)
    }

    /// The fields in the order in which a file writes them; those of a term for a model of terms.
    pub fn fields(self) -> Vec<&'static Field> {
        each_kind!(self, M => <M as ProfileModel>::fields())
    }

    /// The published sets, the one that fits start from first.
    pub fn published(self) -> Vec<PublishedSet> {
        each_kind!(self, M => {
            let set = |set: &'static crate::description::Published<M>| PublishedSet {
                kind: self,
                stem: set.stem,
                word: set.word,
                source: set.source,
                fitted_surface_albedos: set.fitted_surface_albedos,
                entry: set.entry,
                model: (set.model)().into(),
            };
            <M as ProfileModel>::PUBLISHED.iter().map(set).collect()
        })
    }

    /// A member to write coefficients to, of so many terms for a model of terms; `None` for a model that is not made of
    /// coefficients alone.
    pub fn blank(self, terms: usize) -> Option<Model> {
        each_kind!(self, M => <M as ProfileModel>::blank(terms).map(Model::from))
    }

    /// Where a fit to `data` starts; `None` for a model that has nothing to fit. `terms` is how many terms a model of
    /// terms gets.
    pub fn start(self, data: &[RadialData], terms: usize) -> Option<Model> {
        each_kind!(self, M => <M as ProfileModel>::start(data, terms).map(Model::from))
    }

    /// Names and axes of the functions of the surface albedo that the coefficients make; none for many models.
    pub fn functions(self) -> Vec<FunctionOfAlbedo> {
        each_kind!(self, M => {
            let of = |function: &crate::description::Function<M>| FunctionOfAlbedo {
                symbol: function.symbol,
                label: function.label,
                length_power: function.length_power,
                is_scaled_by_energy: function.is_scaled_by_energy,
            };
            <M as ProfileModel>::FUNCTIONS.iter().map(of).collect()
        })
    }

    /// What these functions are drawn over.
    pub fn argument(self) -> Argument {
        each_kind!(self, M => <M as ProfileModel>::ARGUMENT)
    }
}

/// A published set of coefficients.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PublishedSet {
    /// Which model it is of.
    pub kind: ModelKind,
    /// Stem of its profile file.
    pub stem: &'static str,
    /// The word that stands for it in a file; empty for none.
    pub word: &'static str,
    /// Where the coefficients come from.
    pub source: &'static str,
    /// Surface albedos of the stored truth that the set was fitted to; empty where that is not known.
    pub fitted_surface_albedos: &'static [f64],
    /// How light enters the medium, index-matched, that it is a profile of; `None` where that is another medium.
    pub entry: Option<Entry>,
    /// The coefficients.
    pub model: Model,
}

/// A function of the surface albedo that the coefficients of a model make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FunctionOfAlbedo {
    /// Its symbol, such as `w`.
    pub symbol: &'static str,
    /// Symbol and unit, for an axis.
    pub label: &'static str,
    /// The power of the length that the function grows with, if lengths are counted in another unit.
    pub length_power: i32,
    /// Whether a factor of it is free, since the profile is divided by its own integral.
    pub is_scaled_by_energy: bool,
}

impl Model {
    /// A published set of coefficients by its stem, one of [`PUBLISHED`](Self::PUBLISHED).
    pub fn published(stem: &str) -> Option<Model> {
        Self::published_set(stem).map(|set| set.model)
    }

    /// A published set by its stem, with its source.
    pub fn published_set(stem: &str) -> Option<PublishedSet> {
        ModelKind::ALL.iter().flat_map(|kind| kind.published()).find(|set| set.stem == stem)
    }

    /// How light enters the medium, index-matched, that this is a profile of: known of published sets.
    pub fn entry(&self) -> Option<Entry> {
        let mut sets = ModelKind::ALL.iter().flat_map(|kind| kind.published());
        sets.find(|set| set.model == *self).and_then(|set| set.entry)
    }

    /// What is the same for every member of the model.
    pub fn description(&self) -> &'static Description {
        self.kind().description()
    }

    /// Which length [`Medium::mean_free_path_mm`] must be for this model.
    ///
    /// A model that does not use it, see [`dependence`](Self::dependence), says [`Length::MeanFreePath`].
    pub fn length(&self) -> Length {
        each_member!(self, model => model.length())
    }

    /// Chooses one of the lengths that the model may be parametrized by.
    pub fn set_length(&mut self, length: Length) {
        each_member!(self, model => model.set_length(length));
    }

    /// What the shape of a profile depends on besides its coefficients.
    pub fn dependence(&self) -> Dependence {
        each_member!(self, model => model.dependence())
    }

    /// What the member is made of.
    pub fn contents(&self) -> Contents<'_> {
        each_member!(self, model => model.contents())
    }

    /// The model, or what a mixture is made of in the end, with its share.
    pub fn leaves(&self) -> Vec<(f64, &Model)> {
        match self.contents() {
            Contents::Parts(mixture) => mixture.leaves(),
            Contents::Coefficients | Contents::Terms(_) | Contents::Table(_) => vec![(1.0, self)],
        }
    }

    pub(crate) fn collect_errors(&self, errors: &mut Vec<ModelError>) {
        each_member!(self, model => model.collect_errors(errors));
    }

    /// The first of [`errors`](Self::errors).
    pub fn validate(&self) -> Result<(), ModelError> {
        each_member!(self, model => model.validate())
    }

    /// All that is wrong with the coefficients alone, whatever the medium.
    pub fn errors(&self) -> Vec<ModelError> {
        each_member!(self, model => model.errors())
    }

    /// The profile of one channel of a medium, whose length is [`self.length()`](Self::length).
    ///
    /// Coefficients that pass [`validate`](Self::validate) may still describe no profile at a certain surface
    /// albedo; then this says why.
    pub fn profile(&self, medium: Medium, channel: Channel) -> Result<Box<dyn RadialProfile>, ModelError> {
        self.validate()?;
        each_member!(self, model => model.boxed_profile(medium, channel))
    }

    /// The integral of 2πr·R/A as the model's equation gives it, before the profile is divided by it: how far the model
    /// misses the conservation of energy. `None` for a model whose equation conserves it.
    ///
    /// `surface_albedo` in (0, 1].
    pub fn energy_before_normalization(&self, surface_albedo: f64) -> Option<Result<f64, ModelError>> {
        each_member!(self, model => model.energy(surface_albedo))
    }

    /// Calls `visitor` with every field and its numbers, in the order in which a file writes them, term by term.
    pub fn visit(&mut self, visitor: &mut dyn FnMut(Slot<'_>)) {
        each_member!(self, model => model.visit(visitor));
    }

    /// Takes the dependence on the surface albedo out: what the member is at A, it becomes everywhere.
    ///
    /// The published functions of A, shifted so that they fit at one A, may describe no profile at another.
    pub fn make_constant(&mut self, surface_albedo: f64) {
        each_member!(self, model => model.make_constant(surface_albedo));
    }

    /// Divides what only ratios matter of by its sum, as papers print it.
    pub fn normalise(&mut self) {
        each_member!(self, model => model.normalise());
    }

    /// The values at a surface albedo of the functions that [`ModelKind::functions`] names.
    pub fn functions_at(&self, surface_albedo: f64) -> Vec<f64> {
        fn values<M: ProfileModel>(model: &M, surface_albedo: f64) -> Vec<f64> {
            M::FUNCTIONS.iter().map(|function| (function.at)(model, surface_albedo)).collect()
        }
        each_member!(self, model => values(model, surface_albedo))
    }
}
