//! Models as profile files: the texts that the decoder of `schema/model.rs` reads back as the same numbers.

use std::fmt::Write as _;

use subsurface_profile::Model;
use subsurface_profile::description::{Contents, Field, Notation, Values};

use crate::schema::length_word;

/// The text of a profile file with `docs` above the model, each line a `///` line; `None` for a model whose numbers
/// stand in a file of their own.
pub fn profile_file_text(model: &Model, docs: &[String]) -> Option<String> {
    let mut text = String::new();
    for line in docs {
        let _ = writeln!(text, "{}", format!("/// {line}").trim_end());
    }
    text.push_str(&expression(model, "")?);
    text.push('\n');
    Some(text)
}

/// The model with all its coefficients; lines after the first begin with `indent`.
fn expression(model: &Model, indent: &str) -> Option<String> {
    let description = model.description();
    let name = description.name;
    match description.notation {
        Notation::Fields { key, own } => {
            let mut lines = String::new();
            if description.lengths.len() > 1 {
                let _ = writeln!(lines, "{indent}    length: {},", length_word(model.length()));
            }
            for (name, value) in entries(model, own.is_empty()) {
                let _ = writeln!(lines, "{indent}    {name}: {value},");
            }
            Some(if own.is_empty() {
                format!("{name}(\n{lines}{indent})")
            } else {
                format!("{name}({key}: {own}(\n{lines}{indent}))")
            })
        }
        Notation::Terms { .. } => {
            let fields = model.kind().fields().len();
            let mut lines = String::new();
            for term in numbers(model).chunks(fields) {
                let term: Vec<String> =
                    term.iter().map(|(field, value)| format!("{}: {value}", field.name())).collect();
                let _ = writeln!(lines, "{indent}    ({}),", term.join(", "));
            }
            Some(format!("{name}([\n{lines}{indent}])"))
        }
        Notation::Table => None,
        Notation::Parts => {
            let Contents::Parts(mixture) = model.contents() else { return None };
            let deeper = format!("{indent}    ");
            let mut lines = String::new();
            for part in &mixture.parts {
                let model = expression(&part.model, &deeper)?;
                let _ = writeln!(lines, "{deeper}(weight: {:?}, model: {model}),", part.weight);
            }
            Some(format!("{name}([\n{lines}{indent}])"))
        }
    }
}

/// What stands in a model's brackets: fields by name, with those of a group together if they are `grouped`.
fn entries(model: &Model, grouped: bool) -> Vec<(&'static str, String)> {
    let numbers = numbers(model);
    let together = |a: &Number, b: &Number| grouped && a.0.group().is_some() && a.0.group() == b.0.group();
    let entry = |entry: &[Number]| match (entry, entry[0].0.group()) {
        (_, Some(group)) if grouped => {
            let fields: Vec<String> =
                entry.iter().map(|(field, value)| format!("{}: {value}", field.name())).collect();
            (group, format!("({})", fields.join(", ")))
        }
        _ => (entry[0].0.name(), entry[0].1.clone()),
    };
    numbers.chunk_by(together).map(entry).collect()
}

/// A field, and its numbers as a file writes them.
type Number = (&'static Field, String);

/// All fields. `{:?}` of an `f64` is the shortest text that reads back as the same number.
fn numbers(model: &Model) -> Vec<Number> {
    let mut numbers = Vec::new();
    model.clone().visit(&mut |slot| {
        let text = match (slot.field.values, &*slot.values) {
            (Values::One, values) => format!("{:?}", values[0]),
            (Values::Channels, [red, green, blue]) if red == green && green == blue => format!("{red:?}"),
            (_, values) => {
                let values: Vec<String> = values.iter().map(|value| format!("{value:?}")).collect();
                format!("({})", values.join(", "))
            }
        };
        numbers.push((slot.field, text));
    });
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load_memory;

    #[test]
    fn every_published_model_is_read_back_as_it_was() {
        for stem in Model::PUBLISHED {
            let model = Model::published(stem).expect("its own list");
            let docs = ["Written by a test.".to_owned(), String::new(), stem.to_owned()];
            let text = profile_file_text(&model, &docs).expect("a model of coefficients");
            let material =
                "Material(profile: \"mine\", mean_free_path_mm: (1, 1, 1), surface_albedo: (0.5, 0.5, 0.5))";
            // A length of the other kind is an error of the material, which only one of the two lengths makes.
            let material = match model.length() {
                subsurface_profile::Length::MeanFreePath => material.to_owned(),
                subsurface_profile::Length::DiffuseMeanFreePath => {
                    material.replace("mean_free_path_mm", "diffuse_mean_free_path_mm")
                }
            };
            let loaded = load_memory([("a.ron", material.as_str()), ("profiles/mine.ron", text.as_str())]);
            assert!(!loaded.report.has_errors(), "{}\n{text}", loaded.report);
            let set = loaded.set.expect("no error");
            assert_eq!(set.materials[0].profile.model, model, "{text}");
            assert_eq!(set.materials[0].profile.docs, docs);
        }
    }
}
