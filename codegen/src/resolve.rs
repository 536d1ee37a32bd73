//! Puts the files of a set together: bases, profiles by name, and what only several files together can get wrong.

mod chain;
mod cycle;
mod lobe;

use std::collections::{BTreeMap, BTreeSet};

use subsurface_profile::{Channel, Length, Medium};

use crate::clear::ClearMaterial;
use crate::diagnostics::Diagnostic;
use crate::draft::Draft;
use crate::identifier::{self, camel_case, screaming_case};
use crate::lint;
use crate::material::{Coupling, Material, ResolvedProfile, SecondLobe, Transmittance};
use crate::quality_request::QualityRequest;
use crate::schema::{
    ClearFile, DiffuseGiven, Given, LengthGiven, MaterialFile, OrMedium, ProfileExpression, ProfileFile, SET,
    SetFile, Triple, clear_medium, reflectance_at_normal, rounded,
};
use crate::source::{FileId, Span, Spanned};
use crate::suggestion::{closest, list, shortened};
use subsurface_kernel::Estimator;
use subsurface_kernel::Rejection;

pub(crate) use chain::{ChainEnd, chain, unknown_profile};
use chain::{check_aliases, profile_names};

/// Specular reflectance at normal incidence when a material gives none: skin, n = 1.4 (L23 §5).
const DEFAULT_REFLECTANCE_AT_NORMAL: f64 = 0.028;
/// Perceptual roughness when a material gives none.
const DEFAULT_ROUGHNESS: f64 = 0.40;
/// Transmission strength when a material gives none: what its `transmittance` says.
const DEFAULT_TRANSMISSION_STRENGTH: f64 = 1.0;
/// Materials named in the labels of an error in a profile that they use.
const MOST_USERS: usize = 3;
/// Names that a help text lists.
const MOST_NAMES: usize = 16;

/// The decoded files of one set.
#[derive(Debug, Default)]
pub(crate) struct Files {
    /// Sorted by path.
    pub(crate) materials: Vec<MaterialFile>,
    /// Sorted by path.
    pub(crate) clear: Vec<ClearFile>,
    /// Stems of material files with an error that hides all their fields.
    pub(crate) broken_materials: BTreeSet<String>,
    /// The files of the set itself: one, or none.
    pub(crate) sets: Vec<SetFile>,
    /// By stem.
    pub(crate) profiles: BTreeMap<String, ProfileFile>,
    /// The folder of the profiles, as displayed.
    pub(crate) profiles_folder: String,
}

/// What the files of a set amount to.
#[derive(Debug, Default)]
pub(crate) struct Resolution {
    /// The materials without errors, sorted by name.
    pub(crate) materials: Vec<Material>,
    /// The clear ones without errors, sorted by name.
    pub(crate) clear: Vec<ClearMaterial>,
    /// What the set's own file chooses, or the defaults.
    pub(crate) estimator: Estimator,
    pub(crate) rejection: Rejection,
    pub(crate) quality: Option<QualityRequest>,
    /// Whether there is a file for a material, good or bad.
    pub(crate) has_materials: bool,
    /// Whether there is a file for a clear one.
    pub(crate) has_clear: bool,
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// The files that each file of a material leans on: bases and profiles.
    pub(crate) dependencies: BTreeMap<FileId, BTreeSet<FileId>>,
    users: BTreeMap<FileId, Vec<(String, Span)>>,
}

/// The fields of a material, its own or those of its nearest base that gives them.
#[derive(Clone, Copy)]
struct Inherited<'a> {
    profile: &'a Given<(ProfileExpression, Span)>,
    length: &'a Given<OrMedium<LengthGiven>>,
    surface_albedo: &'a Given<OrMedium<Triple>>,
    surface_albedo_mix: &'a Given<Spanned<f64>>,
    refractive_index: &'a Given<Spanned<f64>>,
    reflectance_at_normal: &'a Given<Spanned<f64>>,
    roughness: &'a Given<Spanned<f64>>,
    coupling: &'a Given<Coupling>,
    second_lobe: &'a Given<Option<SecondLobe>>,
    diffuse: &'a Given<Spanned<DiffuseGiven>>,
    transmission_strength: &'a Given<Spanned<f64>>,
    transmission_diffused: &'a Given<bool>,
    transmittance: &'a Given<Spanned<Transmittance>>,
    thin_thickness_mm: &'a Given<Spanned<f64>>,
    /// Whether every base exists.
    complete: bool,
}

