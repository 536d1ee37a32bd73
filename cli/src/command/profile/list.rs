//! `subsurface profile list`.

use crate::command::output;
use crate::failure::Failure;
use crate::table::{Align, Table};
use clap::Args;
use std::fmt::Write as _;
use subsurface_codegen::profile_file_text;
use subsurface_profile::description::{Description, Field, Notation, Values};
use subsurface_profile::{Length, Model, ModelKind, PublishedSet};

/// Arguments of `profile list`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface profile list
  subsurface profile list --coefficients")]
pub struct ListArguments {
    /// Print each model in place of its published sets: equation, how a file writes it, and its coefficients with unit,
    /// range and meaning. Markdown.
    #[arg(long)]
    pub coefficients: bool,
    /// Print the table as Markdown.
    #[arg(long)]
    pub markdown: bool,
}

/// Runs the command.
pub(super) fn run(arguments: &ListArguments) -> Result<(), Failure> {
    let text = match arguments {
        ListArguments { coefficients: true, .. } => sections(),
        ListArguments { markdown: true, .. } => markdown(),
        _ => table(),
    };
    output::print(&text)
}

/// The published sets of all models.
fn sets() -> impl Iterator<Item = PublishedSet> {
    ModelKind::ALL.iter().flat_map(|kind| kind.published())
}

/// Which length scales a set's profile.
fn length(model: &Model) -> String {
    if !model.dependence().on_length() {
        return "its own, in mm".to_owned();
    }
    model.length().to_string()
}

fn table() -> String {
    let heads = ["profile", "model", "length", "source"].map(|head| (head, Align::Left));
    let mut table = Table::new(heads);
    for set in sets() {
        let caption = set.kind.description().caption;
        table.row([set.stem.to_owned(), caption.to_owned(), length(&set.model), set.source.to_owned()]);
    }
    table.to_string()
}

fn markdown() -> String {
    let mut text = String::from("| `profile:` | Model | Length | Source |\n|---|---|---|---|\n");
    for set in sets() {
        let (caption, length) = (set.kind.description().caption, length(&set.model));
        let _ = writeln!(text, "| `\"{}\"` | {caption} | {length} | {} |", set.stem, set.source);
    }
    text
}

/// A section for each model.
fn sections() -> String {
    let sections: Vec<String> = ModelKind::ALL.iter().map(|kind| section(*kind)).collect();
    sections.join("\n")
}

fn section(kind: ModelKind) -> String {
    let Description { name, equation, notes, .. } = *kind.description();
    let mut text =
        format!("### `{name}`\n\n{}.\n\n```ron\n{}```\n", equation.trim_end_matches('.'), examples(kind));
    let fields = kind.fields();
    if !fields.is_empty() {
        text.push_str("\n| Field | Symbol | Unit | Range | Meaning |\n|---|---|---|---|---|\n");
    }
    for field in fields {
        let Field { path, symbol, about, quantity, .. } = field;
        let (unit, range) = (quantity.unit, quantity.bounds.words());
        let name = if within_a_word(kind) { field.name() } else { path };
        let _ =
            writeln!(text, "| `{name}` | {symbol} | {unit} | {range} | {about}{} |", numbers(kind, field));
    }
    if !notes.is_empty() {
        let _ = write!(text, "\n{notes}\n");
    }
    text
}

/// Whether the fields stand within a word of their own, and so need no group.
fn within_a_word(kind: ModelKind) -> bool {
    matches!(kind.description().notation, Notation::Fields { own, .. } if !own.is_empty())
}

/// How many numbers a field holds.
fn numbers(kind: ModelKind, field: &Field) -> String {
    match field.values {
        Values::One => String::new(),
        Values::Channels => "; (red, green, blue), or one number for all three".to_owned(),
        Values::Powers(count) => {
            let variable = kind.description().variable;
            let powers = ["1".to_owned(), variable.symbol.to_owned()];
            let higher = ["²", "³"].map(|power| format!("{}{power}", variable.symbol));
            let powers: Vec<String> = powers.into_iter().chain(higher).take(count).collect();
            let definition = match variable.definition {
                "" => String::new(),
                definition => format!("; {definition}"),
            };
            format!("; coefficients of {}{definition}", powers.join(", "))
        }
    }
}

/// How a file writes the model: by the word of a published set, and written out.
fn examples(kind: ModelKind) -> String {
    let Description { notation, example, lengths, .. } = *kind.description();
    let mut text = String::new();
    let sets = kind.published();
    let words: Vec<&str> = sets.iter().skip(1).map(|set| set.word).filter(|word| !word.is_empty()).collect();
    match (notation, words.as_slice()) {
        (Notation::Fields { .. }, []) | (Notation::Terms { .. }, _) => {}
        (_, []) => {
            let _ = writeln!(text, "{example}");
        }
        (_, words) => {
            let _ = writeln!(text, "{example} // or {}", words.join(", "));
        }
    }
    if let Some(written) = sets.first().and_then(|set| profile_file_text(&set.model, &[])) {
        let other = lengths.get(1).map_or(String::new(), |length| {
            let word = match length {
                Length::MeanFreePath => "MeanFreePath",
                Length::DiffuseMeanFreePath => "DiffuseMeanFreePath",
            };
            format!(" // or {word}")
        });
        for line in written.lines() {
            let end = if line.trim_start().starts_with("length:") { other.as_str() } else { "" };
            let _ = writeln!(text, "{line}{end}");
        }
    }
    text
}
