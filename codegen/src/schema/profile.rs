//! Profile files and inline profiles.

use std::collections::BTreeMap;

use subsurface_profile::{
    BurleyModel, BurleyShape, Channel, ExponentialDipoleModel, GaussianSumModel, GaussianTerm, Length,
    Medium, Model, ModelError, PolynomialA, PolynomialB, PolynomialC, PolynomialModel,
    TwoExponentialDipoleModel,
};

use crate::diagnostics::Diagnostic;
use crate::schema::body::Body;
use crate::schema::choice::{choice, unknown_word};
use crate::schema::decoder::{Decoder, Fields, head};
use crate::schema::model_error_text::describe;
use crate::schema::quantity::{COEFFICIENT, VARIANCE, WEIGHT};
use crate::schema::set_file::SET;
use crate::source::{FileId, Span, Spanned};
use crate::suggestion::{closest, list, shortened};
use crate::syntax::{Document, Entry, Name, Node, Shape};

/// A file of `profiles/`.
#[derive(Clone, Debug)]
pub(crate) struct ProfileFile {
    pub(crate) file: FileId,
    pub(crate) stem: String,
    pub(crate) docs: Vec<String>,
    /// `None` when the file has errors.
    pub(crate) expression: Option<ProfileExpression>,
}

/// What stands where a profile is expected.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ProfileExpression {
    /// The stem of a profile file.
    Named(Spanned<String>),
    /// A model with its coefficients.
    Inline(InlineModel),
}

/// A model and where it is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InlineModel {
    pub(crate) model: Model,
    /// The model's name.
    pub(crate) head: Span,
    /// Where each coefficient is written, by path: `terms[2].variance_mm2`.
    pub(crate) coefficients: BTreeMap<String, Span>,
}

const MODELS: [&str; 6] =
    ["Burley", "Polynomial", "GaussianSum", "ExponentialDipole", "TwoExponentialDipole", "Tabulated"];

/// Surface albedos at which a model must have a profile. A texture may give any from 0 to 1 per pixel, so a model that
/// fails somewhere is refused; 32 steps find a failure wider than 0.03, and both ends have their own limits.
fn probed_surface_albedos() -> impl Iterator<Item = f64> {
    (0..=32).map(|step| f64::from(step) / 32.0)
}

/// Decodes a file of `profiles/`.
pub(crate) fn decode_profile_file(
    decoder: &mut Decoder,
    file: FileId,
    stem: String,
    document: &Document<'_>,
) -> ProfileFile {
    let node = &document.value;
    let noun = match node.name().map(|name| name.text) {
        Some("Material") => Some("a material"),
        Some(SET) => Some("a material set"),
        _ => None,
    };
    let expression = if let Some(noun) = noun {
        decoder.report(
            Diagnostic::error(format!("expected a profile, found {noun}"))
                .label(head(node.name().as_ref(), node), format!("{noun} does not belong among profiles"))
                .help(format!("profiles are {} or the name of another profile in quotes", list(MODELS)))
                .help("move the file one folder up, out of `profiles`"),
        );
        None
    } else {
        decode_profile(decoder, node, "profile")
    };
    ProfileFile { file, stem, docs: document.docs.clone(), expression }
}

/// Decodes what stands where a profile is expected.
pub(crate) fn decode_profile(
    decoder: &mut Decoder,
    node: &Node<'_>,
    field: &str,
) -> Option<ProfileExpression> {
    if let Shape::Text(text) = node.shape() {
        return Some(ProfileExpression::Named(Spanned::new(text, node.span())));
    }
    let Some((name, body)) = Body::of(node) else {
        let help =
            format!("write the stem of a profile file in quotes, or a model: {}", list(MODELS.map(example)));
        decoder.wrong_type(node, field, "a profile", help);
        return None;
    };
    let example = example(name.text);
    let Decoded { model, spans } = match name.text {
        "Burley" => {
            let entries = body.fields(decoder, &name, example)?;
            burley(decoder, &name, entries)
        }
        "Polynomial" => {
            let entries = body.fields(decoder, &name, example)?;
            polynomial(decoder, &name, entries)
        }
        "GaussianSum" => {
            let list = body.single(decoder, &name, example)?;
            gaussian_sum(decoder, &list)
        }
        "ExponentialDipole" => {
            let entries = body.fields(decoder, &name, example)?;
            exponential_dipole(decoder, &name, entries)
        }
        "TwoExponentialDipole" => {
            let entries = body.fields(decoder, &name, example)?;
            two_exponential_dipole(decoder, &name, entries)
        }
        "Tabulated" => {
            let entries = body.fields(decoder, &name, example)?;
            tabulated(decoder, &name, entries)
        }
        _ => {
            unknown_model(decoder, &name);
            None
        }
    }?;
    let errors = model_errors(&model);
    for error in &errors {
        decoder.report(describe(error, &name.span, &spans));
    }
    errors.is_empty().then_some(ProfileExpression::Inline(InlineModel {
        model,
        head: name.span,
        coefficients: spans,
    }))
}

