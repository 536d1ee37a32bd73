//! Reads material files from disk or memory, and reports on them.

mod reader;
mod tables;

use std::path::{Path, PathBuf};

use crate::diagnostics::Diagnostic;
use crate::material::{MaterialSet, ResolvedProfile};
use crate::report::Report;
use crate::resolve::{ChainEnd, Files, Resolution, chain, unknown_profile};
use crate::schema::{
    CLEAR, ClearFile, Decoder, MaterialFile, ProfileExpression, ProfileFile, SCHEMA_VERSION as VERSION, SET,
    SetFile, decode_clear, decode_material, decode_profile_file, decode_set_file,
};
use crate::source::{FileId, Span, Spanned};
use crate::suggestion::list;
use crate::syntax::{self, Document};

pub use crate::table::LARGEST_TABLE;
pub use reader::LARGEST_FILE;
use reader::Reader;
pub use tables::LoadedTable;
use tables::TablesBeside;
pub use tables::load_radial_table;

/// Version of the grammar of material files that this crate reads: the largest `version` it accepts.
pub const SCHEMA_VERSION: u32 = VERSION;

/// Folder of a materials directory that holds profile files.
const PROFILES: &str = "profiles";

/// What came of reading materials.
#[derive(Debug, Default)]
pub struct Loaded {
    /// The checked materials; `None` when there are errors.
    pub set: Option<MaterialSet>,
    /// Errors and warnings, with the text they point into.
    pub report: Report,
    /// Every file that was read, or that could not be read, sorted: what a build depends on.
    pub files_read: Vec<PathBuf>,
    /// Every directory that was listed, sorted: a file added there changes the result.
    pub directories_read: Vec<PathBuf>,
}

/// What came of reading one profile.
#[derive(Debug, Default)]
pub struct LoadedProfile {
    /// The checked profile; `None` when there are errors.
    pub profile: Option<ResolvedProfile>,
    /// Errors and warnings, with the text they point into.
    pub report: Report,
    /// Every file that was read, sorted.
    pub files_read: Vec<PathBuf>,
}

/// What came of checking paths.
#[derive(Debug, Default)]
pub struct Checked {
    /// Errors and warnings, with the text they point into.
    pub report: Report,
    /// Every file that was read, sorted.
    pub files_read: Vec<PathBuf>,
}

/// Reads every material in `dir` and every profile in `dir/profiles`: all files whose extension is `ron`. One of those
/// in `dir` may describe the set: `MaterialSet(…)`.
#[must_use]
pub fn load_directory(dir: &Path) -> Loaded {
    load(Reader::disk(), dir)
}

/// Reads a material set from memory; paths are relative to the materials directory (`skin.ron`,
/// `profiles/wax_like.ron`).
#[must_use]
pub fn load_memory<P: AsRef<Path>, B: AsRef<[u8]>>(files: impl IntoIterator<Item = (P, B)>) -> Loaded {
    let files = files
        .into_iter()
        .map(|(path, bytes)| (path.as_ref().to_owned(), bytes.as_ref().to_owned()))
        .collect();
    load(Reader::memory(files), Path::new(""))
}

fn load(mut reader: Reader, dir: &Path) -> Loaded {
    let Resolution { materials, clear, estimator, rejection, quality, .. } = load_set(&mut reader, dir);
    let complete = !reader.report.has_errors();
    let set = complete.then_some(MaterialSet { materials, clear, estimator, rejection, quality });
    let (report, files_read, directories_read) = reader.finish();
    Loaded { set, report, files_read, directories_read }
}

/// Reads one profile file; a profile that it names is looked for beside it, then among the built-in ones.
#[must_use]
pub fn load_profile_file(path: &Path) -> LoadedProfile {
    let mut reader = Reader::disk();
    let profile = load_profile_path(&mut reader, path);
    let profile = profile.filter(|_| !reader.report.has_errors());
    let (report, files_read, _) = reader.finish();
    LoadedProfile { profile, report, files_read }
}

/// Reads the profile that a material in `dir` calls `stem`: `dir/profiles/STEM.ron`, or the built-in one.
///
/// A directory that does not exist has no profiles of its own.
#[must_use]
pub fn load_profile(dir: &Path, stem: &str) -> LoadedProfile {
    let mut reader = Reader::disk();
    // The name stands in no file; the report shows it as if it did.
    let file = reader.report.sources_mut().add("profile name", stem);
    let name = Spanned::new(stem.to_owned(), Span::new(file, 0..stem.len()));
    let profile = load_named(&mut reader, &dir.join(PROFILES), &name);
    let profile = profile.filter(|_| !reader.report.has_errors());
    let (report, files_read, _) = reader.finish();
    LoadedProfile { profile, report, files_read }
}

