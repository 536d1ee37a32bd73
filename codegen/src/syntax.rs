//! RON with spans: values as shapes, each with the place where it is written.
//!
//! `ron` is the only parser here; it has no spanned values, but it can hand out a borrowed [`RawValue`], and where a
//! borrowed text lies inside the file's text is where it is written. So a file is parsed level by level: ron splits a
//! struct into keys and raw values, and each value is parsed on its own when its turn comes. A wrong value then
//! spoils no other, and all errors of a file are found in one run.

use std::fmt;

use ron::de::{Error as RonError, Position as RonPosition, SpannedError};
use ron::value::RawValue;
use serde::de::{Deserialize, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::diagnostics::Diagnostic;
use crate::source::{FileId, Span};

/// A file's text, to compute spans in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source<'a> {
    pub(crate) file: FileId,
    pub(crate) text: &'a str,
}

impl<'a> Source<'a> {
    /// Where `part` lies; `part` must be borrowed from the file's text.
    fn span(self, part: &str) -> Span {
        let start = (part.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
        debug_assert!(start + part.len() <= self.text.len(), "the text is not part of the file");
        Span::new(self.file, start..start + part.len())
    }

    fn node(self, raw: &'a RawValue) -> Node<'a> {
        Node { source: self, text: raw.trim().get_ron() }
    }
}

/// A value: its text without blanks and comments around it. The text is known to be valid RON.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node<'a> {
    source: Source<'a>,
    text: &'a str,
}

/// An identifier before brackets, or alone.
#[derive(Clone, Debug)]
pub(crate) struct Name<'a> {
    pub(crate) text: &'a str,
    pub(crate) span: Span,
}

/// `key: value`.
#[derive(Clone, Debug)]
pub(crate) struct Entry<'a> {
    pub(crate) key: Name<'a>,
    pub(crate) value: Node<'a>,
}

/// What kind of value a node is, one level deep.
#[derive(Debug)]
pub(crate) enum Shape<'a> {
    /// `Name(key: value, …)` or `(key: value, …)`.
    Struct(Option<Name<'a>>, Vec<Entry<'a>>),
    /// `Name(value, …)`, `(value, …)` or `()`.
    Tuple(Option<Name<'a>>, Vec<Node<'a>>),
    /// `[value, …]`.
    List(Vec<Node<'a>>),
    /// `Name`.
    Name(Name<'a>),
    /// `"text"`.
    Text(String),
    /// A number that `f64` can hold; decimal numbers beyond its range are infinite, as are `inf` and `-inf`.
    Number(f64),
    /// Anything else, by what a reader calls it.
    Other(&'static str),
}

impl<'a> Node<'a> {
    /// Where the value is written.
    pub(crate) fn span(&self) -> Span {
        self.source.span(self.text)
    }

    /// The value as written.
    pub(crate) fn text(&self) -> &'a str {
        self.text
    }

    /// The value, one level deep.
    pub(crate) fn shape(&self) -> Shape<'a> {
        match self.text.chars().next() {
            Some('{') => return Shape::Other("a map"),
            Some('0'..='9' | '+' | '-' | '.') => return self.number(),
            _ if matches!(self.text, "inf" | "NaN" | "inff32" | "NaNf32" | "inff64" | "NaNf64") => {
                return self.number();
            }
            _ => {}
        }
        // The file was parsed as a whole before; an error here means a form that no field takes (a range).
        let Ok(shape) = ron::from_str::<RawShape<'a>>(self.text) else {
            return Shape::Other("another value");
        };
        let name = self.name();
        match (shape, name) {
            (RawShape::Struct(entries), name) => {
                let entry = |(key, value): (&'a str, &'a RawValue)| Entry {
                    key: Name { text: key, span: self.source.span(key) },
                    value: self.source.node(value),
                };
                Shape::Struct(name, entries.into_iter().map(entry).collect())
            }
            (RawShape::Sequence(values), name) => {
                let nodes = values.into_iter().map(|value| self.source.node(value)).collect();
                if self.text.starts_with('[') { Shape::List(nodes) } else { Shape::Tuple(name, nodes) }
            }
            (RawShape::Unit, Some(name)) if name.text.len() == self.text.len() => Shape::Name(name),
            (RawShape::Unit, name) => Shape::Tuple(name, Vec::new()),
            (RawShape::Text(text), _) => Shape::Text(text),
            (RawShape::Other(kind), _) => Shape::Other(kind),
        }
    }

    /// What a reader calls this value, for "expected …, found …".
    pub(crate) fn kind(&self) -> String {
        match self.shape() {
            Shape::Struct(Some(name), _) | Shape::Tuple(Some(name), _) => format!("`{}(…)`", name.text),
            Shape::Struct(None, _) => "named fields `(…: …)`".to_owned(),
            Shape::Tuple(None, nodes) => format!("a group of {}", count(nodes.len(), "value")),
            Shape::List(nodes) => format!("a list of {}", count(nodes.len(), "value")),
            Shape::Name(name) => format!("the name `{}`", name.text),
            Shape::Text(_) => "a text".to_owned(),
            Shape::Number(_) => "a number".to_owned(),
            Shape::Other(kind) => kind.to_owned(),
        }
    }

    /// The identifier that the value begins with, read by ron.
    pub(crate) fn name(&self) -> Option<Name<'a>> {
        let mut deserializer = ron::Deserializer::from_str(self.text).ok()?;
        let text = (&mut deserializer).deserialize_identifier(BorrowedStr).ok()?;
        Some(Name { text, span: self.source.span(text) })
    }

    fn number(&self) -> Shape<'a> {
        ron::from_str::<f64>(self.text).map_or(Shape::Other("a number in another notation"), Shape::Number)
    }
}