impl Resolution {
    /// Resolves all names among `files`.
    pub(crate) fn of(files: &Files) -> Self {
        let has_materials = !(files.materials.is_empty() && files.broken_materials.is_empty());
        let has_clear = !files.clear.is_empty();
        let mut resolution = Self { has_materials, has_clear, ..Self::default() };
        let by_name = resolution.name_materials(files);
        let alias_errors = check_aliases(files);
        resolution.check_bases(files, &by_name);
        for material in &files.materials {
            let inherited = resolution.inherit(&by_name, material);
            if let Some(draft) = resolution.draft(files, material, inherited)
                && by_name
                    .get(material.name.value.as_str())
                    .is_some_and(|first| std::ptr::eq(*first, material))
            {
                lint::check(&draft, &mut resolution.diagnostics);
                resolution.materials.push(finish(material, draft));
            }
        }
        resolution.materials.sort_by(|a, b| a.name.cmp(&b.name));
        resolution.take_clear(files);
        let alias_errors: Vec<_> =
            alias_errors.into_iter().map(|error| resolution.name_users(error)).collect();
        resolution.diagnostics.extend(alias_errors);
        resolution.choose(&files.sets);
        resolution
    }

    /// Takes the clear materials; reports names that are taken.
    fn take_clear(&mut self, files: &Files) {
        let mut names: BTreeMap<String, &Span> = BTreeMap::new();
        let scattering = files.materials.iter().map(|material| &material.name);
        for name in scattering.chain(files.clear.iter().map(|clear| &clear.name)) {
            if let Some(first) = names.get(&screaming_case(&name.value)) {
                // Two materials that scatter are reported elsewhere.
                if files.clear.iter().any(|clear| std::ptr::eq(&clear.name, name)) {
                    self.diagnostics.push(
                        Diagnostic::error(format!(
                            "two materials have the name `{}`",
                            shortened(&name.value)
                        ))
                        .label(name.span.clone(), "this name is taken")
                        .secondary((*first).clone(), "first used here")
                        .help("rename one of the files, or give one a `name: \"…\"` of its own"),
                    );
                }
                continue;
            }
            names.insert(screaming_case(&name.value), &name.span);
        }
        self.clear = files.clear.iter().filter_map(|clear| clear.material.clone()).collect();
        self.clear.sort_by(|a, b| a.name.cmp(&b.name));
    }

    /// Takes what the set's own file chooses; reports a second such file.
    fn choose(&mut self, sets: &[SetFile]) {
        let Some((first, others)) = sets.split_first() else { return };
        self.estimator = first.estimator.value().copied().unwrap_or_default();
        self.rejection = first.rejection.value().copied().unwrap_or_default();
        self.quality = first.quality.value().cloned();
        for other in others {
            let diagnostic = Diagnostic::error("two files describe this set")
                .label(other.head.clone(), "a set is described once")
                .secondary(first.head.clone(), "first described here")
                .help(format!("keep one file with `{SET}(…)`, by convention `set.ron`"));
            self.diagnostics.push(diagnostic);
        }
    }

    /// Adds to each error within a profile file the materials that use it.
    pub(crate) fn name_users(&self, mut diagnostic: Diagnostic) -> Diagnostic {
        // An error in a table has its second place in the profile that names the table.
        let mut places = diagnostic.primary.iter().chain(&diagnostic.secondary);
        let users = places.find_map(|(span, _)| self.users.get(&span.file));
        if let Some(users) = users {
            let shown = users.len().min(MOST_USERS);
            for (index, (name, span)) in users.iter().take(shown).enumerate() {
                let more = users.len() - shown;
                let and_more =
                    if more > 0 && index + 1 == shown { format!(" and {more} more") } else { String::new() };
                diagnostic =
                    diagnostic.secondary(span.clone(), format!("used by material `{name}`{and_more}"));
            }
        }
        diagnostic
    }

    /// A material's file and all files it leans on.
    pub(crate) fn files_behind(&self, file: FileId) -> BTreeSet<FileId> {
        let mut files = self.dependencies.get(&file).cloned().unwrap_or_default();
        files.insert(file);
        files
    }

