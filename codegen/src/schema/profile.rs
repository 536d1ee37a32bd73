//! Profile files and inline profiles.

use std::collections::BTreeMap;

use subsurface_profile::{Channel, Medium, Model, ModelError, ModelKind};

use crate::diagnostics::Diagnostic;
use crate::schema::body::Body;
use crate::schema::decoder::{Decoder, head};
use crate::schema::model::{Decoded, decode_model};
use crate::schema::model_error_text::describe;
use crate::schema::set_file::SET;
use crate::source::{FileId, Span, Spanned};
use crate::suggestion::{closest, list, shortened};
use crate::syntax::{Document, Name, Node, Shape};

/// A file of `profiles/`.
#[derive(Clone, Debug)]
pub(crate) struct ProfileFile {
    pub(crate) file: FileId,
    pub(crate) stem: String,
    pub(crate) docs: Vec<String>,
    /// `None` when the file has errors.
    pub(crate) expression: Option<ProfileExpression>,
}

/// What stands where a profile is expected.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ProfileExpression {
    /// The stem of a profile file.
    Named(Spanned<String>),
    /// A model with its coefficients.
    Inline(InlineModel),
}

/// A model and where it is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InlineModel {
    pub(crate) model: Model,
    /// The model's name.
    pub(crate) head: Span,
    /// Where each coefficient is written, by path: `terms[2].variance_mm2`.
    pub(crate) coefficients: BTreeMap<String, Span>,
}

/// The words that begin a model.
fn models() -> impl Iterator<Item = &'static str> {
    ModelKind::ALL.iter().map(|kind| kind.description().name)
}

/// Surface albedos at which a model must have a profile. A texture may give any from 0 to 1 per pixel, so a model that
/// fails somewhere is refused; 32 steps find a failure wider than 0.03, and both ends have their own limits.
fn probed_surface_albedos() -> impl Iterator<Item = f64> {
    (0..=32).map(|step| f64::from(step) / 32.0)
}

/// Decodes a file of `profiles/`.
pub(crate) fn decode_profile_file(
    decoder: &mut Decoder,
    file: FileId,
    stem: String,
    document: &Document<'_>,
) -> ProfileFile {
    let node = &document.value;
    let noun = match node.name().map(|name| name.text) {
        Some("Material") => Some("a material"),
        Some(SET) => Some("a material set"),
        _ => None,
    };
    let expression = if let Some(noun) = noun {
        decoder.report(
            Diagnostic::error(format!("expected a profile, found {noun}"))
                .label(head(node.name().as_ref(), node), format!("{noun} does not belong among profiles"))
                .help(format!("profiles are {} or the name of another profile in quotes", list(models())))
                .help("move the file one folder up, out of `profiles`"),
        );
        None
    } else {
        decode_profile(decoder, node, "profile")
    };
    ProfileFile { file, stem, docs: document.docs.clone(), expression }
}

/// Decodes what stands where a profile is expected.
pub(crate) fn decode_profile(
    decoder: &mut Decoder,
    node: &Node<'_>,
    field: &str,
) -> Option<ProfileExpression> {
    if let Shape::Text(text) = node.shape() {
        return Some(ProfileExpression::Named(Spanned::new(text, node.span())));
    }
    written_model(decoder, node, field).map(ProfileExpression::Inline)
}

/// Decodes a model that must be written out: it may not be the name of a profile file.
pub(super) fn decode_written_model(
    decoder: &mut Decoder,
    node: &Node<'_>,
    field: &str,
) -> Option<InlineModel> {
    if let Shape::Text(name) = node.shape() {
        decoder.report(
            Diagnostic::error(format!("`{field}` is a name, `\"{}\"`", shortened(&name)))
                .label(node.span(), "expected a model with its coefficients")
                .help("write the model out: `Burley(parametrization: Searchlight)`, or what stands in the profile's file"),
        );
        return None;
    }
    written_model(decoder, node, field)
}

fn written_model(decoder: &mut Decoder, node: &Node<'_>, field: &str) -> Option<InlineModel> {
    let Some((name, body)) = Body::of(node) else {
        let examples = ModelKind::ALL.iter().map(|kind| kind.description().example);
        let help = format!("write the stem of a profile file in quotes, or a model: {}", list(examples));
        decoder.wrong_type(node, field, "a profile", help);
        return None;
    };
    let Some(kind) = ModelKind::named(name.text) else {
        unknown_model(decoder, &name);
        return None;
    };
    let Decoded { model, spans } = decode_model(decoder, kind, &name, body)?;
    let errors = model_errors(&model);
    for error in &errors {
        decoder.report(describe(error, &name.span, &spans));
    }
    errors.is_empty().then_some(InlineModel { model, head: name.span, coefficients: spans })
}

fn unknown_model(decoder: &mut Decoder, name: &Name<'_>) {
    let mut diagnostic = Diagnostic::error(format!("unknown profile model `{}`", shortened(name.text)))
        .label(name.span.clone(), "not a profile model");
    match closest(name.text, models()) {
        // Models are capitalised, files are not.
        _ if name.text.starts_with(|c: char| c.is_lowercase()) => {
            let help = format!("a profile file is named in quotes: `\"{}\"`", shortened(name.text));
            diagnostic = diagnostic.help(help);
        }
        Some(meant) => diagnostic = diagnostic.help(format!("did you mean `{meant}`?")),
        None => {
            diagnostic = diagnostic.help("a profile file is named in quotes: `profile: \"burley_diffuse\"`")
        }
    }
    decoder.report(diagnostic.help(format!("the models are {}", list(models()))));
}

/// All that is wrong with the coefficients, and the first surface albedo at which they give no profile.
fn model_errors(model: &Model) -> Vec<ModelError> {
    let errors = model.errors();
    if !errors.is_empty() {
        return errors;
    }
    let at = |surface_albedo| {
        let medium = Medium::new(surface_albedo, 1.0).ok()?;
        model.profile(medium, Channel::Red).err()
    };
    probed_surface_albedos().find_map(at).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_published_model_has_a_profile_at_every_probed_surface_albedo() {
        for stem in Model::PUBLISHED {
            let model = Model::published(stem).expect("its own list");
            assert_eq!(model_errors(&model), [], "{stem}");
        }
    }
}
