//! Models as files write them, read by what each model says of itself: the fields, their units and bounds stand in
//! `profile/src/<model>.rs`.

use std::collections::BTreeMap;

use subsurface_profile::description::{Field, Notation, Values, Variable};
use subsurface_profile::{Length, MixtureModel, MixturePart, Model, ModelKind};

use crate::diagnostics::Diagnostic;
use crate::schema::body::Body;
use crate::schema::choice::{choice, unknown_word};
use crate::schema::decoder::{Decoder, Fields, head};
use crate::schema::profile::decode_written_model;
use crate::source::Span;
use crate::suggestion::{list, shortened};
use crate::syntax::{Entry, Name, Node, Shape};

/// A model with the places of its coefficients, by the paths that [`subsurface_profile::ModelError`] uses.
pub(super) struct Decoded {
    pub(super) model: Model,
    pub(super) spans: BTreeMap<String, Span>,
}

/// Reads a model whose name has been read; the coefficients are not yet held against each other.
pub(super) fn decode_model(
    decoder: &mut Decoder,
    kind: ModelKind,
    name: &Name<'_>,
    body: Body<'_>,
) -> Option<Decoded> {
    let example = kind.description().example;
    match kind.description().notation {
        Notation::Fields { key, own } => {
            let entries = body.fields(decoder, name, example)?;
            let form = Form { kind, key, own };
            if own.is_empty() {
                form.in_place_of_key(decoder, name, entries)
            } else {
                form.within_key(decoder, name, entries)
            }
        }
        Notation::Terms { term, example: one } => {
            let node = body.single(decoder, name, example)?;
            terms(decoder, kind, &node, term, one)
        }
        Notation::Table => {
            let entries = body.fields(decoder, name, example)?;
            table(decoder, name, entries)
        }
        Notation::Parts => {
            let node = body.single(decoder, name, example)?;
            parts(decoder, kind, &node)
        }
    }
}

/// Named fields, or the word of a published set in the field `key`: see [`Notation::Fields`].
#[derive(Clone, Copy)]
struct Form {
    kind: ModelKind,
    key: &'static str,
    own: &'static str,
}

impl Form {
    /// The words of the published sets.
    fn words(self) -> Vec<&'static str> {
        self.kind.published().iter().map(|set| set.word).filter(|word| !word.is_empty()).collect()
    }

    fn set(self, word: &str) -> Option<Model> {
        self.kind.published().into_iter().find(|set| set.word == word).map(|set| set.model)
    }

    fn owner(self) -> String {
        format!("`{}`", self.kind.description().name)
    }

    /// `key: Word`, or `key: Own(…)`.
    fn within_key(self, decoder: &mut Decoder, name: &Name<'_>, entries: Vec<Entry<'_>>) -> Option<Decoded> {
        let Form { kind, key, own } = self;
        let words: Vec<&'static str> = self.words().into_iter().chain([own]).collect();
        let fields = decoder.fields(self.owner(), name.span.clone(), entries, &[key]);
        let mut spans = BTreeMap::new();
        let all = kind.fields();
        let group = all.first().and_then(|field| field.group()).unwrap_or_default();
        let help = format!("add {}", alternatives(key, &words, own));
        let model = fields.required(decoder, key, &help, |decoder, node| {
            spans.insert(group.to_owned(), node.span());
            let (word, entries) = match node.shape() {
                Shape::Struct(Some(word), entries) => (word, entries),
                Shape::Tuple(Some(word), _) => (word, Vec::new()),
                Shape::Name(word) if word.text == own => (word, Vec::new()),
                _ => return self.set(choice(decoder, node, key, &words)?),
            };
            if word.text != own {
                unknown_word(decoder, &word, key, &words);
                return None;
            }
            spans.insert(group.to_owned(), word.span.clone());
            // What stands within the word needs no group.
            let mut reader = Reader { kind, all: &all, flat: true, spans: &mut spans };
            let known = reader.keys();
            let inner = decoder.fields(format!("`{own}`"), word.span.clone(), entries, &known);
            reader.model(decoder, &inner)
        })?;
        Some(Decoded { model, spans })
    }

    /// `key: Word`, or all fields in its place.
    fn in_place_of_key(
        self,
        decoder: &mut Decoder,
        name: &Name<'_>,
        entries: Vec<Entry<'_>>,
    ) -> Option<Decoded> {
        let Form { kind, key, .. } = self;
        let words = self.words();
        let all = kind.fields();
        let mut spans = BTreeMap::new();
        let mut reader = Reader { kind, all: &all, flat: false, spans: &mut spans };
        let keys = reader.keys();
        let known: Vec<&'static str> = std::iter::once(key).chain(keys.iter().copied()).collect();
        let fields = decoder.fields(self.owner(), name.span.clone(), entries, &known);
        let spelled = keys.iter().find_map(|key| fields.get(key));
        if let Some(preset) = fields.get(key) {
            if let Some(first) = spelled {
                conflict(decoder, &preset.key, &first.key, &keys);
                return None;
            }
            let model = self.set(choice(decoder, &preset.value, key, &words)?)?;
            return Some(Decoded { model, spans });
        }
        if spelled.is_none() {
            let own = list(keys.iter().copied());
            let help = format!("add {}, or all of {own}", alternatives(key, &words, ""));
            decoder.missing(&self.owner(), &name.span, key, help);
            return None;
        }
        let model = reader.model(decoder, &fields)?;
        Some(Decoded { model, spans })
    }
}

