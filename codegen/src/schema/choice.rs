//! Fields that take one of a few words.

use crate::diagnostics::Diagnostic;
use crate::schema::decoder::Decoder;
use crate::suggestion::{closest, list, shortened};
use crate::syntax::{Name, Node, Shape};

/// One of a few words.
pub(super) fn choice<'n>(
    decoder: &mut Decoder,
    node: &Node<'n>,
    field: &str,
    words: &[&'static str],
) -> Option<&'static str> {
    let name = match node.shape() {
        Shape::Name(name) => name,
        _ => {
            let help = format!("the choices are {}", list(words.iter().copied()));
            no_word(decoder, node, field, "a word", words, help);
            return None;
        }
    };
    let found = words.iter().copied().find(|word| *word == name.text);
    if found.is_none() {
        unknown_word(decoder, &name, field, words);
    }
    found
}

/// Reports a value that is no word; `help` says what to write, unless it is one of `words` in quotes.
pub(super) fn no_word(
    decoder: &mut Decoder,
    node: &Node<'_>,
    field: &str,
    expected: &str,
    words: &[&'static str],
    help: String,
) {
    let help = match node.shape() {
        Shape::Text(text) if words.contains(&text.as_str()) => {
            format!("write it without quotes: `{field}: {text}`")
        }
        _ => help,
    };
    decoder.wrong_type(node, field, expected, help);
}

/// Reports a name that is none of `words`.
pub(super) fn unknown_word(decoder: &mut Decoder, name: &Name<'_>, field: &str, words: &[&'static str]) {
    let mut diagnostic = Diagnostic::error(format!("unknown {field} `{}`", shortened(name.text)))
        .label(name.span.clone(), "not one of the choices");
    if let Some(meant) = closest(name.text, words.iter().copied()) {
        diagnostic = diagnostic.help(format!("did you mean `{meant}`?"));
    }
    decoder.report(diagnostic.help(format!("the choices are {}", list(words.iter().copied()))));
}