/// Reports on directories of materials, single material files, single profile files and tables (`.csv`).
///
/// A single material is checked with the bases and profiles that it names; errors in files that it does not use are
/// left out. A file in a folder named `profiles` is a profile, as is one whose value is neither `Material(…)`, `Clear(…)`
/// nor `MaterialSet(…)`.
#[must_use]
pub fn check_paths(paths: &[PathBuf]) -> Checked {
    let mut checked = Reader::disk();
    for path in paths {
        let is_profiles = path.file_name().is_some_and(|name| name == PROFILES);
        if path.is_dir() && is_profiles {
            for file in checked.list(path, true) {
                load_profile_path(&mut checked, &file);
            }
        } else if path.is_dir() {
            load_set(&mut checked, path);
        } else {
            check_file(&mut checked, path);
        }
    }
    let (report, files_read, _) = checked.finish();
    Checked { report, files_read }
}

fn check_file(reader: &mut Reader, path: &Path) {
    if path.extension().is_some_and(|extension| extension == "csv") {
        tables::check(reader, path);
        return;
    }
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let in_profiles = folder.file_name().is_some_and(|name| name == PROFILES);
    let Some(file) = reader.read(path) else { return };
    let text = reader.text(file);
    match syntax::parse(file, &text) {
        Err(error) => reader.report.push(*error),
        Ok(document) if !in_profiles && is_of_set(&document) => {
            check_with_its_set(reader, path, folder, file);
        }
        Ok(_) => {
            load_profile_path(reader, path);
        }
    }
}

/// Whether a file holds a material, or describes the set.
fn is_of_set(document: &Document<'_>) -> bool {
    document.value.name().is_some_and(|name| ["Material", CLEAR, SET].contains(&name.text))
}

/// Reads the whole set that a file belongs to, and keeps what is said about the file.
fn check_with_its_set(reader: &mut Reader, path: &Path, folder: &Path, file: FileId) {
    let known: Vec<Diagnostic> = reader.report.iter().cloned().collect();
    reader.report.retain(|_| false);
    // The current directory has an empty path here, and cannot be listed by it.
    let listed = if folder == Path::new("") { Path::new(".") } else { folder };
    let paths = reader.list(listed, true);
    let mut paths: Vec<PathBuf> =
        paths.iter().filter_map(|path| path.file_name()).map(|name| folder.join(name)).collect();
    if !paths.iter().any(|other| other == path) {
        paths.push(path.to_owned()); // another extension
    }
    let resolution = resolve_set(reader, &paths, &folder.join(PROFILES));
    let relevant = resolution.files_behind(file);
    let mut report = std::mem::take(&mut reader.report);
    report.retain(|diagnostic| {
        let mut places = diagnostic.primary.iter().chain(&diagnostic.secondary);
        places.any(|(span, _)| relevant.contains(&span.file))
    });
    for diagnostic in known {
        report.push(diagnostic);
    }
    reader.report = report;
}

/// Reads a materials directory.
fn load_set(reader: &mut Reader, dir: &Path) -> Resolution {
    let before = reader.report.errors().count();
    let paths = reader.list(dir, true);
    if reader.report.errors().count() > before {
        return Resolution::default(); // one error is enough for a directory that is not there
    }
    let resolution = resolve_set(reader, &paths, &dir.join(PROFILES));
    if !resolution.has_materials {
        let shown = if dir == Path::new("") { "the set".to_owned() } else { format!("`{}`", dir.display()) };
        // Errors in what is clear say more.
        let has_errors = reader.report.errors().count() > before;
        if has_errors && resolution.has_clear {
            return resolution;
        }
        let what = if resolution.has_clear { "materials that scatter" } else { "materials" };
        reader.report.push(
            Diagnostic::error(format!("{shown} has no {what}"))
                .help("add a file `NAME.ron`, one for each material")
                .help(
                    "for example `Material(profile: \"two_exponential_dipole_searchlight\", \
                     mean_free_path_mm: (1.30, 0.95, 0.67), surface_albedo: (0.83, 0.64, 0.55))`",
                ),
        );
    }
    resolution
}

/// Reads and resolves material files, with the profiles of a folder that may be missing.
fn resolve_set(reader: &mut Reader, paths: &[PathBuf], profiles: &Path) -> Resolution {
    let mut files = Files::default();
    for path in paths {
        let stem = stem(path);
        match reader.read(path).map(|file| decode(reader, file, path, &stem)) {
            Some(OfSet::Material(Some(material))) => files.materials.push(*material),
            Some(OfSet::Clear(Some(clear))) => files.clear.push(clear),
            Some(OfSet::Set(set)) => files.sets.extend(set),
            Some(OfSet::Material(None) | OfSet::Clear(None)) | None => {
                files.broken_materials.insert(stem);
            }
        }
    }
    let profile_errors = read_profiles(reader, profiles, &mut files);
    let resolution = Resolution::of(&files);
    for diagnostic in profile_errors {
        reader.report.push(resolution.name_users(diagnostic));
    }
    for diagnostic in &resolution.diagnostics {
        reader.report.push(diagnostic.clone());
    }
    resolution
}

/// What a file of a materials directory holds; `None` when nothing in it can be trusted.
enum OfSet {
    Material(Option<Box<MaterialFile>>),
    Clear(Option<ClearFile>),
    Set(Option<SetFile>),
}

