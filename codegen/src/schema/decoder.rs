//! What all decoders share: the file's diagnostics, and the fields of a struct by name.

use std::borrow::Cow;

use subsurface_profile::{Quantity, TabulatedModel};

use crate::diagnostics::{Diagnostic, Severity};
use crate::schema::quantity::check;
use crate::source::{Span, Spanned};
use crate::suggestion::{closest, list, shortened};
use crate::syntax::{Entry, Name, Node, Shape, count};

/// Errors listed for one file, and as many warnings. A generated list of 100 000 wrong numbers is one mistake, not 100 000.
const MOST_LISTED: usize = 100;

/// A field of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Given<T> {
    /// Not written.
    #[default]
    Absent,
    /// Written, wrong, and reported.
    Bad,
    /// Written and checked.
    Value(T),
}

impl<T> Given<T> {
    /// The value, if there is a good one.
    pub(crate) fn value(&self) -> Option<&T> {
        match self {
            Given::Value(value) => Some(value),
            Given::Absent | Given::Bad => None,
        }
    }

    pub(crate) fn is_absent(&self) -> bool {
        matches!(self, Given::Absent)
    }

    pub(crate) fn is_bad(&self) -> bool {
        matches!(self, Given::Bad)
    }

    pub(crate) fn map<U>(self, convert: impl FnOnce(T) -> U) -> Given<U> {
        match self {
            Given::Absent => Given::Absent,
            Given::Bad => Given::Bad,
            Given::Value(value) => Given::Value(convert(value)),
        }
    }

    fn of(value: Option<T>) -> Self {
        value.map_or(Given::Bad, Given::Value)
    }
}

/// Three numbers, one per channel or per coefficient, each with its place.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Triple {
    pub(crate) values: [f64; 3],
    pub(crate) spans: [Span; 3],
    pub(crate) span: Span,
}

/// Where the tables come from that a file names.
pub(crate) trait Tables {
    /// Reads the table in `file`, a path relative to the file that names it; what is wrong is reported.
    fn read(&mut self, decoder: &mut Decoder, file: &Spanned<String>) -> Option<TabulatedModel>;
}

/// Collects the diagnostics of one file while it is decoded.
#[derive(Default)]
pub(crate) struct Decoder<'t> {
    diagnostics: Vec<Diagnostic>,
    /// How many were reported, listed or not.
    errors: usize,
    warnings: usize,
    /// `None` for a file that can name no table, and while one is read.
    tables: Option<&'t mut dyn Tables>,
}

impl<'t> Decoder<'t> {
    /// A decoder of a file that may name tables.
    pub(crate) fn with_tables(tables: &'t mut dyn Tables) -> Self {
        Self { tables: Some(tables), ..Self::default() }
    }

    /// The table in `file`; `None` when there is none, which is reported.
    pub(crate) fn table(&mut self, file: &Spanned<String>) -> Option<TabulatedModel> {
        let tables = self.tables.take()?;
        let model = tables.read(self, file);
        self.tables = Some(tables);
        model
    }

    /// Adds an error or a warning.
    pub(crate) fn report(&mut self, diagnostic: Diagnostic) {
        let reported = match diagnostic.severity {
            Severity::Error => &mut self.errors,
            Severity::Warning => &mut self.warnings,
        };
        *reported += 1;
        if *reported <= MOST_LISTED {
            self.diagnostics.push(diagnostic);
        }
    }

    /// Adds what the decoder of a table reported, which has left out what is too much.
    pub(crate) fn report_of_table(&mut self, diagnostics: impl IntoIterator<Item = Diagnostic>) {
        self.diagnostics.extend(diagnostics);
    }

    /// All diagnostics of the file.
    pub(crate) fn finish(mut self, whole: &Span) -> Vec<Diagnostic> {
        for (severity, reported) in [(Severity::Error, self.errors), (Severity::Warning, self.warnings)] {
            let left_out = reported.saturating_sub(MOST_LISTED);
            if left_out > 0 {
                let further = count(left_out, &format!("further {}", severity.name()));
                let are = if left_out == 1 { "is" } else { "are" };
                let message = format!("{further} of this file {are} not listed");
                let end = whole.range.end;
                let diagnostic = Diagnostic::error(message)
                    .label(Span::new(whole.file, end..end), "the file ends here")
                    .help(format!("fix the first {MOST_LISTED}: the others are probably alike"));
                self.diagnostics.push(Diagnostic { severity, ..diagnostic });
            }
        }
        self.diagnostics
    }

    /// Reports that `node` is not what is expected.
    pub(crate) fn wrong_type(
        &mut self,
        node: &Node<'_>,
        field: &str,
        expected: &str,
        help: impl Into<String>,
    ) {
        self.report(
            Diagnostic::error(format!("`{field}` has the wrong type"))
                .label(node.span(), format!("expected {expected}, found {}", node.kind()))
                .help(help),
        );
    }

