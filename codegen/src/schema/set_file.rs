//! The file that describes the set itself.

use crate::diagnostics::Diagnostic;
use crate::quality_request::QualityRequest;
use crate::schema::body::Body;
use crate::schema::choice::{choice, no_word, unknown_word};
use crate::schema::decoder::{Decoder, Given, head};
use crate::schema::material::check_version;
use crate::schema::quality::decode_quality;
use crate::source::Span;
use crate::suggestion::{list, shortened};
use crate::syntax::{Document, Node, Shape};
use subsurface_kernel::Estimator;
use subsurface_kernel::{Rejected, Rejection};

/// The name that such a file begins with, whatever it is called.
pub(crate) const SET: &str = "MaterialSet";

/// What a set's own file chooses.
#[derive(Clone, Debug)]
pub(crate) struct SetFile {
    /// The word `MaterialSet`.
    pub(crate) head: Span,
    pub(crate) estimator: Given<Estimator>,
    pub(crate) rejection: Given<Rejection>,
    pub(crate) quality: Given<QualityRequest>,
}

const FIELDS: [&str; 5] = ["version", "kernel", "quality", "device", "rejection"];

/// Names of the kernels.
fn kernels() -> Vec<&'static str> {
    let mut names: Vec<&str> = Estimator::ALL.into_iter().map(Estimator::name).collect();
    names.dedup();
    names
}

/// Decodes a file whose value is `MaterialSet(…)`; `None` when nothing in it can be trusted.
pub(crate) fn decode_set_file(decoder: &mut Decoder, document: &Document<'_>) -> Option<SetFile> {
    let (name, body) = Body::of(&document.value)?;
    let entries = body.fields(decoder, &name, "MaterialSet(kernel: Interleaved(taps: 4))")?;
    check_version(decoder, &entries)?;
    let fields = decoder.fields("`MaterialSet`", name.span.clone(), entries, &FIELDS);
    let estimator = fields.optional("kernel", |node| decode_estimator(decoder, node));
    let rejection = fields.optional("rejection", |node| decode_rejection(decoder, node));
    let quality = decode_quality(decoder, &fields, &estimator);
    Some(SetFile { head: name.span, estimator, rejection, quality })
}

fn decode_estimator(decoder: &mut Decoder, node: &Node<'_>) -> Option<Estimator> {
    let kernels = kernels();
    let Some((name, body)) = Body::of(node) else {
        let help = format!(
            "write `kernel: Interleaved(taps: 4)`; the kernels are {}",
            list(kernels.iter().copied())
        );
        no_word(decoder, node, "kernel", "a kernel", &kernels, help);
        return None;
    };
    let of_name = || Estimator::ALL.into_iter().filter(|kernel| kernel.name() == name.text);
    let Some(usual) = of_name().next() else {
        unknown_word(decoder, &name, "kernel", &kernels);
        return None;
    };
    let turned = of_name().find(|kernel| kernel.is_rotated());
    let (known, example): (&[&str], _) = match (usual.tap_counts().is_some(), turned.is_some()) {
        (true, true) => {
            (&["taps", "rotated"], format!("{}(taps: {}, rotated: false)", name.text, usual.taps()))
        }
        (true, false) => (&["taps"], format!("{}(taps: {})", name.text, usual.taps())),
        (false, _) => (&[], name.text.to_owned()),
    };
    let entries = body.fields(decoder, &name, &example)?;
    let fields = decoder.fields(format!("`{}`", name.text), name.span.clone(), entries, known);
    let rotated = fields.optional("rotated", |node| decoder.truth(node, "rotated"));
    let chosen = turned.filter(|_| rotated.value().copied().unwrap_or_default()).unwrap_or(usual);
    match fields.optional("taps", |node| decode_taps(decoder, node, chosen)) {
        Given::Value(kernel) => Some(kernel),
        Given::Absent => Some(chosen),
        Given::Bad => None,
    }
    .filter(|_| !rotated.is_bad())
}