/// `1 value`, `2 values`.
pub(crate) fn count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

/// The value of a file, and the `///` lines above it.
#[derive(Debug)]
pub(crate) struct Document<'a> {
    pub(crate) value: Node<'a>,
    pub(crate) docs: Vec<String>,
}

/// Parses a file. An error of syntax is the only error of its file: what follows it has no known meaning.
pub(crate) fn parse<'a>(file: FileId, text: &'a str) -> Result<Document<'a>, Box<Diagnostic>> {
    // A byte order mark is no part of the text; spans stay relative to the whole file.
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    let body_start = text.len() - body.len();
    let syntax_error = |error: SpannedError| Box::new(describe(file, text, body_start, &error));

    let deserializer = ron::Deserializer::from_str(body).map_err(syntax_error)?;
    let above = &body[..body.len() - deserializer.remainder().len()];
    if !deserializer.extensions().is_empty() {
        let start = body_start + above.find("#!").unwrap_or(0);
        let end = text[start..].find(']').map_or(start, |length| start + length + 1);
        return Err(Box::new(
            Diagnostic::error("RON extensions are not used in material files")
                .label(Span::new(file, start..end), "an extension is enabled here")
                .help("remove the `#![enable(…)]` line: every value is written out in full"),
        ));
    }
    ron::from_str::<IgnoredAny>(body).map_err(syntax_error)?;
    let value = whole_value(&body[above.len()..]).map_err(syntax_error)?;
    Ok(Document { value: Node { source: Source { file, text }, text: value }, docs: doc_lines(above) })
}

/// The value that `text` begins with. Not a [`RawValue`], which must not end in a line comment as files may.
fn whole_value(text: &str) -> Result<&str, SpannedError> {
    let mut deserializer = ron::Deserializer::from_str(text)?;
    IgnoredAny::deserialize(&mut deserializer).map_err(|error| deserializer.span_error(error))?;
    let value = &text[..text.len() - deserializer.remainder().len()];
    // After a name alone, ron has looked for a bracket behind blanks and comments.
    let mut deserializer = ron::Deserializer::from_str(value)?;
    let name = (&mut deserializer).deserialize_identifier(BorrowedStr);
    let is_name = name.is_ok_and(|_| {
        ron::Deserializer::from_str(deserializer.remainder()).is_ok_and(|rest| rest.remainder().is_empty())
    });
    Ok(if is_name { &value[..value.len() - deserializer.remainder().len()] } else { value })
}

/// The run of `///` lines that ends where the value begins; plain comments and attributes between them are skipped.
fn doc_lines(above: &str) -> Vec<String> {
    let mut lines = Vec::new();
    for line in above.lines().rev().map(str::trim) {
        if let Some(doc) = line.strip_prefix("///").filter(|doc| !doc.starts_with('/')) {
            lines.push(doc.strip_prefix(' ').unwrap_or(doc).to_owned());
        } else if !(line.is_empty() || line.starts_with("//") || line.starts_with("#!")) {
            break;
        }
    }
    lines.reverse();
    lines
}