    /// A number within the bounds of its quantity.
    pub(crate) fn number(&mut self, node: &Node<'_>, field: &str, quantity: &Quantity) -> Option<f64> {
        let Shape::Number(value) = node.shape() else {
            self.wrong_type(node, field, "a number", quantity.meaning);
            return None;
        };
        self.checked(node, value, quantity)
    }

    fn checked(&mut self, node: &Node<'_>, value: f64, quantity: &Quantity) -> Option<f64> {
        match check(quantity, value, node.text()) {
            // The sum turns -0.0 into 0.0: both are written zeros, and one text must give one kernel.
            Ok(()) => Some(value + 0.0),
            Err(refusal) => {
                self.report(
                    Diagnostic::error(refusal.message).label(node.span(), refusal.label).help(refusal.help),
                );
                None
            }
        }
    }

    /// A number with its place.
    pub(crate) fn spanned_number(
        &mut self,
        node: &Node<'_>,
        field: &str,
        quantity: &Quantity,
    ) -> Option<Spanned<f64>> {
        self.number(node, field, quantity).map(|value| Spanned::new(value, node.span()))
    }

    /// `(x, y, z)`; `form` names the three in help texts, such as `(red, green, blue)`.
    pub(crate) fn triple(
        &mut self,
        node: &Node<'_>,
        field: &str,
        form: &str,
        quantity: &Quantity,
    ) -> Option<Triple> {
        let nodes = self.numbers_of(node, field, form, ["three numbers", "in all three"], 3)?;
        self.three(node, &nodes, field, quantity)
    }

    /// `(c0, c1, …)`: `count` numbers, which `form` names in help texts.
    pub(crate) fn numbers(
        &mut self,
        node: &Node<'_>,
        field: &str,
        form: &str,
        quantity: &Quantity,
        count: usize,
    ) -> Option<Vec<f64>> {
        let count_in_words = count_in_words(count);
        let words = [&*format!("{count_in_words} numbers"), &*format!("in all {count_in_words}")];
        let nodes = self.numbers_of(node, field, form, words, count)?;
        // All are checked before the first failure counts, so that each is reported.
        let values: Vec<Option<f64>> = nodes.iter().map(|node| self.number(node, field, quantity)).collect();
        values.into_iter().collect()
    }

