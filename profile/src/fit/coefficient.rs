//! The coefficients of a model, as a fit sees them.

use crate::description::{Field, Values};
use crate::{Bounds, Model, RadialData};

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
    /// A field with a number for each channel counts as one: that of the red channel.
    pub fn parameters(&self) -> Vec<Parameter> {
        coefficients(&mut self.clone())
            .into_iter()
            .map(|c| Parameter { name: c.name, value: c.value })
            .collect()
    }

    /// The model with these values in the order of [`parameters`](Self::parameters); `None` where their number
    /// differs. What has a number for each channel gets the value in all of them.
    ///
    /// The values are not checked: [`validate`](Self::validate) does that.
    pub fn with_parameters(&self, values: &[f64]) -> Option<Model> {
        let mut model = self.clone();
        let mut rest = values.iter().copied();
        let mut is_short = false;
        model.visit(&mut |slot| match (slot.field.order, slot.field.values) {
            (None, _) => {}
            (Some(_), Values::Channels) => match rest.next() {
                Some(value) => slot.values.fill(value),
                None => is_short = true,
            },
            (Some(_), Values::One | Values::Powers(_)) => {
                for place in slot.values {
                    match rest.next() {
                        Some(value) => *place = value,
                        None => is_short = true,
                    }
                }
            }
        });
        (!is_short && rest.next().is_none()).then_some(model)
    }
}

/// The values that a coefficient may take, as far as they do not depend on the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Domain {
    Any,
    /// Above 0: fitted by its logarithm.
    Positive,
}

impl Domain {
    fn of(field: &Field) -> Self {
        match field.quantity.bounds {
            Bounds::Positive | Bounds::NonNegative => Self::Positive,
            Bounds::Any | Bounds::Unit | Bounds::Between(..) => Self::Any,
        }
    }
}

/// One coefficient of a model.
struct Coefficient {
    name: String,
    value: f64,
    /// How many other terms of the same function of the surface albedo come before it.
    order: usize,
    domain: Domain,
}

fn coefficients(model: &mut Model) -> Vec<Coefficient> {
    let mut coefficients = Vec::new();
    model.visit(&mut |slot| {
        let Some(order) = slot.field.order else { return };
        let domain = Domain::of(slot.field);
        match slot.field.values {
            Values::One | Values::Channels => {
                coefficients.push(Coefficient { name: slot.path(), value: slot.values[0], order, domain });
            }
            Values::Powers(_) => {
                for (power, &value) in slot.values.iter().enumerate() {
                    let name = slot.path_of(power);
                    coefficients.push(Coefficient { name, value, order: order + power, domain });
                }
            }
        }
    });
    coefficients
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
        model.make_constant(only);
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