    /// Materials by name; reports names that are taken.
    fn name_materials<'a>(&mut self, files: &'a Files) -> BTreeMap<&'a str, &'a MaterialFile> {
        let mut by_name: BTreeMap<&str, &MaterialFile> = BTreeMap::new();
        let mut by_identifier: BTreeMap<String, &MaterialFile> = BTreeMap::new();
        for material in &files.materials {
            let name = material.name.value.as_str();
            if let Some(first) = by_name.get(name) {
                let diagnostic =
                    Diagnostic::error(format!("two materials have the name `{}`", shortened(name)))
                        .label(material.name.span.clone(), "this name is taken")
                        .secondary(first.name.span.clone(), "first used here")
                        .help("rename one of the files, or give one a `name: \"…\"` of its own");
                self.diagnostics.push(diagnostic);
                continue;
            }
            by_name.insert(name, material);
            if identifier::check(name).is_err() {
                continue; // reported, and no identifier comes of it
            }
            // The variant in Rust and the constant in WGSL; no variant has an underscore, so the two never meet.
            let identifiers = [camel_case(name), format!("MATERIAL_{}", screaming_case(name))];
            let taken = identifiers.iter().find_map(|key| Some((key, *by_identifier.get(key)?)));
            if let Some((identifier, first)) = taken {
                let other = &first.name.value;
                let diagnostic = Diagnostic::error(format!("the names `{other}` and `{name}` are too alike"))
                    .label(
                        material.name.span.clone(),
                        format!("becomes `{identifier}` in the generated code"),
                    )
                    .secondary(first.name.span.clone(), format!("becomes `{identifier}` as well"))
                    .help("choose names that differ in more than capitals and underscores");
                self.diagnostics.push(diagnostic);
            }
            for key in identifiers {
                by_identifier.entry(key).or_insert(material);
            }
        }
        by_name
    }

    /// Reports materials that inherit from each other in a circle, or from nothing.
    fn check_bases(&mut self, files: &Files, by_name: &BTreeMap<&str, &MaterialFile>) {
        let mut edges = BTreeMap::new();
        for (name, material) in by_name {
            let Some(base) = material.base.value() else { continue };
            if by_name.contains_key(base.value.as_str()) {
                edges.insert(*name, (base.value.as_str(), &base.span));
            } else if !files.broken_materials.contains(&base.value) {
                let names = || by_name.keys().copied().filter(|other| other != name);
                let mut diagnostic =
                    Diagnostic::error(format!("unknown base material `{}`", shortened(&base.value)))
                        .label(base.span.clone(), "no material of this set has this name");
                if let Some(meant) = closest(&base.value, names()) {
                    diagnostic = diagnostic.help(format!("did you mean `{meant}`?"));
                }
                self.diagnostics
                    .push(diagnostic.help(format!("the other materials are {}", some_of(names()))));
            }
        }
        for cycle in cycle::find(&edges) {
            let diagnostic = cycle::describe(&cycle, &edges, "material", "is its own base", "is based on");
            self.diagnostics
                .push(diagnostic.help("remove `base` from one of these materials and give it all fields"));
        }
    }

    fn inherit<'a>(
        &mut self,
        by_name: &BTreeMap<&str, &'a MaterialFile>,
        material: &'a MaterialFile,
    ) -> Inherited<'a> {
        fn first<'a, T>(own: &'a Given<T>, base: &'a Given<T>) -> &'a Given<T> {
            if own.is_absent() { base } else { own }
        }
        let mut inherited = Inherited {
            profile: &material.profile,
            length: &material.length,
            surface_albedo: &material.surface_albedo,
            surface_albedo_mix: &material.surface_albedo_mix,
            refractive_index: &material.refractive_index,
            reflectance_at_normal: &material.reflectance_at_normal,
            roughness: &material.roughness,
            coupling: &material.coupling,
            second_lobe: &material.second_lobe,
            diffuse: &material.diffuse,
            transmission_strength: &material.transmission_strength,
            transmission_diffused: &material.transmission_diffused,
            transmittance: &material.transmittance,
            thin_thickness_mm: &material.thin_thickness_mm,
            complete: true,
        };
        let mut seen = BTreeSet::from([material.file]);
        let mut current = material;
        loop {
            let base = match &current.base {
                Given::Absent => return inherited,
                Given::Bad => break,
                Given::Value(base) => base,
            };
            let Some(next) = by_name.get(base.value.as_str()) else { break };
            if !seen.insert(next.file) {
                break;
            }
            self.depends(material.file, next.file);
            inherited = Inherited {
                profile: first(inherited.profile, &next.profile),
                length: first(inherited.length, &next.length),
                surface_albedo: first(inherited.surface_albedo, &next.surface_albedo),
                surface_albedo_mix: first(inherited.surface_albedo_mix, &next.surface_albedo_mix),
                refractive_index: first(inherited.refractive_index, &next.refractive_index),
                reflectance_at_normal: first(inherited.reflectance_at_normal, &next.reflectance_at_normal),
                roughness: first(inherited.roughness, &next.roughness),
                coupling: first(inherited.coupling, &next.coupling),
                second_lobe: first(inherited.second_lobe, &next.second_lobe),
                diffuse: first(inherited.diffuse, &next.diffuse),
                transmission_strength: first(inherited.transmission_strength, &next.transmission_strength),
                transmission_diffused: first(inherited.transmission_diffused, &next.transmission_diffused),
                transmittance: first(inherited.transmittance, &next.transmittance),
                thin_thickness_mm: first(inherited.thin_thickness_mm, &next.thin_thickness_mm),
                complete: true,
            };
            current = next;
        }
        inherited.complete = false;
        inherited
    }

    /// The material with everything looked up; `None` when something was wrong, which has been reported then.
    fn draft<'a>(
        &mut self,
        files: &Files,
        material: &'a MaterialFile,
        inherited: Inherited<'a>,
    ) -> Option<Draft<'a>> {
        if inherited.complete {
            self.report_missing(files, material, &inherited);
        }
        // Looked up even when another field is bad, so that an unknown name is reported in the same run.
        let profile = match inherited.profile {
            Given::Value((expression, span)) => self.profile(files, material, expression, span),
            Given::Absent | Given::Bad => None,
        };
        let (profile, profile_name) = profile?;
        let diffuse = self.diffuse(&profile, inherited.diffuse.value())?;
        let coupling = self.coupling(inherited.diffuse.value(), inherited.coupling.value().copied())?;
        let length = match inherited.length.value()? {
            OrMedium::Value(length) => length.clone(),
            OrMedium::Medium(medium) => medium.length(profile.model.length()),
        };
        if let Some(channel) = length.value.values.iter().position(|value| value.is_infinite()) {
            self.diagnostics.push(clear_medium(&length, inherited.surface_albedo.value(), channel));
            return None;
        }
        let surface_albedo = match inherited.surface_albedo.value()? {
            OrMedium::Value(surface_albedo) => surface_albedo.clone(),
            OrMedium::Medium(medium) => medium.surface_albedo(self.entry(&profile, diffuse, &medium.key)),
        };
        let numbers = [
            inherited.surface_albedo_mix,
            inherited.reflectance_at_normal,
            inherited.roughness,
            inherited.transmission_strength,
            inherited.thin_thickness_mm,
        ];
        let optional_is_bad = inherited.transmittance.is_bad()
            || inherited.coupling.is_bad()
            || inherited.second_lobe.is_bad()
            || inherited.transmission_diffused.is_bad()
            || inherited.diffuse.is_bad()
            || numbers.iter().any(|field| field.is_bad());
        let usable = self.check_length(&profile, &length, &surface_albedo, profile_name)
            && self.check_profile(&profile, &length, &surface_albedo, profile_name);
        let thin = inherited.thin_thickness_mm.value().filter(|thickness| thickness.value > 0.0);
        let fits = self.check_thin(inherited.transmittance.value(), thin);
        (usable && fits && inherited.complete && !optional_is_bad).then_some(Draft {
            name: &material.name.value,
            profile,
            profile_name,
            length,
            surface_albedo,
            surface_albedo_mix: inherited.surface_albedo_mix.value(),
            refractive_index: inherited.refractive_index.value(),
            reflectance_at_normal: inherited.reflectance_at_normal.value(),
            roughness: inherited.roughness.value(),
            coupling,
            second_lobe: inherited.second_lobe.value().copied().flatten(),
            diffuse,
            diffuse_given: inherited.diffuse.value(),
            transmission_strength: inherited.transmission_strength.value(),
            transmission_diffused: inherited.transmission_diffused.value().copied().unwrap_or_default(),
            transmittance: inherited.transmittance.value(),
            thin_thickness_mm: thin,
        })
    }

    fn report_missing(&mut self, files: &Files, material: &MaterialFile, inherited: &Inherited<'_>) {
        let profiles = || some_of(profile_names(files));
        let missing = [
            (
                inherited.profile.is_absent(),
                "profile",
                format!(
                    "add `profile: \"two_exponential_dipole_searchlight\"`, or another: the profiles are {}",
                    profiles()
                ),
            ),
            (
                inherited.length.is_absent(),
                "mean_free_path_mm",
                "add `mean_free_path_mm: (red, green, blue)`, the mean free path 1/(σs′ + σa) in mm; or `medium`, its \
                 coefficients"
                    .to_owned(),
            ),
            (
                inherited.surface_albedo.is_absent(),
                "surface_albedo",
                "add `surface_albedo: (red, green, blue)`, the share of light reflected, from 0 to 1"
                    .to_owned(),
            ),
        ];
        for (is_missing, field, help) in missing {
            if is_missing {
                let mut diagnostic = Diagnostic::error(format!("missing field `{field}`"))
                    .label(material.head.clone(), format!("`Material` needs `{field}`"))
                    .help(help);
                if let Some(base) = material.base.value() {
                    diagnostic = diagnostic.secondary(base.span.clone(), "this base does not give it either");
                }
                self.diagnostics.push(diagnostic);
            }
        }
    }

    /// Follows names to a model.
    fn profile<'a>(
        &mut self,
        files: &Files,
        material: &MaterialFile,
        expression: &'a ProfileExpression,
        span: &'a Span,
    ) -> Option<(ResolvedProfile, Option<&'a Span>)> {
        let target = match expression {
            ProfileExpression::Inline(inline) => {
                let profile = ResolvedProfile {
                    stem: None,
                    model: inline.model.clone(),
                    docs: Vec::new(),
                    span: inline.head.clone(),
                    coefficient_spans: inline.coefficients.clone(),
                };
                return Some((profile, None));
            }
            ProfileExpression::Named(target) => target,
        };
        let chain = chain(files, &target.value);
        for file in &chain.files {
            self.depends(material.file, *file);
            self.users.entry(*file).or_default().push((material.name.value.clone(), span.clone()));
        }
        match chain.end {
            ChainEnd::Model(profile) => Some((*profile, Some(span))),
            ChainEnd::Published(stem, model) => {
                let profile = ResolvedProfile {
                    stem: Some(stem),
                    model,
                    docs: Vec::new(),
                    span: span.clone(),
                    coefficient_spans: Default::default(),
                };
                Some((profile, None))
            }
            ChainEnd::Unknown if chain.files.is_empty() => {
                self.diagnostics.push(unknown_profile(files, target));
                None
            }
            // Reported where the last file of the chain is checked.
            ChainEnd::Unknown | ChainEnd::Broken => None,
        }
    }

    /// Whether the given length is one that the profile can use.
    fn check_length(
        &mut self,
        profile: &ResolvedProfile,
        length: &LengthGiven,
        surface_albedo: &Triple,
        profile_name: Option<&Span>,
    ) -> bool {
        let scales = profile.model.dependence().on_length();
        if !scales || length.kind == profile.model.length() || length.kind == Length::MeanFreePath {
            return true; // a mean free path given as the diffuse one is a lint: the field's name is the usual one
        }
        let converted = [0, 1, 2].map(|index| {
            let factor = lint::diffuse_per_mean_free_path(surface_albedo.values[index]);
            rounded(length.value.values[index] / factor)
        });
        let mut diagnostic = Diagnostic::error("this profile takes the mean free path, not the diffuse one")
            .label(length.key.clone(), "the profile is not parametrized by this length")
            .help(format!(
                "with ℓ = ℓ_d √(3 (1 - α)/(2 - α)) and this surface albedo, write `mean_free_path_mm: ({})`",
                converted.join(", ")
            ))
            .help("or use a profile that takes it: `\"burley_dmfp\"`");
        if let Some(span) = profile_name {
            diagnostic = diagnostic.secondary(span.clone(), "the profile is named here");
        }
        self.diagnostics.push(diagnostic);
        false
    }

    /// Whether the model has a profile for this very medium.
    fn check_profile(
        &mut self,
        profile: &ResolvedProfile,
        length: &LengthGiven,
        surface_albedo: &Triple,
        profile_name: Option<&Span>,
    ) -> bool {
        let error = Channel::ALL.into_iter().find_map(|channel| {
            let index = channel.index();
            match Medium::new(surface_albedo.values[index], length.value.values[index]) {
                Ok(medium) => {
                    profile.model.profile(medium, channel).err().map(|error| (index, error.to_string()))
                }
                Err(error) => Some((index, error.to_string())),
            }
        });
        let Some((index, error)) = error else { return true };
        let mut diagnostic = Diagnostic::error(format!("this material has no profile: {error}"))
            .label(profile.span.clone(), "the model fails for this medium")
            .secondary(surface_albedo.spans[index].clone(), "at this surface albedo")
            .secondary(length.value.spans[index].clone(), "and this length")
            .help("change the coefficients of the model, or use a published profile");
        if let Some(span) = profile_name {
            diagnostic = diagnostic.secondary(span.clone(), "used here");
        }
        self.diagnostics.push(diagnostic);
        false
    }

    /// Whether the law of transmittance is one that a sheet can have.
    fn check_thin(&mut self, law: Option<&Spanned<Transmittance>>, thin: Option<&Spanned<f64>>) -> bool {
        let (Some(law), Some(thin)) = (law.filter(|law| law.value == Transmittance::Profile), thin) else {
            return true;
        };
        self.diagnostics.push(
            Diagnostic::error("a thin sheet lets through what a slab does")
                .label(law.span.clone(), "this law is for what is thick")
                .secondary(thin.span.clone(), "the sheet is given here")
                .help("remove `transmittance: Profile`, or remove `thin`"),
        );
        false
    }

    fn depends(&mut self, file: FileId, on: FileId) {
        self.dependencies.entry(file).or_default().insert(on);
    }
}