/// `kernel` with the number of taps that `node` says.
fn decode_taps(decoder: &mut Decoder, node: &Node<'_>, kernel: Estimator) -> Option<Estimator> {
    // Only a kernel that has taps comes here.
    let counts = kernel.tap_counts()?;
    let kind = kernel.name();
    let help = match kernel {
        Estimator::Separable { .. } => {
            "one tap is the pixel itself, the others lie in pairs around it; 17 is usual"
        }
        Estimator::ImportanceSampled { .. } => "17 to 33 are usual",
        Estimator::Interleaved { .. } => "4 is the default; neighbours share their taps, so few do",
        Estimator::Dense => "it reads every pixel in reach",
    };
    let kernel = ron::from_str::<u32>(node.text()).ok().map(|taps| kernel.with_taps(taps));
    if let Some(kernel) = kernel.filter(|kernel| kernel.refused_taps().is_none()) {
        return Some(kernel);
    }
    if let Shape::Number(_) = node.shape() {
        decoder.report(
            Diagnostic::error(format!("`{kind}` with {} taps", shortened(node.text())))
                .label(node.span(), format!("expected {counts}"))
                .help(help),
        );
    } else {
        decoder.wrong_type(node, "taps", &counts.to_string(), help);
    }
    None
}

fn decode_rejection(decoder: &mut Decoder, node: &Node<'_>) -> Option<Rejection> {
    const POLICIES: [&str; 2] = ["Renormalized", "ReturnedToCentre"];
    let entries = match node.shape() {
        Shape::Struct(None, entries) => entries,
        Shape::Tuple(None, nodes) if nodes.is_empty() => Vec::new(),
        _ => {
            let help = "write `rejection: (by_material: true, by_distance: true, by_normal: false, rejected: Renormalized)`";
            decoder.wrong_type(node, "rejection", "named fields", help);
            return None;
        }
    };
    let known = ["by_material", "by_distance", "by_normal", "rejected"];
    let fields = decoder.fields("`rejection`", head(None, node), entries, &known);
    let default = Rejection::default();
    let mut truth = |name, default: bool| {
        let given = fields.optional(name, |node| decoder.truth(node, name));
        if given.is_absent() { Some(default) } else { given.value().copied() }
    };
    let by_material = truth("by_material", default.by_material);
    let by_distance = truth("by_distance", default.by_distance);
    let by_normal = truth("by_normal", default.by_normal);
    let rejected = fields.optional("rejected", |node| match node.shape() {
        Shape::Name(name) if !POLICIES.contains(&name.text) => {
            unknown_word(decoder, &name, "policy", &POLICIES);
            None
        }
        _ => Some(match choice(decoder, node, "rejected", &POLICIES)? {
            "Renormalized" => Rejected::Renormalized,
            _ => Rejected::ReturnedToCentre,
        }),
    });
    Some(Rejection {
        by_material: by_material?,
        by_distance: by_distance?,
        by_normal: by_normal?,
        rejected: if rejected.is_absent() { default.rejected } else { *rejected.value()? },
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::source::SourceMap;
    use crate::syntax;

    /// What a text says, or the first error in it: message, label and the text that it points at.
    pub(in crate::schema) fn decoded_file(text: &str) -> Result<SetFile, [String; 3]> {
        let file = SourceMap::new().add("set.ron", text);
        let document = syntax::parse(file, text).unwrap_or_else(|error| panic!("{}", error.message));
        let mut decoder = Decoder::default();
        let set = decode_set_file(&mut decoder, &document);
        match decoder.finish(&Span::new(file, 0..text.len())).into_iter().next() {
            Some(error) => {
                assert!(!error.help.is_empty(), "no remedy: {}", error.message);
                let (span, label) = error.primary.expect("an error in a file has a place");
                Err([error.message, label, text[span.range].to_owned()])
            }
            None => Ok(set.expect("no error")),
        }
    }

    /// The choices that a text makes, or its first error.
    fn decoded(text: &str) -> Result<(Estimator, Rejection), [String; 3]> {
        decoded_file(text).map(|set| {
            let kernel = set.estimator.value().copied().unwrap_or_default();
            (kernel, set.rejection.value().copied().unwrap_or_default())
        })
    }

    fn kernel(text: &str) -> Result<Estimator, [String; 3]> {
        decoded(&format!("MaterialSet(kernel: {text})")).map(|(kernel, _)| kernel)
    }

    #[test]
    fn every_kernel_can_be_written() {
        for (text, expected) in [
            ("ImportanceSampled(taps: 33)", Estimator::ImportanceSampled { taps: 33 }),
            ("ImportanceSampled", Estimator::ImportanceSampled { taps: 17 }),
            ("Separable(taps: 11, rotated: true)", Estimator::Separable { taps: 11, rotated: true }),
            ("Separable(rotated: false)", Estimator::Separable { taps: 17, rotated: false }),
            ("Separable()", Estimator::Separable { taps: 17, rotated: false }),
            ("Interleaved(taps: 64)", Estimator::Interleaved { taps: 64 }),
            ("Interleaved", Estimator::default()),
            ("Dense", Estimator::Dense),
            ("Dense()", Estimator::Dense),
        ] {
            assert_eq!(kernel(text), Ok(expected), "{text}");
        }
        // Whatever kernel there is can be written, and has its usual number of taps.
        for estimator in Estimator::ALL {
            let rotated = if estimator.is_rotated() { "(rotated: true)" } else { "" };
            assert_eq!(kernel(&format!("{}{rotated}", estimator.name())), Ok(estimator));
        }
    }

    #[test]
    fn what_is_not_written_has_its_default() {
        let defaults = Ok((Estimator::default(), Rejection::default()));
        for text in ["MaterialSet", "MaterialSet()", "MaterialSet(version: 1)", "MaterialSet(rejection: ())"]
        {
            assert_eq!(decoded(text), defaults, "{text}");
        }
        let some = decoded("MaterialSet(rejection: (by_normal: true, rejected: ReturnedToCentre))");
        let rejected = Rejected::ReturnedToCentre;
        let expected = Rejection { by_normal: true, rejected, ..Rejection::default() };
        assert_eq!(some, Ok((Estimator::default(), expected)));
        let none = decoded("MaterialSet(rejection: (by_material: false, by_distance: false))");
        let expected = Rejection { by_material: false, by_distance: false, ..Rejection::default() };
        assert_eq!(none, Ok((Estimator::default(), expected)));
    }

    #[test]
    fn taps_out_of_range_are_refused_where_they_stand() {
        for (text, label, place) in [
            ("Interleaved(taps: 0)", "expected a whole number from 1 to 64", "0"),
            ("Interleaved(taps: 65)", "expected a whole number from 1 to 64", "65"),
            ("Interleaved(taps: 2.5)", "expected a whole number from 1 to 64", "2.5"),
            ("Interleaved(taps: -4)", "expected a whole number from 1 to 64", "-4"),
            ("Interleaved(taps: 99999999999)", "expected a whole number from 1 to 64", "99999999999"),
            ("ImportanceSampled(taps: 4097)", "expected a whole number from 1 to 4096", "4097"),
            ("Separable(taps: 16)", "expected an odd number from 3 to 65", "16"),
            ("Separable(taps: 1)", "expected an odd number from 3 to 65", "1"),
            ("Separable(taps: 67)", "expected an odd number from 3 to 65", "67"),
        ] {
            let [_, found, at] = kernel(text).expect_err(text);
            assert_eq!((found.as_str(), at.as_str()), (label, place), "{text}");
        }
    }

    #[test]
    fn what_is_no_kernel_is_refused() {
        for (text, message) in [
            ("Interleavd(taps: 4)", "unknown kernel `Interleavd`"),
            ("Gaussian", "unknown kernel `Gaussian`"),
            ("\"Dense\"", "`kernel` has the wrong type"),
            ("4", "`kernel` has the wrong type"),
            ("Interleaved(4)", "the fields of `Interleaved` have no names"),
            ("Interleaved(tap: 4)", "unknown field `tap`"),
            ("Interleaved(rotated: true)", "unknown field `rotated`"),
            ("Dense(taps: 4)", "unknown field `taps`"),
            ("Separable(rotated: 1)", "`rotated` has the wrong type"),
            ("Separable(taps: \"17\")", "`taps` has the wrong type"),
        ] {
            let [found, _, _] = kernel(text).expect_err(text);
            assert_eq!(found, message, "{text}");
        }
    }

    #[test]
    fn what_is_no_rejection_is_refused() {
        for (text, message) in [
            ("true", "`rejection` has the wrong type"),
            ("(by_material: Yes)", "`by_material` has the wrong type"),
            ("(by_depth: true)", "unknown field `by_depth`"),
            ("(rejected: Renormalised)", "unknown policy `Renormalised`"),
        ] {
            let [found, _, _] = decoded(&format!("MaterialSet(rejection: {text})")).expect_err(text);
            assert_eq!(found, message, "{text}");
        }
    }

    #[test]
    fn a_file_from_the_future_is_not_misread() {
        let [message, _, _] = decoded("MaterialSet(version: 2, kernel: Unheard)").expect_err("version 2");
        assert_eq!(message, "this file is written for schema version 2");
    }
}
