//! Models as profile files.

use crate::failure::Failure;
use std::fmt::Write as _;
use subsurface_profile::{Length, Model};

/// The text of a profile file with `docs` above the model, each line a `///` line.
pub(super) fn profile_file(model: &Model, docs: &[String]) -> Result<String, Failure> {
    let mut text = String::new();
    for line in docs {
        let _ = writeln!(text, "{}", format!("/// {line}").trim_end());
    }
    text.push_str(&expression(model)?);
    text.push('\n');
    Ok(text)
}

fn expression(model: &Model) -> Result<String, Failure> {
    let parameters: Vec<(String, f64)> =
        model.parameters().into_iter().map(|parameter| (parameter.name, parameter.value)).collect();
    Ok(match model {
        Model::Burley(burley) => {
            let length = match burley.length {
                Length::MeanFreePath => "MeanFreePath",
                Length::DiffuseMeanFreePath => "DiffuseMeanFreePath",
            };
            let mut fit = format!("Burley(parametrization: Fit(\n    length: {length},\n");
            for (name, value) in &parameters {
                let _ = writeln!(fit, "    {}: {value:?},", name.trim_start_matches("shape."));
            }
            fit + "))"
        }
        Model::GaussianSum(sum) => {
            let mut text = String::from("GaussianSum([\n");
            for term in &sum.terms {
                let [red, green, blue] = term.weight;
                let weight = if red == green && green == blue {
                    format!("{red:?}")
                } else {
                    format!("({red:?}, {green:?}, {blue:?})")
                };
                let _ = writeln!(text, "    (variance_mm2: {:?}, weight: {weight}),", term.variance_mm2);
            }
            text + "])"
        }
        Model::Polynomial(_) => structured("Polynomial", &parameters),
        Model::ExponentialDipole(_) => structured("ExponentialDipole", &parameters),
        Model::TwoExponentialDipole(_) => structured("TwoExponentialDipole", &parameters),
        other => {
            return Err(Failure::new(
                format!("this program cannot write the model as a profile file: {other:?}"),
                "choose another family",
            ));
        }
    })
}

/// A model whose fields are groups `name.field` or lists `name[index]`.
fn structured(head: &str, parameters: &[(String, f64)]) -> String {
    let mut text = format!("{head}(\n");
    let key = |name: &str| name.split(['.', '[']).next().unwrap_or(name).to_owned();
    for group in parameters.chunk_by(|a, b| key(&a.0) == key(&b.0)) {
        let field = |(name, value): &(String, f64)| match name.split_once('.') {
            Some((_, field)) => format!("{field}: {value:?}"),
            None => format!("{value:?}"),
        };
        let fields: Vec<String> = group.iter().map(field).collect();
        let fields = fields.join(", ");
        let name = &group[0].0;
        // A number of its own is named by its field alone.
        let value = if name.contains(['.', '[']) { format!("({fields})") } else { fields };
        let _ = writeln!(text, "    {}: {value},", key(name));
    }
    text + ")"
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use subsurface_codegen::load_profile_file;

    #[test]
    fn every_published_model_is_read_back_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("written.ron");
        for stem in Model::PUBLISHED {
            let model = Model::published(stem).unwrap();
            let text =
                profile_file(&model, &["Written by a test.".into(), String::new(), stem.into()]).unwrap();
            std::fs::write(&file, &text).unwrap();
            let loaded = load_profile_file(&file);
            assert!(loaded.report.is_empty(), "{}\n{text}", loaded.report.render(false));
            assert_eq!(loaded.profile.unwrap().model, model, "{text}");
        }
    }
}