fn finish(file: &MaterialFile, draft: Draft<'_>) -> Material {
    let number = |field: Option<&Spanned<f64>>, default| field.map_or(default, |field| field.value);
    Material {
        name: draft.name.to_owned(),
        docs: file.docs.clone(),
        mean_free_path_mm: draft.length.value.values,
        surface_albedo: draft.surface_albedo.values,
        surface_albedo_mix: number(draft.surface_albedo_mix, 0.0),
        refractive_index: draft.refractive_index.map(|index| index.value),
        reflectance_at_normal: number(
            draft.reflectance_at_normal,
            draft
                .refractive_index
                .map_or(DEFAULT_REFLECTANCE_AT_NORMAL, |index| reflectance_at_normal(index.value)),
        ),
        roughness: number(draft.roughness, DEFAULT_ROUGHNESS),
        second_lobe: draft.second_lobe,
        coupling: draft.coupling,
        diffuse: draft.diffuse,
        transmission_strength: number(draft.transmission_strength, DEFAULT_TRANSMISSION_STRENGTH),
        transmission_diffused: draft.transmission_diffused,
        transmittance: draft
            .transmittance
            .map_or_else(|| Transmittance::of_model(&draft.profile.model), |law| law.value),
        thin_thickness_mm: draft.thin_thickness_mm.map(|thickness| thickness.value),
        span: file.head.clone(),
        profile: draft.profile,
    }
}

/// A list of names that does not grow without limit.
fn some_of<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    match names.get(MOST_NAMES..) {
        Some(rest) if !rest.is_empty() => {
            let first: Vec<String> = names[..MOST_NAMES].iter().map(|name| format!("`{name}`")).collect();
            format!("{} and {} more", first.join(", "), rest.len())
        }
        _ => list(names),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lists_of_names_end() {
        let names: Vec<String> = (0..100).map(|index| format!("n{index}")).collect();
        assert!(some_of(names.iter().map(String::as_str)).ends_with("and 84 more"));
    }
}
