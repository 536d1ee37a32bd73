//! The error that a set allows its kernel.

use crate::diagnostics::Diagnostic;
use crate::quality_request::QualityRequest;
use crate::schema::body::Body;
use crate::schema::choice::{choice, no_word, unknown_word};
use crate::schema::decoder::{Decoder, Fields, Given};
use crate::suggestion::shortened;
use crate::syntax::{Node, Shape};
use subsurface_kernel::Estimator;
use subsurface_quality::{Device, Quality, Tier};

const WORDS: [&str; 5] = ["MaxError", "Low", "Medium", "High", "Ultra"];

/// Decodes `quality` among the fields of a set, whose `kernel` is decoded already.
pub(super) fn decode_quality(
    decoder: &mut Decoder,
    fields: &Fields<'_>,
    estimator: &Given<Estimator>,
) -> Given<QualityRequest> {
    let device = decode_device(decoder, fields);
    fields.optional("quality", |node| {
        let quality = decode_value(decoder, node);
        let agrees = fields.get("kernel").is_none_or(|entry| leaves_a_choice(decoder, &entry.value, node));
        if estimator.is_bad() || !agrees {
            return None;
        }
        let estimator = estimator.value().copied();
        Some(QualityRequest { quality: quality?, estimator, device: device?, span: node.span() })
    })
}

/// What a kernel is to be cheap on, where it is searched by its error.
fn decode_device(decoder: &mut Decoder, fields: &Fields<'_>) -> Option<Device> {
    let Some(entry) = fields.get("device") else { return Some(Device::default()) };
    let name = choice(decoder, &entry.value, "device", &Device::ALL.map(Device::name))?;
    if fields.get("quality").is_none() {
        decoder.report(
            Diagnostic::warning("`device` without `quality`")
                .label(
                    entry.key.span.clone(),
                    "says on what a kernel that is searched by its error is to be cheap",
                )
                .help("remove it, or ask for an error in place of taps: `quality: MaxError(0.02)`"),
        );
    }
    Device::ALL.into_iter().find(|device| device.name() == name)
}

fn decode_value(decoder: &mut Decoder, node: &Node<'_>) -> Option<Quality> {
    let Some((name, body)) = Body::of(node) else {
        let help = match node.shape() {
            Shape::Number(_) => format!("write `quality: MaxError({})`", shortened(node.text())),
            _ => "write `quality: MaxError(0.02)`, or one of `Low`, `Medium`, `High` and `Ultra`".to_owned(),
        };
        no_word(decoder, node, "quality", "an error or a tier", &WORDS, help);
        return None;
    };
    let tier = Tier::ALL.into_iter().find(|tier| tier.name() == name.text);
    match (tier, body) {
        (Some(tier), Body::Fields(entries)) if entries.is_empty() => Some(Quality::Tier(tier)),
        (Some(tier), Body::Values(values)) if values.is_empty() => Some(Quality::Tier(tier)),
        (Some(tier), _) => {
            decoder.report(
                Diagnostic::error(format!("the tier `{}` takes no value", tier.name()))
                    .label(node.span(), "expected the name alone")
                    .help(format!("write `quality: {}`, which is an error of {}", tier.name(), tier.target()))
                    .help("or `quality: MaxError(…)` for an error of your own"),
            );
            None
        }
        (None, Body::Values(values)) if name.text == "MaxError" && values.len() == 1 => {
            decode_error(decoder, &values[0])
        }
        (None, _) if name.text == "MaxError" => {
            decoder.report(
                Diagnostic::error("`MaxError` takes one number")
                    .label(name.span.clone(), "expected `(…)` with one number after it")
                    .help("for example `MaxError(0.02)`"),
            );
            None
        }
        (None, _) => {
            unknown_word(decoder, &name, "quality", &WORDS);
            None
        }
    }
}

fn decode_error(decoder: &mut Decoder, node: &Node<'_>) -> Option<Quality> {
    const MEANING: &str = "give the root mean square error as a fraction of the white level, such as 0.02";
    let Shape::Number(error) = node.shape() else {
        decoder.wrong_type(node, "MaxError", "a number", MEANING);
        return None;
    };
    if error > 0.0 && error < 1.0 {
        return Some(Quality::MaxError(error));
    }
    decoder.report(
        Diagnostic::error(format!("an error of {}", shortened(node.text())))
            .label(node.span(), "expected a number above 0 and below 1")
            .help(MEANING),
    );
    None
}