/// `` `key: First`, `Second` or `Own(…)` ``.
fn alternatives(key: &str, words: &[&str], own: &str) -> String {
    let mut words: Vec<String> = words
        .iter()
        .map(|word| if *word == own { format!("`{word}(…)`") } else { format!("`{word}`") })
        .collect();
    if let Some(first) = words.first_mut() {
        *first = format!("`{key}: {}", first.trim_start_matches('`'));
    }
    match words.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
        None => format!("`{key}: …`"),
    }
}

fn conflict(decoder: &mut Decoder, one: &Name<'_>, other: &Name<'_>, keys: &[&str]) {
    decoder.report(
        Diagnostic::error(format!("`{}` and `{}` exclude each other", one.text, other.text))
            .label(one.span.clone(), "given here")
            .secondary(other.span.clone(), "and here")
            .help(format!("give either a published set, or {}", list(keys.iter().copied()))),
    );
}

/// The field that says which of several lengths a model is parametrized by.
const LENGTH: &str = "length";

/// The word for a length.
pub(crate) fn length_word(length: Length) -> &'static str {
    match length {
        Length::MeanFreePath => "MeanFreePath",
        Length::DiffuseMeanFreePath => "DiffuseMeanFreePath",
    }
}

/// Reads the fields of a model.
struct Reader<'m> {
    kind: ModelKind,
    all: &'m [&'static Field],
    /// Fields of groups stand beside the others, by their names alone.
    flat: bool,
    spans: &'m mut BTreeMap<String, Span>,
}

impl Reader<'_> {
    /// The group that a field is written in.
    fn group(&self, field: &Field) -> Option<&'static str> {
        field.group().filter(|_| !self.flat)
    }

    /// The lengths that a file has to choose from.
    fn lengths(&self) -> &'static [Length] {
        let lengths = self.kind.description().lengths;
        if lengths.len() > 1 { lengths } else { &[] }
    }

    /// Names of what stands in the model's brackets: fields and groups.
    fn keys(&self) -> Vec<&'static str> {
        let mut keys: Vec<&'static str> = self.lengths().iter().take(1).map(|_| LENGTH).collect();
        keys.extend(self.all.iter().map(|field| self.group(field).unwrap_or(field.name())));
        keys.dedup();
        keys
    }

    /// All fields; each one that is missing or wrong is reported.
    fn model(&mut self, decoder: &mut Decoder, fields: &Fields<'_>) -> Option<Model> {
        let Some(mut model) = self.kind.blank(1) else {
            // Terms and parts are read elsewhere; a model of coefficients has at least one published set, or says how it
            // begins.
            let name = self.kind.description().name;
            decoder.report(
                Diagnostic::error(format!(
                    "the model `{name}` does not say what its coefficients are before they are read"
                ))
                .label(fields.head.clone(), "this model")
                .help("no file is to blame: give it a published set, or implement `ProfileModel::blank`"),
            );
            return None;
        };
        let mut is_whole = true;
        if let Some(word) = self.length(decoder, fields) {
            match word {
                Some(length) => model.set_length(length),
                None => is_whole = false,
            }
        }
        let mut numbers = Vec::new();
        let all = self.all;
        let flat = self.flat;
        let together = |a: &&Field, b: &&Field| !flat && a.group().is_some() && a.group() == b.group();
        for of_group in all.chunk_by(together) {
            let read = match self.group(of_group[0]) {
                Some(group) => self.grouped(decoder, fields, group, of_group),
                None => field(decoder, fields, of_group[0], self.kind, "", self.spans),
            };
            match read {
                Some(read) => numbers.extend(read),
                None => is_whole = false,
            }
        }
        is_whole.then(|| {
            fill(&mut model, &numbers);
            model
        })
    }

    /// The length, where a file has to choose: `Some(None)` where it does not.
    fn length(&self, decoder: &mut Decoder, fields: &Fields<'_>) -> Option<Option<Length>> {
        let lengths = self.lengths();
        let words: Vec<&'static str> = lengths.iter().copied().map(length_word).collect();
        let forms: Vec<String> = words.iter().map(|word| format!("`{LENGTH}: {word}`")).collect();
        (!lengths.is_empty()).then(|| {
            let help = format!("add {}", forms.join(" or "));
            let word = fields
                .required(decoder, LENGTH, &help, |decoder, node| choice(decoder, node, LENGTH, &words));
            lengths.iter().copied().find(|length| Some(length_word(*length)) == word)
        })
    }

    /// A group of named numbers, such as `a: (linear: …, amplitude: …, decades: …)`.
    fn grouped(
        &mut self,
        decoder: &mut Decoder,
        fields: &Fields<'_>,
        group: &'static str,
        of_group: &[&'static Field],
    ) -> Option<Vec<f64>> {
        let names: Vec<&'static str> = of_group.iter().map(|field| field.name()).collect();
        let form = form_of(&names);
        fields.required(decoder, group, &format!("add `{group}: {form}`"), |decoder, node| {
            let Shape::Struct(None, entries) = node.shape() else {
                decoder.wrong_type(node, group, "named numbers", format!("write `{group}: {form}`"));
                return None;
            };
            self.spans.insert(group.to_owned(), node.span());
            let inner = decoder.fields(format!("`{group}`"), head(None, node), entries, &names);
            // All are read before the first failure counts, so that each is reported.
            let numbers: Vec<_> =
                of_group.iter().map(|one| field(decoder, &inner, one, self.kind, "", self.spans)).collect();
            let numbers: Option<Vec<_>> = numbers.into_iter().collect();
            Some(numbers?.concat())
        })
    }
}

