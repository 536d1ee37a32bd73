//! A search that has found nothing.

use crate::curves::NoProfile;
use crate::diagnostics::Diagnostic;
use subsurface_kernel::Estimator;

use super::request::QualityRequest;

/// Why a search has found nothing.
#[derive(Clone, Debug)]
pub(crate) enum Unreachable {
    /// No candidate is within the error: the best of them, and its error.
    OutOfReach { request: Box<QualityRequest>, best: Estimator, error: f64 },
    /// A material without a profile.
    NoProfile(NoProfile),
}

impl From<Unreachable> for Diagnostic {
    fn from(error: Unreachable) -> Self {
        let (request, best, error) = match error {
            Unreachable::OutOfReach { request, best, error } => (request, best, error),
            Unreachable::NoProfile(error) => return error.into(),
        };
        let target = request.quality.target();
        let who = match request.estimator {
            Some(kind) => format!("`{}`", kind.name()),
            None => "no kernel".to_owned(),
        };
        let verb = if request.estimator.is_some() { "does not reach" } else { "reaches" };
        let diagnostic = Diagnostic::error(format!("{who} {verb} an error of {target}"))
            .label(request.span, format!("the least is {error}: {best}"))
            .help(format!("ask for `MaxError({error})` or more"));
        let diagnostic = match request.estimator {
            Some(Estimator::Interleaved { .. }) | None => diagnostic,
            Some(_) => diagnostic.help("or leave `kernel` out, and all kernels are tried"),
        };
        diagnostic.help("`kernel: Dense` is exact, and slow")
    }
}