fn describe(file: FileId, text: &str, body_start: usize, error: &SpannedError) -> Diagnostic {
    let body = &text[body_start..];
    let position = match error.code {
        RonError::ExpectedStringEnd => error.span.start, // the opening quote, not the text after it
        _ => error.span.end,
    };
    let mut start = body_start + offset(body, position);
    if start >= text.len() {
        // The end of a file is often an empty line: show the last character before it.
        start = text.trim_end().char_indices().next_back().map_or(0, |(index, _)| index);
    }
    let end = text[start..].chars().next().map_or(start, |c| start + c.len_utf8());
    let (message, label, help) = match &error.code {
        RonError::ExceededRecursionLimit => (
            "the file is nested too deeply".to_owned(),
            "the 128th bracket within a bracket, at the latest".to_owned(),
            "no material or profile nests more than 6 brackets; look for one that is never closed",
        ),
        RonError::Eof => (
            "the file ends too early".to_owned(),
            "more is expected after this".to_owned(),
            "a file holds one value: close every `(`, `[` and `\"`",
        ),
        RonError::ExpectedComma => (
            "expected a comma or a closing bracket".to_owned(),
            "unexpected".to_owned(),
            "separate fields with `,` and close every bracket",
        ),
        RonError::ExpectedMapColon => (
            "expected `:` after a field's name".to_owned(),
            "unexpected".to_owned(),
            "fields are written `name: value`",
        ),
        RonError::TrailingCharacters if text[start..].starts_with('{') => (
            "fields stand in round brackets".to_owned(),
            "expected `(`".to_owned(),
            "write `Name(field: value)`, not `Name { field: value }`",
        ),
        RonError::TrailingCharacters => (
            "something follows the value of this file".to_owned(),
            "the value ends before this".to_owned(),
            "a file holds one value; look for a bracket that is closed too early",
        ),
        RonError::UnclosedBlockComment => (
            "a block comment is not closed".to_owned(),
            "the file ends inside the comment".to_owned(),
            "close every `/*` with `*/`: block comments nest",
        ),
        RonError::ExpectedStringEnd => {
            ("a text is not closed".to_owned(), "it begins here".to_owned(), "close the text with `\"`")
        }
        code => {
            let message = code.to_string();
            let mut letters = message.chars();
            let first = letters.next().map(|c| c.to_lowercase().to_string()).unwrap_or_default();
            (
                format!("invalid RON: {first}{}", letters.as_str()),
                "unexpected".to_owned(),
                "see https://github.com/ron-rs/ron/blob/master/docs/grammar.md for the syntax of RON",
            )
        }
    };
    Diagnostic::error(message).label(Span::new(file, start..end), label).help(help)
}

/// Byte offset of ron's line and column (from 1, in characters).
fn offset(text: &str, position: RonPosition) -> usize {
    let line_start = match position.line.checked_sub(2) {
        None => 0,
        Some(breaks) => text.match_indices('\n').nth(breaks).map_or(text.len(), |(index, _)| index + 1),
    };
    let column = position.col.saturating_sub(1);
    text[line_start..].char_indices().nth(column).map_or(text.len(), |(index, _)| line_start + index)
}

/// What ron's `deserialize_any` makes of a value, children unparsed.
enum RawShape<'a> {
    Struct(Vec<(&'a str, &'a RawValue)>),
    Sequence(Vec<&'a RawValue>),
    Unit,
    Text(String),
    Other(&'static str),
}

impl<'de> Deserialize<'de> for RawShape<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ShapeVisitor)
    }
}

struct ShapeVisitor;

impl<'de> Visitor<'de> for ShapeVisitor {
    type Value = RawShape<'de>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("any value")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut entries = Vec::new();
        while let Some(entry) = map.next_entry()? {
            entries.push(entry);
        }
        Ok(RawShape::Struct(entries))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Self::Value, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = sequence.next_element()? {
            values.push(value);
        }
        Ok(RawShape::Sequence(values))
    }

    fn visit_unit<E>(self) -> Result<Self::Value, E> {
        Ok(RawShape::Unit)
    }

    fn visit_str<E>(self, text: &str) -> Result<Self::Value, E> {
        Ok(RawShape::Text(text.to_owned()))
    }

    fn visit_bool<E>(self, _: bool) -> Result<Self::Value, E> {
        Ok(RawShape::Other("a truth value"))
    }

    fn visit_char<E>(self, _: char) -> Result<Self::Value, E> {
        Ok(RawShape::Other("a character"))
    }

    fn visit_bytes<E>(self, _: &[u8]) -> Result<Self::Value, E> {
        Ok(RawShape::Other("a byte string"))
    }

    fn visit_none<E>(self) -> Result<Self::Value, E> {
        Ok(RawShape::Other("an option"))
    }

    fn visit_some<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        IgnoredAny::deserialize(deserializer)?;
        Ok(RawShape::Other("an option"))
    }
}

struct BorrowedStr;