/// `(name: …, other: …)`.
fn form_of(names: &[&str]) -> String {
    let form: Vec<String> = names.iter().map(|name| format!("{name}: …")).collect();
    format!("({})", form.join(", "))
}

/// Writes numbers into the fields of a model, in their order.
fn fill(model: &mut Model, numbers: &[f64]) {
    let mut rest = numbers.iter();
    model.visit(&mut |slot| {
        for (place, number) in slot.values.iter_mut().zip(rest.by_ref()) {
            *place = *number;
        }
    });
}

/// The numbers of one field; `prefix` is the path of the term that it belongs to.
fn field(
    decoder: &mut Decoder,
    fields: &Fields<'_>,
    field: &'static Field,
    kind: ModelKind,
    prefix: &str,
    spans: &mut BTreeMap<String, Span>,
) -> Option<Vec<f64>> {
    const CHANNELS: &str = "(red, green, blue)";
    let (name, quantity) = (field.name(), &field.quantity);
    let (form, help) = match field.values {
        Values::One if quantity.unit.is_empty() => (String::new(), format!("add `{name}: …`, a number")),
        Values::One => (String::new(), format!("add `{name}: …`, in {}", quantity.unit)),
        Values::Powers(count) => {
            let form = format!("({})", ["constant", "linear", "quadratic", "cubic"][..count].join(", "));
            let powers = powers(&kind.description().variable, count);
            let help = format!("add `{name}: {form}`, the coefficients of {powers}");
            (form, help)
        }
        Values::Channels => {
            (CHANNELS.to_owned(), format!("add `{name}: {CHANNELS}`, or one number for all three"))
        }
    };
    fields.required(decoder, name, &help, |decoder, node| {
        spans.insert(format!("{prefix}{}", field.path), node.span());
        match (field.values, node.shape()) {
            (Values::One, _) => Some(vec![decoder.number(node, name, quantity)?]),
            (Values::Channels, Shape::Number(_)) => Some(vec![decoder.number(node, name, quantity)?; 3]),
            (values, _) => decoder.numbers(node, name, &form, quantity, values.count()),
        }
    })
}

/// What coefficients are of: `1, x, x² and x³, x = 6A/(1 + 5A)`.
fn powers(variable: &Variable, count: usize) -> String {
    let Variable { symbol, definition, .. } = variable;
    let powers = ["1".to_owned(), (*symbol).to_owned(), format!("{symbol}²"), format!("{symbol}³")];
    let listed = match powers[..count].split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => powers[0].clone(),
    };
    if definition.is_empty() { listed } else { format!("{listed}, {definition}") }
}