/// Whether a kernel leaves something to choose by its error; reports what does not.
fn leaves_a_choice(decoder: &mut Decoder, kernel: &Node<'_>, quality: &Node<'_>) -> bool {
    let Some((name, body)) = Body::of(kernel) else { return false };
    let (place, message, label, first) = match &body {
        _ if name.text == "Dense" => {
            let label = "reads every pixel in reach: its error is 0";
            (name.span.clone(), "`Dense` has nothing to choose by its error", label, "name another kernel")
        }
        Body::Fields(entries) => {
            let Some(taps) = entries.iter().find(|entry| entry.key.text == "taps") else { return true };
            let message = "a set asks for taps and for an error";
            (taps.key.span.clone(), message, "the error says how many taps there are", "remove `taps`")
        }
        Body::Values(_) => return true,
    };
    decoder.report(
        Diagnostic::error(message)
            .label(place, label)
            .secondary(quality.span(), "the error is asked for here")
            .help(format!("choose one: {first}, or remove `quality`")),
    );
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::set_file::tests::decoded_file;

    /// The request of a text, or its first error: message, and the text that it points at.
    fn decoded(text: &str) -> Result<Option<(Quality, Option<Estimator>)>, [String; 2]> {
        match decoded_file(text) {
            Ok(set) => Ok(set.quality.value().map(|request| (request.quality, request.estimator))),
            Err([message, _, place]) => Err([message, place]),
        }
    }

    #[test]
    fn errors_and_tiers_can_be_asked_for_of_all_kernels_or_of_one() {
        let interleaved = Some(Estimator::default());
        let rotated = Some(Estimator::Separable { taps: 17, rotated: true });
        for (text, expected) in [
            ("", None),
            ("quality: MaxError(0.01)", Some((Quality::MaxError(0.01), None))),
            ("quality: Low", Some((Quality::Tier(Tier::Low), None))),
            ("quality: Ultra()", Some((Quality::Tier(Tier::Ultra), None))),
            ("kernel: Interleaved, quality: High", Some((Quality::Tier(Tier::High), interleaved))),
            (
                "kernel: Separable(rotated: true), quality: Medium",
                Some((Quality::Tier(Tier::Medium), rotated)),
            ),
        ] {
            assert_eq!(decoded(&format!("MaterialSet({text})")), Ok(expected), "{text}");
        }
    }

    #[test]
    fn a_device_says_on_what_a_kernel_is_to_be_cheap() {
        for (text, expected) in [
            ("quality: Low", Device::Rdna),
            ("quality: Low, device: Rdna", Device::Rdna),
            ("device: Gcn, quality: Low", Device::Gcn),
            ("quality: Low, device: Software", Device::Software),
        ] {
            let set = decoded_file(&format!("MaterialSet({text})")).expect(text);
            assert_eq!(set.quality.value().map(|request| request.device), Some(expected), "{text}");
        }
        for (text, message, place) in [
            ("quality: Low, device: rdna", "unknown device `rdna`", "rdna"),
            ("quality: Low, device: 3", "`device` has the wrong type", "3"),
            ("device: Gcn", "`device` without `quality`", "device"),
        ] {
            let expected = Err([message.to_owned(), place.to_owned()]);
            assert_eq!(decoded(&format!("MaterialSet({text})")), expected, "{text}");
        }
    }

    #[test]
    fn what_is_no_quality_is_refused_where_it_stands() {
        for (text, message, place) in [
            ("quality: MaxEror(0.01)", "unknown quality `MaxEror`", "MaxEror"),
            ("quality: low", "unknown quality `low`", "low"),
            ("quality: \"Low\"", "`quality` has the wrong type", "\"Low\""),
            ("quality: 0.01", "`quality` has the wrong type", "0.01"),
            ("quality: MaxError", "`MaxError` takes one number", "MaxError"),
            ("quality: MaxError(error: 0.01)", "`MaxError` takes one number", "MaxError"),
            ("quality: MaxError(0)", "an error of 0", "0"),
            ("quality: MaxError(-0.5)", "an error of -0.5", "-0.5"),
            ("quality: MaxError(1)", "an error of 1", "1"),
            ("quality: MaxError(NaN)", "an error of NaN", "NaN"),
            ("quality: MaxError(Low)", "`MaxError` has the wrong type", "Low"),
            ("quality: High(0.01)", "the tier `High` takes no value", "High(0.01)"),
            ("kernel: Interleaved(taps: 4), quality: Low", "a set asks for taps and for an error", "taps"),
            ("kernel: Dense, quality: Low", "`Dense` has nothing to choose by its error", "Dense"),
        ] {
            let expected = Err([message.to_owned(), place.to_owned()]);
            assert_eq!(decoded(&format!("MaterialSet({text})")), expected, "{text}");
        }
    }
}
