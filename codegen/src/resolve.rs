//! Puts the files of a set together: bases, profiles by name, and what only several files together can get wrong.

mod chain;
mod checks;
mod clear;
mod cycle;
mod inherit;
mod lobe;

use std::collections::{BTreeMap, BTreeSet};

use crate::clear::ClearMaterial;
use crate::diagnostics::Diagnostic;
use crate::draft::Draft;
use crate::identifier::{self, camel_case, screaming_case};
use crate::lint;
use crate::material::{Material, ResolvedProfile, Transmittance};
use crate::quality_request::QualityRequest;
use crate::schema::{
    ClearFile, Given, MaterialFile, OrMedium, ProfileExpression, ProfileFile, SET, SetFile, clear_medium,
    reflectance_at_normal,
};
use crate::source::{FileId, Span, Spanned};
use crate::suggestion::{closest, list, shortened};
use subsurface_kernel::Estimator;
use subsurface_kernel::Rejection;

use inherit::Inherited;

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