/// A list of terms, each with the same fields; `one` is a term written out.
fn terms(decoder: &mut Decoder, kind: ModelKind, node: &Node<'_>, term: &str, one: &str) -> Option<Decoded> {
    let description = kind.description();
    let help = || format!("for example `{}`", description.example);
    let Shape::List(nodes) = node.shape() else {
        decoder.wrong_type(node, description.name, &format!("a list of {term}s"), help());
        return None;
    };
    if nodes.is_empty() {
        decoder.report(
            Diagnostic::error(format!("the list of {term}s is empty"))
                .label(node.span(), format!("expected at least one {term}"))
                .help(help()),
        );
        return None;
    }
    let all = kind.fields();
    let names: Vec<&'static str> = all.iter().map(|field| field.name()).collect();
    let mut spans = BTreeMap::new();
    let mut read = Vec::with_capacity(nodes.len());
    for (index, node) in nodes.iter().enumerate() {
        let Shape::Struct(name, entries) = node.shape() else {
            let expected = format!("a {term} `{}`", form_of(&names));
            decoder.wrong_type(node, description.name, &expected, format!("write `{one}`"));
            read.push(None);
            continue;
        };
        let inner = decoder.fields(format!("a {term}"), head(name.as_ref(), node), entries, &names);
        let prefix = format!("terms[{index}].");
        let numbers: Vec<_> =
            all.iter().map(|one| field(decoder, &inner, one, kind, &prefix, &mut spans)).collect();
        read.push(numbers.into_iter().collect::<Option<Vec<_>>>().map(|numbers| numbers.concat()));
    }
    let numbers = read.into_iter().collect::<Option<Vec<_>>>()?.concat();
    let mut model = kind.blank(nodes.len())?;
    fill(&mut model, &numbers);
    Some(Decoded { model, spans })
}

/// A list of parts: their fields, and a model each.
fn parts(decoder: &mut Decoder, kind: ModelKind, node: &Node<'_>) -> Option<Decoded> {
    const MODEL: &str = "model";
    const ONE: &str = "(weight: 0.3, model: Burley(parametrization: Searchlight))";
    let description = kind.description();
    let help = || format!("for example `{}`", description.example);
    let Shape::List(nodes) = node.shape() else {
        decoder.wrong_type(node, description.name, "a list of parts", help());
        return None;
    };
    let all = kind.fields();
    let names: Vec<&'static str> = all.iter().map(|field| field.name()).chain([MODEL]).collect();
    let mut spans = BTreeMap::from([("parts".to_owned(), node.span())]);
    let mut read = Vec::with_capacity(nodes.len());
    for (index, node) in nodes.iter().enumerate() {
        let prefix = format!("parts[{index}].");
        let part = match node.shape() {
            Shape::Struct(None, entries) => {
                let inner = decoder.fields("a part", head(None, node), entries, &names);
                let numbers: Vec<_> =
                    all.iter().map(|one| field(decoder, &inner, one, kind, &prefix, &mut spans)).collect();
                let model = inner.required(decoder, MODEL, "add `model: …`, any model", |decoder, node| {
                    decode_written_model(decoder, node, MODEL)
                });
                numbers.into_iter().collect::<Option<Vec<_>>>().map(|numbers| numbers.concat()).zip(model)
            }
            Shape::Tuple(None, pair) if pair.len() == 2 => {
                let [weight, model] = [&pair[0], &pair[1]];
                spans.insert(format!("{prefix}{}", all[0].path), weight.span());
                let weight = decoder.number(weight, all[0].name(), &all[0].quantity);
                weight.map(|weight| vec![weight]).zip(decode_written_model(decoder, model, MODEL))
            }
            _ => {
                let expected = format!("a part `{}`", form_of(&names));
                decoder.wrong_type(node, description.name, &expected, format!("write `{ONE}`"));
                None
            }
        };
        read.push(part.map(|(numbers, inline)| {
            let of_model = format!("{prefix}{MODEL}");
            spans.extend(
                inline.coefficients.into_iter().map(|(path, span)| (format!("{of_model}.{path}"), span)),
            );
            spans.insert(of_model, inline.head);
            MixturePart { weight: numbers[0], model: inline.model }
        }));
    }
    let parts = read.into_iter().collect::<Option<Vec<_>>>()?;
    Some(Decoded { model: MixtureModel { parts }.into(), spans })
}

fn table(decoder: &mut Decoder, name: &Name<'_>, entries: Vec<Entry<'_>>) -> Option<Decoded> {
    const HELP: &str = "add `file: \"my_table.csv\"`, a CSV file beside this one";
    let fields = decoder.fields(format!("`{}`", name.text), name.span.clone(), entries, &["file"]);
    let file = fields.required(decoder, "file", HELP, |decoder, node| decoder.text(node, "file"))?;
    if file.value.is_empty() || file.value.contains('\\') {
        decoder.report(
            Diagnostic::error(format!("`{}` is no path of a table", shortened(&file.value)))
                .label(file.span, "expected the path of a CSV file")
                .help("write a path relative to this file, with `/` between folders: `\"tables/mine.csv\"`"),
        );
        return None;
    }
    let model = decoder.table(&file)?;
    Some(Decoded { model: model.into(), spans: BTreeMap::from([("file".to_owned(), file.span)]) })
}