    /// The values of a tuple of `count` numbers, which `words` spell.
    fn numbers_of<'n>(
        &mut self,
        node: &Node<'n>,
        field: &str,
        form: &str,
        [numbers, in_all]: [&str; 2],
        count: usize,
    ) -> Option<Vec<Node<'n>>> {
        let expected = format!("{numbers} `{form}`");
        match node.shape() {
            Shape::Tuple(None, nodes) if nodes.len() == count => return Some(nodes),
            Shape::List(nodes) => {
                let texts: Vec<&str> = nodes.iter().take(count).map(Node::text).collect();
                let help = if nodes.len() == count && texts.iter().all(|text| text.len() < 24) {
                    format!("write round brackets: `{field}: ({})`", texts.join(", "))
                } else {
                    format!("write `{field}: {form}`")
                };
                self.wrong_type(node, field, &expected, help);
            }
            Shape::Number(_) => {
                let texts = vec![node.text(); count].join(", ");
                let help = format!("for the same value {in_all}, write `{field}: ({texts})`");
                self.wrong_type(node, field, &expected, help);
            }
            _ => self.wrong_type(node, field, &expected, format!("write `{field}: {form}`")),
        }
        None
    }

    fn three(
        &mut self,
        node: &Node<'_>,
        nodes: &[Node<'_>],
        field: &str,
        quantity: &Quantity,
    ) -> Option<Triple> {
        // All three are checked before the first failure counts, so that each is reported.
        let values: Vec<Option<f64>> = nodes.iter().map(|node| self.number(node, field, quantity)).collect();
        match (values.as_slice(), nodes) {
            ([Some(x), Some(y), Some(z)], [a, b, c]) => Some(Triple {
                values: [*x, *y, *z],
                spans: [a.span(), b.span(), c.span()],
                span: node.span(),
            }),
            _ => None,
        }
    }

    /// A text.
    pub(crate) fn text(&mut self, node: &Node<'_>, field: &str) -> Option<Spanned<String>> {
        match node.shape() {
            Shape::Text(text) => Some(Spanned::new(text, node.span())),
            Shape::Name(name) => {
                let help = format!("write it in quotes: `{field}: \"{}\"`", name.text);
                self.wrong_type(node, field, "a text", help);
                None
            }
            _ => {
                self.wrong_type(node, field, "a text", format!("write `{field}: \"…\"`"));
                None
            }
        }
    }

    /// `true` or `false`.
    pub(crate) fn truth(&mut self, node: &Node<'_>, field: &str) -> Option<bool> {
        match node.text() {
            "true" => Some(true),
            "false" => Some(false),
            _ => {
                let help = format!("write `{field}: true` or `{field}: false`");
                self.wrong_type(node, field, "`true` or `false`", help);
                None
            }
        }
    }

    /// Sorts the entries of a struct by the names it knows; reports unknown and repeated ones.
    pub(crate) fn fields<'a>(
        &mut self,
        owner: impl Into<Cow<'static, str>>,
        head: Span,
        entries: Vec<Entry<'a>>,
        known: &[&'static str],
    ) -> Fields<'a> {
        self.fields_and_groups(owner, head, entries, known, &[])
    }

    /// As [`fields`](Self::fields); `grouped` are fields that belong one level deeper, with their group.
    pub(crate) fn fields_and_groups<'a>(
        &mut self,
        owner: impl Into<Cow<'static, str>>,
        head: Span,
        entries: Vec<Entry<'a>>,
        known: &[&'static str],
        grouped: &[(&'static str, &'static str)],
    ) -> Fields<'a> {
        let owner = owner.into();
        let mut fields = Fields { owner: owner.clone(), head, entries: Vec::new(), misspelt: Vec::new() };
        let mut unknown = Vec::new();
        for entry in entries {
            let name = entry.key.text;
            if let Some(first) = fields.get(name) {
                let diagnostic = Diagnostic::error(format!("field `{name}` is given twice"))
                    .label(entry.key.span.clone(), "again here")
                    .secondary(first.key.span.clone(), "first given here")
                    .help("remove one of the two");
                self.report(diagnostic);
            } else if known.contains(&name) {
                fields.entries.push(entry);
            } else {
                unknown.push(entry.key);
            }
        }
        for key in unknown {
            let meant = closest(key.text, known.iter().copied().chain(grouped.iter().map(|(name, _)| *name)));
            let mut diagnostic = Diagnostic::error(format!("unknown field `{}`", shortened(key.text)))
                .label(key.span.clone(), format!("not a field of {owner}"));
            if let Some(meant) = meant {
                let group = grouped.iter().find(|(name, _)| *name == meant).map(|(_, group)| *group);
                diagnostic = diagnostic.help(match group {
                    Some(group) => format!("did you mean `{meant}`, within `{group}: (…)`?"),
                    None if fields.get(meant).is_some() => {
                        format!("did you mean `{meant}`, which is given already?")
                    }
                    None => format!("did you mean `{meant}`?"),
                });
                fields.misspelt.push(meant);
            }
            self.report(diagnostic.help(match known {
                [] => format!("{owner} has no fields"),
                known => format!("the fields of {owner} are {}", list(known.iter().copied())),
            }));
        }
        fields
    }

    /// Reports a field that must be there.
    pub(crate) fn missing(&mut self, owner: &str, head: &Span, field: &str, help: impl Into<String>) {
        self.report(
            Diagnostic::error(format!("missing field `{field}`"))
                .label(head.clone(), format!("{owner} needs `{field}`"))
                .help(help),
        );
    }
}

/// The known fields of a struct.
pub(crate) struct Fields<'a> {
    pub(crate) owner: Cow<'static, str>,
    /// The struct's name, or its opening bracket.
    pub(crate) head: Span,
    entries: Vec<Entry<'a>>,
    /// Known fields that unknown ones were probably meant to be; they are not missing as well.
    misspelt: Vec<&'static str>,
}

impl<'a> Fields<'a> {
    /// The entry of this name.
    pub(crate) fn get(&self, name: &str) -> Option<&Entry<'a>> {
        self.entries.iter().find(|entry| entry.key.text == name)
    }

    /// Decodes a field that may be left out.
    pub(crate) fn optional<T>(&self, name: &str, decode: impl FnOnce(&Node<'a>) -> Option<T>) -> Given<T> {
        match self.get(name) {
            Some(entry) => Given::of(decode(&entry.value)),
            None if self.misspelt.contains(&name) => Given::Bad,
            None => Given::Absent,
        }
    }

    /// Decodes a field that must be there.
    pub(crate) fn required<T>(
        &self,
        decoder: &mut Decoder,
        name: &str,
        help: &str,
        decode: impl FnOnce(&mut Decoder, &Node<'a>) -> Option<T>,
    ) -> Option<T> {
        match self.get(name) {
            Some(entry) => decode(decoder, &entry.value),
            None if self.misspelt.contains(&name) => None,
            None => {
                decoder.missing(&self.owner, &self.head, name, help);
                None
            }
        }
    }
}

/// Small numbers as messages spell them.
fn count_in_words(count: usize) -> String {
    match count {
        2 => "two".to_owned(),
        3 => "three".to_owned(),
        4 => "four".to_owned(),
        _ => count.to_string(),
    }
}

/// The place that stands for a struct: its name, or its opening bracket.
pub(crate) fn head(name: Option<&Name<'_>>, node: &Node<'_>) -> Span {
    name.map_or_else(
        || {
            let Span { file, range } = node.span();
            Span::new(file, range.start..(range.start + 1).min(range.end))
        },
        |name| name.span.clone(),
    )
}
