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
        Shape::Text(text) if words.contains(&text.as_str()) => {
            let help = format!("write it without quotes: `{field}: {text}`");
            decoder.wrong_type(node, field, "a word", help);
            return None;
        }
        _ => {
            let help = format!("the choices are {}", list(words.iter().copied()));
            decoder.wrong_type(node, field, "a word", help);
            return None;
        }
    };
    let found = words.iter().copied().find(|word| *word == name.text);
    if found.is_none() {
        unknown_word(decoder, &name, field, words);
    }
    found
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
