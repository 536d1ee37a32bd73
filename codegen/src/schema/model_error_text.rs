//! What a file's author reads when the coefficients of a model give no profile.

use std::collections::BTreeMap;

use subsurface_profile::ModelError;

use crate::diagnostics::Diagnostic;
use crate::source::Span;

/// The error of a model, at the coefficients that are to blame; `head` is the model's name.
pub(super) fn describe(error: &ModelError, head: &Span, spans: &BTreeMap<String, Span>) -> Diagnostic {
    let span = place(&error.coefficient(), spans).unwrap_or(head).clone();
    let diagnostic = Diagnostic::error(error.to_string()).label(span, error.expected()).help(error.remedy());
    match error.surface_albedo() {
        None => diagnostic,
        Some(_) => diagnostic.help(
            "a texture may set the surface albedo of a pixel: a model needs a profile for all of [0, 1]",
        ),
    }
}

/// Where a coefficient is written, or the smallest group or list that holds it.
fn place<'s>(path: &str, spans: &'s BTreeMap<String, Span>) -> Option<&'s Span> {
    let mut path = path;
    loop {
        match spans.get(path) {
            Some(span) => return Some(span),
            None => path = &path[..path.rfind(['.', '['])?],
        }
    }
}