impl<'de> Visitor<'de> for BorrowedStr {
    type Value = &'de str;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an identifier")
    }

    fn visit_borrowed_str<E>(self, text: &'de str) -> Result<Self::Value, E> {
        Ok(text)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may fail by panicking")]
mod tests {
    use super::*;
    use crate::source::SourceMap;

    /// The texts of the spans of all keys and values, level by level, as the source has them.
    fn spans(text: &str) -> Vec<String> {
        fn walk(source: &str, node: &Node<'_>, out: &mut Vec<String>) {
            out.push(source[node.span().range].to_owned());
            match node.shape() {
                Shape::Struct(_, entries) => {
                    for entry in entries {
                        out.push(source[entry.key.span.range.clone()].to_owned());
                        assert_eq!(entry.key.text, &source[entry.key.span.range]);
                        walk(source, &entry.value, out);
                    }
                }
                Shape::Tuple(_, nodes) | Shape::List(nodes) => {
                    nodes.iter().for_each(|node| walk(source, node, out))
                }
                _ => {}
            }
        }
        let file = SourceMap::new().add("test.ron", text);
        let mut out = Vec::new();
        walk(text, &parse(file, text).unwrap().value, &mut out);
        out.remove(0); // the whole value
        out
    }

    #[test]
    fn spans_leave_out_comments_and_blanks() {
        let text = "// head\n/* x */ M( /* c */ a /* d */ : /* é */ 1.5 /* f */, // g\n b: Foo /* h */ , c: (1, 2 ,\n3), )\n// tail";
        assert_eq!(spans(text), ["a", "1.5", "b", "Foo", "c", "(1, 2 ,\n3)", "1", "2", "3"]);
    }

    #[test]
    fn spans_count_bytes_of_multi_byte_characters_and_crlf() {
        let text = "\u{feff}/// ä\r\nM(\r\n  ä: \"ü, (ß)\",\r\n  r#b: [é, -inf],\r\n)\r\n";
        assert_eq!(spans(text), ["ä", "\"ü, (ß)\"", "b", "[é, -inf]", "é", "-inf"]);
    }

    #[test]
    fn shapes_are_told_apart() {
        let file = SourceMap::new().add("test.ron", "");
        let kind = |text: &str| parse(file, text).unwrap().value.kind();
        assert_eq!(kind("Foo(a: 1)"), "`Foo(…)`");
        assert_eq!(kind("(a: 1)"), "named fields `(…: …)`");
        assert_eq!(kind("(1, 2)"), "a group of 2 values");
        assert_eq!(kind("()"), "a group of 0 values");
        assert_eq!(kind("Foo()"), "`Foo(…)`");
        assert_eq!(kind("[1]"), "a list of 1 value");
        assert_eq!(kind("Foo"), "the name `Foo`");
        assert_eq!(kind("Foo // end"), "the name `Foo`");
        assert_eq!(kind("Foo /* c */ (a: 1) // end"), "`Foo(…)`");
        assert_eq!(kind("r#\"x\"#"), "a text");
        assert_eq!(kind("-NaN"), "a number");
        assert_eq!(kind("1_000.5e-3"), "a number");
        assert_eq!(kind("{1: 2}"), "a map");
        assert_eq!(kind("1..2"), "a number in another notation");
        assert_eq!(kind("true"), "a truth value");
        assert_eq!(kind("Some(1)"), "an option");
        assert_eq!(kind("0x10"), "a number in another notation");
    }

    #[test]
    fn docs_are_the_slashed_lines_above_the_value() {
        let file = SourceMap::new().add("test.ron", "");
        let docs = |text: &str| parse(file, text).unwrap().docs;
        assert_eq!(docs("/// one\n///\n///  two\nM()"), ["one", "", " two"]);
        assert_eq!(docs("/// a\n// plain\n//// four\n\n/// b\n#![type = \"x\"]\nM()"), ["a", "b"]);
        assert_eq!(docs("/*\n/// no\n*/\n/// yes\nM( /// not this\n)"), ["yes"]);
        assert!(docs("M()").is_empty());
    }

    #[test]
    fn deep_nesting_is_an_error_and_no_stack_overflow() {
        let file = SourceMap::new().add("test.ron", "");
        for bracket in ["(", "[", "A(a:", "Some(", "{1:", "{[", "/*"] {
            let text = bracket.repeat(10_000);
            assert!(parse(file, &text).is_err(), "{bracket}");
        }
        let closed = format!("{}{}", "[".repeat(10_000), "]".repeat(10_000));
        assert!(parse(file, &closed).unwrap_err().message.contains("nested too deeply"));
    }

    #[test]
    fn the_place_of_a_syntax_error_counts_characters_not_bytes() {
        let mut sources = SourceMap::new();
        let text = "\u{feff}M(\r\n  ä: \"ü\" b: 1)";
        let file = sources.add("test.ron", text);
        let (span, _) = parse(file, text).unwrap_err().primary.unwrap();
        assert_eq!(&text[span.range], "b");
    }
}