fn decode(reader: &mut Reader, file: FileId, path: &Path, stem: &str) -> OfSet {
    let text = reader.text(file);
    let mut tables = TablesBeside::new(reader, path);
    let mut decoder = Decoder::with_tables(&mut tables);
    let decoded = match syntax::parse(file, &text) {
        Ok(document) if document.value.name().is_some_and(|name| name.text == SET) => {
            OfSet::Set(decode_set_file(&mut decoder, &document))
        }
        Ok(document) if document.value.name().is_some_and(|name| name.text == CLEAR) => {
            OfSet::Clear(decode_clear(&mut decoder, stem, &document))
        }
        Ok(document) => OfSet::Material(decode_material(&mut decoder, file, stem, &document).map(Box::new)),
        Err(error) => {
            decoder.report(*error);
            OfSet::Material(None)
        }
    };
    for diagnostic in decoder.finish(&Span::new(file, 0..text.len())) {
        reader.report.push(diagnostic);
    }
    decoded
}

/// Reads all profiles of a folder; errors come back unreported, for they are to name the materials concerned.
fn read_profiles(reader: &mut Reader, folder: &Path, files: &mut Files) -> Vec<Diagnostic> {
    folder.to_string_lossy().replace(std::path::MAIN_SEPARATOR, "/").clone_into(&mut files.profiles_folder);
    let mut errors = Vec::new();
    for path in reader.list(folder, false) {
        let profile = match reader.read(&path) {
            Some(file) => {
                let (profile, diagnostics) = read_profile(reader, file, &path);
                errors.extend(diagnostics);
                profile
            }
            None => {
                // Reading failed, which is reported; the name is known all the same.
                let sources = reader.report.sources_mut();
                let file = sources.find(&path).unwrap_or_else(|| sources.add(&path, ""));
                ProfileFile { file, stem: stem(&path), docs: Vec::new(), expression: None }
            }
        };
        files.profiles.insert(profile.stem.clone(), profile);
    }
    errors
}

fn read_profile(reader: &mut Reader, file: FileId, path: &Path) -> (ProfileFile, Vec<Diagnostic>) {
    let text = reader.text(file);
    let mut tables = TablesBeside::new(reader, path);
    let mut decoder = Decoder::with_tables(&mut tables);
    let stem = stem(path);
    let profile = match syntax::parse(file, &text) {
        Ok(document) => decode_profile_file(&mut decoder, file, stem, &document),
        Err(error) => {
            decoder.report(*error);
            ProfileFile { file, stem, docs: Vec::new(), expression: None }
        }
    };
    (profile, decoder.finish(&Span::new(file, 0..text.len())))
}

fn load_profile_path(reader: &mut Reader, path: &Path) -> Option<ResolvedProfile> {
    let file = reader.read(path)?;
    let (profile, errors) = read_profile(reader, file, path);
    for error in errors {
        reader.report.push(error);
    }
    match profile.expression? {
        ProfileExpression::Inline(inline) => Some(ResolvedProfile {
            stem: Some(profile.stem),
            model: inline.model,
            docs: profile.docs,
            span: inline.head,
            coefficient_spans: inline.coefficients,
        }),
        ProfileExpression::Named(name) => {
            let folder = path.parent().unwrap_or_else(|| Path::new(""));
            load_named(reader, folder, &name)
        }
    }
}

/// Follows a name among the profile files of `folder`; reports what is wrong on the way.
fn load_named(reader: &mut Reader, folder: &Path, name: &Spanned<String>) -> Option<ResolvedProfile> {
    let mut files = Files::default();
    let errors = read_profiles(reader, folder, &mut files);
    let chain = chain(&files, &name.value);
    for error in errors {
        let mut places = error.primary.iter().chain(&error.secondary);
        if places.any(|(span, _)| chain.files.contains(&span.file)) {
            reader.report.push(error);
        }
    }
    match chain.end {
        ChainEnd::Model(profile) => Some(*profile),
        ChainEnd::Published(stem, model) => {
            let span = name.span.clone();
            Some(ResolvedProfile {
                stem: Some(stem),
                model,
                docs: Vec::new(),
                span,
                coefficient_spans: Default::default(),
            })
        }
        ChainEnd::Unknown => {
            let last = chain.files.last().and_then(|file| named_in(&files, *file)).unwrap_or(name);
            reader.report.push(unknown_profile(&files, last));
            None
        }
        ChainEnd::Broken => {
            if !reader.report.has_errors() {
                let stems: Vec<&str> = files
                    .profiles
                    .values()
                    .filter(|profile| chain.files.contains(&profile.file))
                    .map(|profile| profile.stem.as_str())
                    .collect();
                reader.report.push(
                    Diagnostic::error(format!("profiles import each other in a cycle: {}", list(stems)))
                        .label(name.span.clone(), "this name leads to no model")
                        .help("write a model in one of these files, such as `Burley(parametrization: Searchlight)`"),
                );
            }
            None
        }
    }
}

fn named_in(files: &Files, file: FileId) -> Option<&Spanned<String>> {
    let profile = files.profiles.values().find(|profile| profile.file == file)?;
    match &profile.expression {
        Some(ProfileExpression::Named(name)) => Some(name),
        _ => None,
    }
}

/// The file's name without its extension. What is not Unicode is replaced, and then refused as a name.
fn stem(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}