fn unknown_model(decoder: &mut Decoder, name: &Name<'_>) {
    let mut diagnostic = Diagnostic::error(format!("unknown profile model `{}`", shortened(name.text)))
        .label(name.span.clone(), "not a profile model");
    match closest(name.text, MODELS) {
        // Models are capitalised, files are not.
        _ if name.text.starts_with(|c: char| c.is_lowercase()) => {
            let help = format!("a profile file is named in quotes: `\"{}\"`", shortened(name.text));
            diagnostic = diagnostic.help(help);
        }
        Some(meant) => diagnostic = diagnostic.help(format!("did you mean `{meant}`?")),
        None => {
            diagnostic = diagnostic.help("a profile file is named in quotes: `profile: \"burley_diffuse\"`")
        }
    }
    decoder.report(diagnostic.help(format!("the models are {}", list(MODELS))));
}

fn example(model: &str) -> &'static str {
    match model {
        "Burley" => "Burley(parametrization: Searchlight)",
        "Polynomial" => "Polynomial(coefficients: Liang2023)",
        "GaussianSum" => "GaussianSum([(variance_mm2: 1.0, weight: 1.0)])",
        "Tabulated" => "Tabulated(file: \"my_table.csv\")",
        "ExponentialDipole" => "ExponentialDipole(entry: Searchlight)",
        _ => "TwoExponentialDipole(entry: Searchlight)",
    }
}

/// A model with the places of its coefficients, by the paths that [`ModelError`] uses.
struct Decoded {
    model: Model,
    spans: BTreeMap<String, Span>,
}

impl Decoded {
    fn new(model: Model, spans: BTreeMap<String, Span>) -> Option<Self> {
        Some(Self { model, spans })
    }
}

/// Reads the number in field `name`; `prefix` is the path of the struct in its model.
fn coefficient(
    decoder: &mut Decoder,
    fields: &Fields<'_>,
    spans: &mut BTreeMap<String, Span>,
    prefix: &str,
    name: &str,
) -> Option<f64> {
    fields.required(decoder, name, &format!("add `{name}: …`, a number"), |decoder, node| {
        spans.insert(format!("{prefix}{name}"), node.span());
        decoder.number(node, name, &COEFFICIENT)
    })
}

fn burley(decoder: &mut Decoder, name: &Name<'_>, entries: Vec<Entry<'_>>) -> Option<Decoded> {
    const WORDS: [&str; 4] = ["Searchlight", "Diffuse", "DiffuseMeanFreePath", "Fit"];
    const HELP: &str = "add `parametrization: Searchlight`, `Diffuse`, `DiffuseMeanFreePath` or `Fit(…)`";
    let fields = decoder.fields("`Burley`", name.span.clone(), entries, &["parametrization"]);
    let mut spans = BTreeMap::new();
    let model = fields.required(decoder, "parametrization", HELP, |decoder, node| {
        spans.insert("shape".to_owned(), node.span());
        match node.shape() {
            Shape::Struct(Some(fit), entries) if fit.text == "Fit" => {
                spans.insert("shape".to_owned(), fit.span.clone());
                burley_fit(decoder, &fit, entries, &mut spans)
            }
            Shape::Struct(Some(other), _) | Shape::Tuple(Some(other), _) if other.text != "Fit" => {
                unknown_word(decoder, &other, "parametrization", &WORDS);
                None
            }
            Shape::Tuple(Some(fit), _) => burley_fit(decoder, &fit, Vec::new(), &mut spans),
            Shape::Name(fit) if fit.text == "Fit" => burley_fit(decoder, &fit, Vec::new(), &mut spans),
            _ => Some(match choice(decoder, node, "parametrization", &WORDS)? {
                "Searchlight" => BurleyModel::SEARCHLIGHT,
                "Diffuse" => BurleyModel::DIFFUSE,
                _ => BurleyModel::DIFFUSE_MEAN_FREE_PATH,
            }),
        }
    })?;
    Decoded::new(Model::Burley(model), spans)
}

