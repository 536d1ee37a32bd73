//! The coefficients of a model, as a fit sees them. A new model adds an arm to each `match` here.

use crate::single_scattering_albedo::{Entry, from_surface_albedo};
use crate::{
    BurleyShape, GaussianTerm, Model, PolynomialA, PolynomialB, PolynomialC, RadialData,
    TwoExponentialDipoleModel,
};

use super::FitError;

/// A coefficient of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Path of the field from its model, such as `shape.pivot` or `dipole_depth[0]`.
    pub name: String,
    /// Its value.
    pub value: f64,
}

impl Model {
    /// The coefficients that a fit may change, by the names that [`ModelError`](crate::ModelError) uses; none for
    /// a tabulated profile.
    ///
    /// A Gaussian sum has one weight per term: that of the red channel.
    pub fn parameters(&self) -> Vec<Parameter> {
        let mut model = self.clone();
        let coefficients = coefficients(&mut model);
        coefficients.into_iter().map(|c| Parameter { value: c.value(), name: c.name }).collect()
    }

    /// The model with these values in the order of [`parameters`](Self::parameters); `None` where their number
    /// differs. Weights of a Gaussian sum go to all channels alike.
    ///
    /// The values are not checked: [`validate`](Self::validate) does that.
    pub fn with_parameters(&self, values: &[f64]) -> Option<Model> {
        let mut model = self.clone();
        let coefficients = coefficients(&mut model);
        if coefficients.len() != values.len() {
            return None;
        }
        for (mut coefficient, value) in coefficients.into_iter().zip(values) {
            coefficient.set(*value);
        }
        Some(model)
    }
}

/// The values that a coefficient may take, as far as they do not depend on the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Domain {
    Any,
    /// Above 0: fitted by its logarithm.
    Positive,
}

/// One coefficient within a model.
struct Coefficient<'a> {
    name: String,
    /// How many other terms of the same function of the surface albedo come before it.
    order: usize,
    domain: Domain,
    /// Where it stands: more than once, if the fit does not tell channels apart.
    places: Vec<&'a mut f64>,
}

impl<'a> Coefficient<'a> {
    fn new(name: &str, order: usize, place: &'a mut f64) -> Self {
        Coefficient { name: name.to_owned(), order, domain: Domain::Any, places: vec![place] }
    }

    fn value(&self) -> f64 {
        *self.places[0]
    }

    fn set(&mut self, value: f64) {
        for place in &mut self.places {
            **place = value;
        }
    }
}

/// The terms of a polynomial in the surface albedo.
fn powers<'a>(field: &'a str, terms: &'a mut [f64]) -> impl Iterator<Item = Coefficient<'a>> {
    let of = move |(order, term)| Coefficient::new(&format!("{field}[{order}]"), order, term);
    terms.iter_mut().enumerate().map(of)
}

fn gaussian((index, term): (usize, &mut GaussianTerm)) -> [Coefficient<'_>; 2] {
    let GaussianTerm { variance_mm2, weight: [red, green, blue] } = term;
    let positive = |field: &str, places| {
        let name = format!("terms[{index}].{field}");
        Coefficient { name, order: 0, domain: Domain::Positive, places }
    };
    [positive("variance_mm2", vec![variance_mm2]), positive("weight", vec![red, green, blue])]
}

