//! Sets that ask for a kernel by its error: `subsurface-quality` searches, and the compiler says where in the files.

use std::fmt::Write as _;

use subsurface_kernel::{Estimator, Rejection};
use subsurface_quality::{Material, QualityReport, SearchError, search};

use crate::diagnostics::Diagnostic;
use crate::material::MaterialSet;
use crate::no_profile::no_profile;
use crate::quality_request::QualityRequest;

/// Searches the cheapest kernel for `set` that is as good as `request` asks for.
pub(crate) fn solve(
    set: &MaterialSet,
    rejection: Rejection,
    request: &QualityRequest,
) -> Result<QualityReport, Box<Diagnostic>> {
    let materials: Vec<Material<'_>> = set
        .materials
        .iter()
        .map(|material| Material {
            model: &material.profile.model,
            mean_free_path_mm: material.mean_free_path_mm,
            surface_albedo: material.surface_albedo,
        })
        .collect();
    search(&materials, rejection, request.quality, request.estimator, request.device).map_err(|error| {
        Box::new(match error {
            SearchError::NoProfile(error) => no_profile(set, &error),
            SearchError::OutOfReach { best, error } => out_of_reach(request, best, error),
        })
    })
}

fn out_of_reach(request: &QualityRequest, best: Estimator, error: f64) -> Diagnostic {
    let target = request.quality.target();
    let who = match request.estimator {
        Some(kind) => format!("`{}`", kind.name()),
        None => "no kernel".to_owned(),
    };
    let verb = if request.estimator.is_some() { "does not reach" } else { "reaches" };
    let diagnostic = Diagnostic::error(format!("{who} {verb} an error of {target}"))
        .label(request.span.clone(), format!("the least is {error}: {best}"))
        .help(format!("ask for `MaxError({error})` or more"));
    let diagnostic = match request.estimator {
        Some(Estimator::Interleaved { .. }) | None => diagnostic,
        Some(_) => diagnostic.help("or leave `kernel` out, and all kernels are tried"),
    };
    diagnostic.help("`kernel: Dense` is exact, and slow")
}

/// The lines of the generated text that state the error.
pub(crate) fn comment(report: &QualityReport) -> String {
    let mut comment = format!(
        "// Error: {} of the white level, root mean square; of the worst pixel {}\n// Taps for less or more:",
        report.error, report.worst_pixel
    );
    for (index, tier) in report.tiers.iter().enumerate() {
        let comma = if index == 0 { "" } else { "," };
        let _ = write!(comment, "{comma} {} {} ({})", tier.tier.name(), tier.taps, tier.error);
    }
    comment.push('\n');
    comment
}