fn burley_fit(
    decoder: &mut Decoder,
    name: &Name<'_>,
    entries: Vec<Entry<'_>>,
    spans: &mut BTreeMap<String, Span>,
) -> Option<BurleyModel> {
    const LENGTHS: [&str; 2] = ["MeanFreePath", "DiffuseMeanFreePath"];
    const FIELDS: [&str; 6] = ["length", "constant", "slope", "amplitude", "pivot", "exponent"];
    let fields = decoder.fields("`Fit`", name.span.clone(), entries, &FIELDS);
    let length = fields.required(
        decoder,
        "length",
        "add `length: MeanFreePath` or `length: DiffuseMeanFreePath`",
        |decoder, node| choice(decoder, node, "length", &LENGTHS),
    );
    let mut number = |name| coefficient(decoder, &fields, spans, "shape.", name);
    let numbers =
        [number("constant"), number("slope"), number("amplitude"), number("pivot"), number("exponent")];
    let (Some(length), [Some(constant), Some(slope), Some(amplitude), Some(pivot), Some(exponent)]) =
        (length, numbers)
    else {
        return None;
    };
    let length = if length == "MeanFreePath" { Length::MeanFreePath } else { Length::DiffuseMeanFreePath };
    Some(BurleyModel { length, shape: BurleyShape { constant, slope, amplitude, pivot, exponent } })
}

fn polynomial(decoder: &mut Decoder, name: &Name<'_>, entries: Vec<Entry<'_>>) -> Option<Decoded> {
    let fields = decoder.fields("`Polynomial`", name.span.clone(), entries, &["coefficients", "a", "b", "c"]);
    let spelled: Vec<&Entry<'_>> = ["a", "b", "c"].iter().filter_map(|key| fields.get(key)).collect();
    if let Some(preset) = fields.get("coefficients") {
        if let Some(first) = spelled.first() {
            conflict(decoder, &preset.key, &first.key, "a published set, or `a`, `b` and `c`");
            return None;
        }
        let model = match choice(decoder, &preset.value, "coefficients", &["Liang2023", "Liang2023Printed"])?
        {
            "Liang2023" => PolynomialModel::LIANG_2023,
            _ => PolynomialModel::LIANG_2023_PRINTED,
        };
        return Decoded::new(Model::Polynomial(model), BTreeMap::new());
    }
    if spelled.is_empty() {
        let help = "add `coefficients: Liang2023`, or the groups `a: (…)`, `b: (…)` and `c: (…)`";
        decoder.missing("`Polynomial`", &name.span, "coefficients", help);
        return None;
    }
    let mut spans = BTreeMap::new();
    let a = group(decoder, &fields, "a", "`a`", &["linear", "amplitude", "decades"], &mut spans);
    let b = group(
        decoder,
        &fields,
        "b",
        "`b`",
        &["scale", "curvature", "pivot", "offset", "exponent"],
        &mut spans,
    );
    let c = group(decoder, &fields, "c", "`c`", &["amplitude", "rate", "offset"], &mut spans);
    let (a, b, c) = (a?, b?, c?);
    let model = PolynomialModel {
        a: PolynomialA { linear: a[0], amplitude: a[1], decades: a[2] },
        b: PolynomialB { scale: b[0], curvature: b[1], pivot: b[2], offset: b[3], exponent: b[4] },
        c: PolynomialC { amplitude: c[0], rate: c[1], offset: c[2] },
    };
    Decoded::new(Model::Polynomial(model), spans)
}

/// A group of named numbers, such as `a: (linear: …, amplitude: …, decades: …)`.
fn group(
    decoder: &mut Decoder,
    fields: &Fields<'_>,
    key: &'static str,
    owner: &'static str,
    names: &'static [&'static str],
    spans: &mut BTreeMap<String, Span>,
) -> Option<Vec<f64>> {
    let form: Vec<String> = names.iter().map(|name| format!("{name}: …")).collect();
    let form = format!("({})", form.join(", "));
    fields.required(decoder, key, &format!("add `{key}: {form}`"), |decoder, node| {
        let Shape::Struct(None, entries) = node.shape() else {
            decoder.wrong_type(node, key, "named numbers", format!("write `{key}: {form}`"));
            return None;
        };
        spans.insert(key.to_owned(), node.span());
        let inner = decoder.fields(owner, head(None, node), entries, names);
        let prefix = format!("{key}.");
        let numbers: Vec<Option<f64>> =
            names.iter().map(|name| coefficient(decoder, &inner, spans, &prefix, name)).collect();
        numbers.into_iter().collect()
    })
}

