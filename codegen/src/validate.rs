//! Validation by naga, with errors that point back at the material file that caused them.

use naga::front::wgsl::{Frontend, Options};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use crate::compose::{GLUE, Linked};
use crate::diagnostics::Diagnostic;
use crate::report::Report;
use crate::source::Span;

/// What plain WebGPU offers without optional features.
const WEBGPU: Capabilities = Capabilities::CUBE_ARRAY_TEXTURES
    .union(Capabilities::MULTISAMPLED_SHADING)
    .union(Capabilities::SHADER_FLOAT16_IN_FLOAT32);

/// A module that naga accepts.
#[derive(Debug)]
pub(crate) struct Validated {
    pub(crate) module: naga::Module,
    pub(crate) info: ModuleInfo,
}

/// Parses and validates the linked text.
///
/// `displayed` is the name under which the WGSL stands in an error message.
pub(crate) fn validate(linked: &Linked, displayed: &str, report: &mut Report) -> Option<Validated> {
    let options = Options { parse_doc_comments: false, capabilities: WEBGPU };
    let module = match Frontend::new_with_options(options).parse(&linked.text) {
        Ok(module) => module,
        Err(error) => {
            let labels =
                error.labels().filter_map(|(span, label)| Some((span.to_range()?, label.to_owned())));
            let notes = error.notes().map(str::to_owned);
            push(report, linked, displayed, error.message(), labels.collect(), notes.collect());
            return None;
        }
    };
    match Validator::new(ValidationFlags::all(), WEBGPU).validate(&module) {
        Ok(info) => Some(Validated { module, info }),
        Err(error) => {
            let labels = error.spans().filter_map(|(span, label)| Some((span.to_range()?, label.clone())));
            let labels = labels.collect();
            let mut causes = Vec::new();
            let mut cause = std::error::Error::source(error.as_inner());
            while let Some(inner) = cause {
                causes.push(inner.to_string());
                cause = inner.source();
            }
            push(report, linked, displayed, &error.as_inner().to_string(), labels, causes);
            None
        }
    }
}

/// Reports an error of naga's: at the RON that spelled the text where there is one, else at the WGSL alone.
fn push(
    report: &mut Report,
    linked: &Linked,
    displayed: &str,
    message: &str,
    labels: Vec<(std::ops::Range<usize>, String)>,
    notes: Vec<String>,
) {
    let file = report.sources_mut().add(displayed, linked.text.as_str());
    let mut diagnostic = Diagnostic::error(format!("the generated WGSL is not valid: {message}"));
    for note in notes {
        diagnostic = diagnostic.help(note);
    }
    let origin = labels.iter().find_map(|(range, _)| linked.origin(range)).cloned();
    if let Some(origin) = &origin {
        diagnostic = diagnostic
            .label(origin.clone(), "this became the WGSL below")
            .help("change this value; the WGSL is generated from it");
    } else {
        // What is no module of the house is a pass of the caller's own.
        let module = labels.first().and_then(|(range, _)| linked.module_at(range.start));
        let own = module.filter(|name| subsurface_shaders::modules().all(|house| house.name != *name));
        diagnostic = diagnostic.help(match own.filter(|name| *name != GLUE) {
            Some(pass) => format!("the error is in the pass `{pass}`, which the caller of the compiler gave"),
            None => "no material file is to blame: please report this as a defect of the compiler".to_owned(),
        });
    }
    for (range, label) in labels {
        let span = Span::new(file, range);
        diagnostic = match (&diagnostic.primary, &origin) {
            (None, None) => diagnostic.label(span, label),
            _ => diagnostic.secondary(span, label),
        };
    }
    report.push(diagnostic);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compose::{Files, Glue, link};

    fn linked(text: &str, spelled: &str, span: Span) -> Linked {
        let at = text.find(spelled).expect("the text spells the value");
        let glue = Glue {
            text: text.to_owned(),
            origins: vec![(at..at + spelled.len(), span)],
            ..Default::default()
        };
        link(Files::default(), &glue, &["main"], "// head\n").expect("links")
    }

    #[test]
    fn an_error_in_the_wgsl_points_at_the_ron_that_caused_it() {
        let mut report = Report::default();
        let ron = "GaussianSum([(variance_mm2: 1e60, weight: 1.0)])";
        let file = report.sources_mut().add("materials/profiles/wide.ron", ron);
        let at = ron.find("1e60").expect("it is there");
        let text = "@compute @workgroup_size(1)\nfn main() {\n    let term = vec2f(1e60, 1.0);\n}\n";
        let linked = linked(text, "1e60", Span::new(file, at..at + 4));
        assert!(validate(&linked, "subsurface.wgsl", &mut report).is_none());
        let text = report.render(false);
        assert!(text.contains("materials/profiles/wide.ron:1:29"), "{text}");
        assert!(text.contains("subsurface.wgsl:"), "{text}");
    }

    #[test]
    fn a_type_error_outside_any_value_is_a_defect_of_ours() {
        let mut report = Report::default();
        let file = report.sources_mut().add("m.ron", "x");
        let text = "@compute @workgroup_size(1)\nfn main() {\n    let x: u32 = 1.5;\n    let y = 2;\n}\n";
        let linked = linked(text, "2;", Span::new(file, 0..1));
        assert!(validate(&linked, "subsurface.wgsl", &mut report).is_none());
        let text = report.render(false);
        assert!(text.contains("defect of the compiler") && text.contains("subsurface.wgsl:7"), "{text}");
    }

    #[test]
    fn what_plain_webgpu_lacks_is_refused() {
        let mut report = Report::default();
        let glue = Glue {
            text: "@compute @workgroup_size(1)\nfn main() {\n    let x: f64 = 1.5lf;\n}\n".to_owned(),
            ..Default::default()
        };
        let linked = link(Files::default(), &glue, &["main"], "").expect("links");
        assert!(validate(&linked, "subsurface.wgsl", &mut report).is_none());
    }
}
