//! Profiles by name: files that name each other, and the published ones behind them.

use std::collections::{BTreeMap, BTreeSet};

use subsurface_profile::Model;

use crate::diagnostics::Diagnostic;
use crate::material::ResolvedProfile;
use crate::schema::ProfileExpression;
use crate::source::{FileId, Spanned};
use crate::suggestion::{closest, shortened};

use super::{Files, cycle, some_of};

/// The files passed on the way from a name to a model, and what was found.
pub(crate) struct Chain {
    pub(crate) files: Vec<FileId>,
    pub(crate) end: ChainEnd,
}

pub(crate) enum ChainEnd {
    /// A model written in a file.
    Model(Box<ResolvedProfile>),
    /// A published model and its stem.
    Published(String, Model),
    /// Neither a file nor a published profile has the last name.
    Unknown,
    /// A file with errors, or a cycle.
    Broken,
}

/// Follows a name through alias files.
pub(crate) fn chain(files: &Files, name: &str) -> Chain {
    let mut passed = Vec::new();
    let mut name = name;
    let mut seen = BTreeSet::new();
    let end = loop {
        let Some(file) = files.profiles.get(name) else {
            break Model::published(name)
                .map_or(ChainEnd::Unknown, |model| ChainEnd::Published(name.to_owned(), model));
        };
        if !seen.insert(name) {
            break ChainEnd::Broken;
        }
        passed.push(file.file);
        match &file.expression {
            None => break ChainEnd::Broken,
            Some(ProfileExpression::Named(next)) => name = &next.value,
            Some(ProfileExpression::Inline(inline)) => {
                break ChainEnd::Model(Box::new(ResolvedProfile {
                    stem: Some(file.stem.clone()),
                    model: inline.model.clone(),
                    docs: file.docs.clone(),
                    span: inline.head.clone(),
                    coefficient_spans: inline.coefficients.clone(),
                }));
            }
        }
    };
    Chain { files: passed, end }
}

/// All names a profile may be called by, sorted.
pub(super) fn profile_names(files: &Files) -> impl Iterator<Item = &str> {
    let names: BTreeSet<&str> = files.profiles.keys().map(String::as_str).chain(Model::PUBLISHED).collect();
    names.into_iter()
}

/// The error for a name that is neither a file's nor a published profile's.
pub(crate) fn unknown_profile(files: &Files, name: &Spanned<String>) -> Diagnostic {
    let folder = &files.profiles_folder;
    let text = &name.value;
    let shown = shortened(text);
    let mut diagnostic = Diagnostic::error(format!("unknown profile `{shown}`"))
        .label(name.span.clone(), "neither a profile file nor a built-in profile");
    let stem = text.rsplit(['/', '\\']).next().unwrap_or(text);
    let stem = stem.strip_suffix(".ron").unwrap_or(stem);
    if stem != text && profile_names(files).any(|other| other == stem) {
        diagnostic = diagnostic.help(format!("write the stem of the file alone: `\"{stem}\"`"));
    } else if let Some(meant) = closest(stem, profile_names(files)) {
        diagnostic = diagnostic.help(format!("did you mean `{meant}`?"));
    } else {
        diagnostic = diagnostic
            .help(format!("there is no file `{folder}/{shown}.ron`: write it, or use another profile"));
    }
    diagnostic.help(format!("the profiles are {}", some_of(profile_names(files))))
}

/// Reports profile files that name each other in a circle, or name nothing.
pub(super) fn check_aliases(files: &Files) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    let mut edges = BTreeMap::new();
    for (stem, file) in &files.profiles {
        let Some(ProfileExpression::Named(target)) = &file.expression else { continue };
        if files.profiles.contains_key(&target.value) {
            edges.insert(stem.as_str(), (target.value.as_str(), &target.span));
        } else if Model::published(&target.value).is_none() {
            diagnostics.push(unknown_profile(files, target));
        }
    }
    for cycle in cycle::find(&edges) {
        let diagnostic = cycle::describe(&cycle, &edges, "profile", "imports itself", "is");
        diagnostics.push(
            diagnostic
                .help("write a model in one of these files, such as `Burley(parametrization: Searchlight)`"),
        );
    }
    diagnostics
}