fn conflict(decoder: &mut Decoder, one: &Name<'_>, other: &Name<'_>, choice: &str) {
    decoder.report(
        Diagnostic::error(format!("`{}` and `{}` exclude each other", one.text, other.text))
            .label(one.span.clone(), "given here")
            .secondary(other.span.clone(), "and here")
            .help(format!("give either {choice}")),
    );
}

fn exponential_dipole(decoder: &mut Decoder, name: &Name<'_>, entries: Vec<Entry<'_>>) -> Option<Decoded> {
    const LISTS: [&str; 4] =
        ["exponential_weight", "exponential_length", "dipole_depth", "dipole_attenuation"];
    const FIELDS: [&str; 5] =
        ["entry", "exponential_weight", "exponential_length", "dipole_depth", "dipole_attenuation"];
    const FORM: &str = "(constant, linear, quadratic)";
    let fields = decoder.fields("`ExponentialDipole`", name.span.clone(), entries, &FIELDS);
    let spelled = LISTS.iter().find_map(|key| fields.get(key));
    if let Some(entry) = fields.get("entry") {
        if let Some(first) = spelled {
            conflict(decoder, &entry.key, &first.key, "an entry, or all four lists of coefficients");
            return None;
        }
        let model = match choice(decoder, &entry.value, "entry", &["Searchlight", "Diffuse"])? {
            "Searchlight" => ExponentialDipoleModel::SEARCHLIGHT,
            _ => ExponentialDipoleModel::DIFFUSE,
        };
        return Decoded::new(Model::ExponentialDipole(model), BTreeMap::new());
    }
    if spelled.is_none() {
        let help = format!("add `entry: Searchlight` or `entry: Diffuse`, or all of {}", list(LISTS));
        decoder.missing("`ExponentialDipole`", &name.span, "entry", help);
        return None;
    }
    let mut spans = BTreeMap::new();
    let lists = LISTS.map(|key| {
        let help = format!("add `{key}: {FORM}`, the coefficients of 1, A and A²");
        fields.required(decoder, key, &help, |decoder, node| {
            let triple = decoder.triple(node, key, FORM, &COEFFICIENT)?;
            spans.insert(key.to_owned(), triple.span.clone());
            Some(triple.values)
        })
    });
    let [Some(exponential_weight), Some(exponential_length), Some(dipole_depth), Some(dipole_attenuation)] =
        lists
    else {
        return None;
    };
    let model =
        ExponentialDipoleModel { exponential_weight, exponential_length, dipole_depth, dipole_attenuation };
    Decoded::new(Model::ExponentialDipole(model), spans)
}

fn two_exponential_dipole(
    decoder: &mut Decoder,
    name: &Name<'_>,
    entries: Vec<Entry<'_>>,
) -> Option<Decoded> {
    const LISTS: [&str; 4] =
        ["exponential_weight", "exponential_length", "dipole_depth", "dipole_attenuation"];
    const NUMBERS: [&str; 4] = ["short_weight", "short_length", "second_weight", "second_depth"];
    const ENTRIES: [&str; 4] = ["Searchlight", "Diffuse", "SearchlightEta1_4", "DiffuseEta1_4"];
    const FORM: &str = "(constant, linear, quadratic, cubic)";
    let known: Vec<&'static str> = std::iter::once("entry").chain(LISTS).chain(NUMBERS).collect();
    let fields = decoder.fields("`TwoExponentialDipole`", name.span.clone(), entries, &known);
    let spelled = LISTS.iter().chain(&NUMBERS).find_map(|key| fields.get(key));
    if let Some(entry) = fields.get("entry") {
        if let Some(first) = spelled {
            conflict(decoder, &entry.key, &first.key, "an entry, or all the coefficients");
            return None;
        }
        let model = match choice(decoder, &entry.value, "entry", &ENTRIES)? {
            "Searchlight" => TwoExponentialDipoleModel::SEARCHLIGHT,
            "Diffuse" => TwoExponentialDipoleModel::DIFFUSE,
            "SearchlightEta1_4" => TwoExponentialDipoleModel::SEARCHLIGHT_ETA_1_4,
            _ => TwoExponentialDipoleModel::DIFFUSE_ETA_1_4,
        };
        return Decoded::new(Model::TwoExponentialDipole(model), BTreeMap::new());
    }
    if spelled.is_none() {
        let all = LISTS.into_iter().chain(NUMBERS);
        let help = format!("add `entry: …`, one of {}, or all of {}", list(ENTRIES), list(all));
        decoder.missing("`TwoExponentialDipole`", &name.span, "entry", help);
        return None;
    }
    let mut spans = BTreeMap::new();
    let lists = LISTS.map(|key| {
        let help = format!("add `{key}: {FORM}`, the coefficients of 1, x, x² and x³, x = 6A/(1 + 5A)");
        fields.required(decoder, key, &help, |decoder, node| {
            spans.insert(key.to_owned(), node.span());
            decoder.quadruple(node, key, FORM, &COEFFICIENT)
        })
    });
    let numbers = NUMBERS.map(|key| coefficient(decoder, &fields, &mut spans, "", key));
    let (
        [Some(exponential_weight), Some(exponential_length), Some(dipole_depth), Some(dipole_attenuation)],
        [Some(short_weight), Some(short_length), Some(second_weight), Some(second_depth)],
    ) = (lists, numbers)
    else {
        return None;
    };
    let model = TwoExponentialDipoleModel {
        exponential_weight,
        exponential_length,
        dipole_depth,
        dipole_attenuation,
        short_weight,
        short_length,
        second_weight,
        second_depth,
    };
    Decoded::new(Model::TwoExponentialDipole(model), spans)
}

