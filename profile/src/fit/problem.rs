//! The fit as a problem of least squares.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::{DMatrix, DVector, Dyn, storage::Owned};

use crate::Model;

use super::coefficient::{Domain, Free};
use super::criterion::Target;
use super::{FitError, Stop, profile_of};

/// Relative change of the cost, and of the coefficients, below which the fit has converged.
const TOLERANCE: f64 = 1e-12;

/// Step of the central differences over the size of a coefficient: ε^(1/3), which balances rounding against the
/// curvature.
const STEP: f64 = 6e-6;

/// What came of it.
pub(super) struct Solution {
    pub(super) model: Model,
    pub(super) cost_at_start: f64,
    pub(super) cost: f64,
    pub(super) evaluations: usize,
    pub(super) stop: Stop,
    pub(super) free: Vec<String>,
}

struct Problem<'a> {
    start: &'a Model,
    start_values: &'a [f64],
    free: &'a [Free],
    targets: &'a [Target<'a>],
    /// The free coefficients as the solver sees them: logarithms of those that must be above 0.
    x: DVector<f64>,
    /// What stands for the residuals where there is no profile: so much worse than the start that the step there is
    /// taken back.
    illegal: f64,
}

impl Problem<'_> {
    fn model(&self, x: &DVector<f64>) -> Option<Model> {
        let mut values = self.start_values.to_vec();
        for (free, x) in self.free.iter().zip(x.iter()) {
            values[free.index] = match free.domain {
                Domain::Any => *x,
                Domain::Positive => x.exp(),
            };
        }
        self.start.with_parameters(&values)
    }

    /// `None` where the coefficients describe no profile, or residuals out of the range of numbers.
    fn residuals_at(&self, x: &DVector<f64>) -> Option<Vec<f64>> {
        let model = self.model(x)?;
        let mut residuals = Vec::new();
        for target in self.targets {
            let profile = profile_of(&model, target.data).ok()?.ok()?;
            target.residuals(&*profile, &mut residuals);
        }
        let cost: f64 = residuals.iter().map(|residual| residual * residual).sum();
        cost.is_finite().then_some(residuals)
    }

    /// `x` with one coefficient moved by `steps` of its central difference.
    fn moved(&self, index: usize, steps: f64) -> DVector<f64> {
        let mut x = self.x.clone();
        x[index] += steps * STEP * x[index].abs().max(1e-3);
        x
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from(x);
    }

    fn params(&self) -> DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let rows = self.targets.iter().map(Target::rows).sum();
        Some(match self.residuals_at(&self.x) {
            Some(residuals) => DVector::from_vec(residuals),
            None => DVector::from_element(rows, self.illegal),
        })
    }

    /// Central differences; one-sided ones where the other side has no profile.
    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let here = self.residuals_at(&self.x)?;
        let mut jacobian = DMatrix::zeros(here.len(), self.x.len());
        for index in 0..self.x.len() {
            let (above, below) = (self.moved(index, 1.0), self.moved(index, -1.0));
            let span = |upper: &DVector<f64>, lower: &DVector<f64>| upper[index] - lower[index];
            let (upper, lower, span) = match (self.residuals_at(&above), self.residuals_at(&below)) {
                (Some(upper), Some(lower)) => (upper, lower, span(&above, &below)),
                (Some(upper), None) => (upper, here.clone(), span(&above, &self.x)),
                (None, Some(lower)) => (here.clone(), lower, span(&self.x, &below)),
                (None, None) => return None,
            };
            for (row, (upper, lower)) in upper.iter().zip(&lower).enumerate() {
                jacobian[(row, index)] = (upper - lower) / span;
            }
        }
        Some(jacobian)
    }
}

fn cost(residuals: &[f64]) -> f64 {
    0.5 * residuals.iter().map(|residual| residual * residual).sum::<f64>()
}

/// Minimises the squares of the residuals of all `targets`.
pub(super) fn solve(
    start: Model,
    free: Vec<Free>,
    targets: &[Target<'_>],
    patience: usize,
) -> Result<Solution, FitError> {
    let start_values: Vec<f64> = start.parameters().iter().map(|parameter| parameter.value).collect();
    let x = free.iter().map(|free| match free.domain {
        Domain::Any => start_values[free.index],
        // A weight of 0 has no logarithm; the smallest number is as good as none.
        Domain::Positive => start_values[free.index].max(f64::MIN_POSITIVE).ln(),
    });
    let x = DVector::from_vec(x.collect());
    let mut problem = Problem {
        start: &start,
        start_values: &start_values,
        free: &free,
        targets,
        x: x.clone(),
        illegal: 0.0,
    };
    let at_start = problem.residuals_at(&x).ok_or(FitError::OutOfNumericRange)?;
    let cost_at_start = cost(&at_start);
    problem.illegal = 100.0 * (1.0 + cost_at_start.sqrt());

    let solver = LevenbergMarquardt::new()
        .with_ftol(TOLERANCE)
        .with_xtol(TOLERANCE)
        .with_gtol(TOLERANCE)
        .with_patience(patience);
    let (mut problem, report) = solver.minimize(problem);
    let mut stop = match report.termination {
        TerminationReason::LostPatience => Stop::Patience,
        TerminationReason::ResidualsZero
        | TerminationReason::Orthogonal
        | TerminationReason::Converged { .. }
        // The tolerances are below the rounding of the residuals: nothing is left to gain.
        | TerminationReason::NoImprovementPossible(_) => Stop::Converged,
        _ => Stop::NoDerivative,
    };
    // The solver may end on a step that it took back, or on none.
    let mut reached = problem.residuals_at(&problem.x).map_or(f64::INFINITY, |residuals| cost(&residuals));
    if reached > cost_at_start {
        problem.x = x;
        reached = cost_at_start;
    }
    if stop == Stop::Converged
        && let Some(bound) = (0..free.len()).find(|&index| is_bounded(&problem, index, reached))
    {
        stop = Stop::Bound { coefficient: free[bound].name.clone() };
    }
    let mut model = problem.model(&problem.x).ok_or(FitError::NoCoefficients)?;
    model.normalise();
    Ok(Solution {
        model,
        cost_at_start,
        cost: reached,
        evaluations: report.number_of_evaluations,
        stop,
        free: free.into_iter().map(|free| free.name).collect(),
    })
}

/// Whether a coefficient stands beside an illegal value, and the cost falls towards it.
fn is_bounded(problem: &Problem<'_>, index: usize, here: f64) -> bool {
    // The solver comes to within its tolerance of a bound, which is far less than a step of the differences.
    let at = |steps| problem.residuals_at(&problem.moved(index, steps)).map(|residuals| cost(&residuals));
    match (at(1.0), at(-1.0)) {
        (None, Some(away)) | (Some(away), None) => away > here,
        (None, None) => true,
        (Some(_), Some(_)) => false,
    }
}