fn coefficients(model: &mut Model) -> Vec<Coefficient<'_>> {
    match model {
        Model::Burley(model) => vec![
            Coefficient::new("shape.constant", 0, &mut model.shape.constant),
            Coefficient::new("shape.slope", 1, &mut model.shape.slope),
            Coefficient::new("shape.amplitude", 2, &mut model.shape.amplitude),
            Coefficient::new("shape.pivot", 3, &mut model.shape.pivot),
            Coefficient::new("shape.exponent", 4, &mut model.shape.exponent),
        ],
        Model::Polynomial(model) => vec![
            Coefficient::new("a.linear", 0, &mut model.a.linear),
            Coefficient::new("a.amplitude", 1, &mut model.a.amplitude),
            Coefficient::new("a.decades", 2, &mut model.a.decades),
            Coefficient::new("b.scale", 0, &mut model.b.scale),
            Coefficient::new("b.curvature", 3, &mut model.b.curvature),
            Coefficient::new("b.pivot", 4, &mut model.b.pivot),
            Coefficient::new("b.offset", 2, &mut model.b.offset),
            Coefficient::new("b.exponent", 1, &mut model.b.exponent),
            Coefficient::new("c.amplitude", 1, &mut model.c.amplitude),
            Coefficient::new("c.rate", 2, &mut model.c.rate),
            Coefficient::new("c.offset", 0, &mut model.c.offset),
        ],
        Model::GaussianSum(model) => model.terms.iter_mut().enumerate().flat_map(gaussian).collect(),
        Model::ExponentialDipole(model) => powers("exponential_weight", &mut model.exponential_weight)
            .chain(powers("exponential_length", &mut model.exponential_length))
            .chain(powers("dipole_depth", &mut model.dipole_depth))
            .chain(powers("dipole_attenuation", &mut model.dipole_attenuation))
            .collect(),
        Model::Tabulated(_) => Vec::new(),
        Model::TwoExponentialDipole(model) => powers("exponential_weight", &mut model.exponential_weight)
            .chain(powers("exponential_length", &mut model.exponential_length))
            .chain(powers("dipole_depth", &mut model.dipole_depth))
            .chain(powers("dipole_attenuation", &mut model.dipole_attenuation))
            .chain([
                Coefficient::new("short_weight", 0, &mut model.short_weight),
                Coefficient {
                    domain: Domain::Positive,
                    ..Coefficient::new("short_length", 0, &mut model.short_length)
                },
                Coefficient::new("second_weight", 0, &mut model.second_weight),
                Coefficient {
                    domain: Domain::Positive,
                    ..Coefficient::new("second_depth", 0, &mut model.second_depth)
                },
            ])
            .collect(),
    }
}

/// Puts the polynomial's value at x into its constant term.
fn flatten(terms: &mut [f64], x: f64) {
    let value = terms.iter().rev().fold(0.0, |sum, term| sum * x + term);
    for (order, term) in terms.iter_mut().enumerate() {
        *term = if order == 0 { value } else { 0.0 };
    }
}

/// Takes the dependence on the surface albedo out of a model: what it is at A, it becomes everywhere.
///
/// The published functions of A, shifted so that they fit at one A, may describe no profile at another.
fn make_constant(model: &mut Model, surface_albedo: f64) {
    match model {
        Model::Burley(model) => {
            let s = model.shape.at(surface_albedo);
            model.shape = BurleyShape { constant: s, slope: 0.0, amplitude: 0.0, ..model.shape };
        }
        Model::Polynomial(model) => {
            let alpha = from_surface_albedo(Entry::Searchlight, surface_albedo);
            let (a, b, c) = (model.a.at(alpha), model.b.at(alpha), model.c.at(alpha));
            // a must stay proportional to α: without a term of another sign there is no other constant.
            model.a = PolynomialA { linear: a / alpha, amplitude: 0.0, ..model.a };
            model.b = PolynomialB { scale: b, curvature: 0.0, offset: 0.0, exponent: 0.0, ..model.b };
            model.c = PolynomialC { amplitude: 0.0, offset: c, ..model.c };
        }
        // Nothing depends on A, or there is nothing to fit.
        Model::GaussianSum(_) | Model::Tabulated(_) => {}
        Model::ExponentialDipole(model) => {
            for terms in [
                &mut model.exponential_weight,
                &mut model.exponential_length,
                &mut model.dipole_depth,
                &mut model.dipole_attenuation,
            ] {
                flatten(terms, surface_albedo);
            }
        }
        Model::TwoExponentialDipole(model) => {
            let variable = TwoExponentialDipoleModel::variable(surface_albedo);
            for terms in [
                &mut model.exponential_weight,
                &mut model.exponential_length,
                &mut model.dipole_depth,
                &mut model.dipole_attenuation,
            ] {
                flatten(terms, variable);
            }
        }
    }
}

/// A coefficient that the fit changes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Free {
    /// Position among the model's parameters.
    pub(super) index: usize,
    pub(super) name: String,
    pub(super) domain: Domain,
}

/// Prepares `model` for data of so many surface albedos: the coefficients that they can tell apart.
pub(super) fn free(model: &mut Model, data: &[RadialData]) -> Result<Vec<Free>, FitError> {
    let mut surface_albedos: Vec<f64> = data.iter().map(RadialData::surface_albedo).collect();
    surface_albedos.sort_by(f64::total_cmp);
    surface_albedos.dedup();
    if let [only] = surface_albedos[..] {
        make_constant(model, only);
    }
    let coefficients = coefficients(model);
    if coefficients.is_empty() {
        return Err(FitError::NoCoefficients);
    }
    let mut free = Vec::with_capacity(coefficients.len());
    for (index, Coefficient { name, order, domain, .. }) in coefficients.into_iter().enumerate() {
        if order < surface_albedos.len() {
            free.push(Free { index, name, domain });
        }
    }
    Ok(free)
}