fn gaussian_sum(decoder: &mut Decoder, node: &Node<'_>) -> Option<Decoded> {
    let Shape::List(nodes) = node.shape() else {
        let help = format!("for example `{}`", example("GaussianSum"));
        decoder.wrong_type(node, "GaussianSum", "a list of Gaussians", help);
        return None;
    };
    if nodes.is_empty() {
        decoder.report(
            Diagnostic::error("the list of Gaussians is empty")
                .label(node.span(), "expected at least one Gaussian")
                .help(format!("for example `{}`", example("GaussianSum"))),
        );
        return None;
    }
    let terms: Vec<_> = nodes.iter().map(|node| gaussian_term(decoder, node)).collect();
    let terms = terms.into_iter().collect::<Option<_>>()?;
    Decoded::new(Model::GaussianSum(GaussianSumModel { terms }), BTreeMap::new())
}

fn gaussian_term(decoder: &mut Decoder, node: &Node<'_>) -> Option<GaussianTerm> {
    let Shape::Struct(name, entries) = node.shape() else {
        let help = "write `(variance_mm2: 1.0, weight: (0.3, 0.2, 0.1))`";
        decoder.wrong_type(node, "GaussianSum", "a Gaussian `(variance_mm2: …, weight: …)`", help);
        return None;
    };
    let head = head(name.as_ref(), node);
    let fields = decoder.fields("a Gaussian", head, entries, &["variance_mm2", "weight"]);
    let variance =
        fields.required(decoder, "variance_mm2", "add `variance_mm2: …`, in mm²", |decoder, node| {
            decoder.number(node, "variance_mm2", &VARIANCE)
        });
    let help = "add `weight: (red, green, blue)`, or one number for all three";
    let weight = fields.required(decoder, "weight", help, |decoder, node| match node.shape() {
        Shape::Number(_) => {
            let weight = decoder.number(node, "weight", &WEIGHT)?;
            Some([weight; 3])
        }
        _ => decoder.triple(node, "weight", "(red, green, blue)", &WEIGHT).map(|triple| triple.values),
    });
    Some(GaussianTerm { variance_mm2: variance?, weight: weight? })
}

fn tabulated(decoder: &mut Decoder, name: &Name<'_>, entries: Vec<Entry<'_>>) -> Option<Decoded> {
    const HELP: &str = "add `file: \"my_table.csv\"`, a CSV file beside this one";
    let fields = decoder.fields("`Tabulated`", name.span.clone(), entries, &["file"]);
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
    Decoded::new(Model::Tabulated(model), BTreeMap::from([("file".to_owned(), file.span)]))
}

/// All that is wrong with the coefficients, and the first surface albedo at which they give no profile.
fn model_errors(model: &Model) -> Vec<ModelError> {
    let errors = model.errors();
    if !errors.is_empty() {
        return errors;
    }
    let at = |surface_albedo| {
        let medium = Medium::new(surface_albedo, 1.0).ok()?;
        model.profile(medium, Channel::Red).err()
    };
    probed_surface_albedos().find_map(at).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_published_model_has_a_profile_at_every_probed_surface_albedo() {
        for stem in Model::PUBLISHED {
            let model = Model::published(stem).expect("its own list");
            assert_eq!(model_errors(&model), [], "{stem}");
        }
    }
}
