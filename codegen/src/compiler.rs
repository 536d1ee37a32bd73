//! The compiler: a directory of materials in; WGSL, Rust and a manifest out.

mod compilation;
mod kernel_module;
mod parameter_table;
mod rows;
mod runtime_bindings;
mod shader_files;

use std::path::{Path, PathBuf};

use proc_macro2::TokenStream;
use quote::quote;
use sha2::{Digest, Sha256};
use subsurface_kernel::constants::MOST_MATERIALS;
use subsurface_kernel::{Estimator, KernelModule as ModuleParts, KernelParts, OutputFormat, Rejection};
use subsurface_quality::QualityReport;

use crate::bindings::{self, Paths, SetBindings};
use crate::diagnostics::Diagnostic;
use crate::emit::Choices;
use crate::load::{Loaded, load_directory, load_memory};
use crate::manifest::ManifestOf;
use crate::material::MaterialSet;
use crate::output::BuildError;
use crate::quality::{self, solve};
use crate::report::Report;

pub use compilation::Compilation;
use kernel_module::{KernelModule, Wanted};
use rows::Rows;
pub use runtime_bindings::runtime_bindings;
use shader_files::ShaderFiles;

/// Name of the struct that is one row of the parameter table.
const ROW: &str = "SubsurfaceMaterial";

/// Name of the struct that is one knot of a tabulated profile.
const KNOT: &str = "TabulatedKnot";

/// Knots that fit a set: 84 MB, within the 128 MiB that WebGPU grants a storage buffer; their numbers are exact as f32.
const KNOT_LIMIT: usize = 1 << 22;

/// Texels of the curves and terms of a set: 256 MB. The shaders keep the number of a texel as an f32, exact up to here.
const CURVE_TEXEL_LIMIT: u32 = 1 << 24;

/// Materials that fit a set.
const MATERIAL_LIMIT: usize = MOST_MATERIALS as usize;

#[derive(Clone, Debug)]
enum Source {
    Directory(PathBuf),
    Memory(Vec<(PathBuf, Vec<u8>)>),
}

/// Compiles one set of materials.
///
/// In a `build.rs`:
///
/// ```no_run
/// subsurface_codegen::Compiler::new("materials").build_or_exit();
/// ```
///
/// At run time:
///
/// ```
/// let skin = "Material(profile: Burley(parametrization: Searchlight), \
///             mean_free_path_mm: (1.3, 0.95, 0.67), surface_albedo: (0.83, 0.64, 0.55))";
/// let compilation = subsurface_codegen::Compiler::from_memory([("skin.ron", skin)]).compile().unwrap();
/// assert!(compilation.wgsl().contains("fn burley_radial_cdf"));
/// ```
#[derive(Clone, Debug)]
pub struct Compiler {
    source: Source,
    runtime_path: String,
    gbuffer: bool,
    debug_views: bool,
    passes: Vec<Pass>,
    estimator: Option<Estimator>,
    rejection: Option<Rejection>,
    output_format: OutputFormat,
}

/// A pass of the caller's own that is linked into the kernel module.
///
/// It may use whatever the shaders and the material set declare, and needs no `// uses:` line: `material_table`,
/// `material_profiles`, `profile_radial_cdf`, `gather_importance_sampled`, …
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// Name for messages and for the comment above its text.
    pub name: &'static str,
    /// WGSL with bindings and entry points.
    pub text: &'static str,
    /// Names of its entry points.
    pub entry_points: &'static [&'static str],
}

impl Compiler {
    /// A compiler of the materials in `directory`.
    pub fn new(directory: impl Into<PathBuf>) -> Self {
        Self::from_source(Source::Directory(directory.into()))
    }

    /// A compiler of material files in memory; paths are relative to the materials directory.
    pub fn from_memory<P: Into<PathBuf>, B: Into<Vec<u8>>>(files: impl IntoIterator<Item = (P, B)>) -> Self {
        let mut files: Vec<_> = files.into_iter().map(|(path, text)| (path.into(), text.into())).collect();
        files.sort();
        Self::from_source(Source::Memory(files))
    }

    fn from_source(source: Source) -> Self {
        Self {
            source,
            runtime_path: "::subsurface_runtime".to_owned(),
            gbuffer: true,
            debug_views: false,
            passes: Vec::new(),
            estimator: None,
            rejection: None,
            output_format: OutputFormat::default(),
        }
    }

    /// Path of the runtime crate in the generated Rust; `::subsurface_runtime` if not given.
    ///
    /// A crate that depends on `subsurface` alone says `::subsurface::runtime`.
    #[must_use]
    pub fn runtime_path(mut self, path: impl Into<String>) -> Self {
        self.runtime_path = path.into();
        self
    }

    /// Leaves the G-buffer pass out of the kernel module: for engines that fill their own G-buffer.
    #[must_use]
    pub fn without_gbuffer(mut self) -> Self {
        self.gbuffer = false;
        self
    }

    /// Links what [`DebugView`](subsurface_kernel::DebugView) shows into the kernel module. Not there otherwise: it brings
    /// an estimator of its own, which no frame needs.
    #[must_use]
    pub fn with_debug_views(mut self) -> Self {
        self.debug_views = true;
        self
    }

    /// Links a pass of the caller's own into the kernel module.
    #[must_use]
    pub fn with_pass(mut self, pass: Pass) -> Self {
        self.passes.push(pass);
        self
    }

    /// Generates this estimator, whatever the set's own file says; that, or else [`Estimator::default`], if not given.
    #[must_use]
    pub fn estimator(mut self, estimator: Estimator) -> Self {
        self.estimator = Some(estimator);
        self
    }

    /// Which taps the estimator leaves out, whatever the set's own file says; that, or else [`Rejection::default`], if not
    /// given.
    #[must_use]
    pub fn rejection(mut self, rejection: Rejection) -> Self {
        self.rejection = Some(rejection);
        self
    }

    /// Format of the texture that the compute path writes; [`OutputFormat::default`] if not given.
    #[must_use]
    pub fn output_format(mut self, format: OutputFormat) -> Self {
        self.output_format = format;
        self
    }

    /// Compiles, touching no file but the materials.
    ///
    /// # Errors
    /// The report holds every error of every file.
    pub fn compile(&self) -> Result<Compilation, Report> {
        self.compile_from(self.load())
    }

    pub(crate) fn load(&self) -> Loaded {
        match &self.source {
            Source::Directory(directory) => load_directory(directory),
            Source::Memory(files) => load_memory(files.iter().map(|(path, text)| (path, text))),
        }
    }

    pub(crate) fn compile_from(&self, loaded: Loaded) -> Result<Compilation, Report> {
        let Loaded { set, mut report, files_read, directories_read } = loaded;
        let Some(set) = set.filter(|_| !report.has_errors()) else { return Err(report) };
        if set.materials.len() > MATERIAL_LIMIT {
            let message = format!("{} materials in one set", set.materials.len());
            report.push(
                Diagnostic::error(message)
                    .help(format!("a set holds at most {MATERIAL_LIMIT}: split it into two directories")),
            );
            return Err(report);
        }
        let paths = match paths(&self.runtime_path) {
            Ok(paths) => paths,
            Err(diagnostic) => {
                report.push(*diagnostic);
                return Err(report);
            }
        };
        let rejection = self.rejection.unwrap_or(set.rejection);
        // An estimator that the caller names is not searched.
        let request = set.quality.as_ref().filter(|_| self.estimator.is_none());
        let quality = match request.map(|request| solve(&set, rejection, request)).transpose() {
            Ok(quality) => quality,
            Err(error) => {
                report.push(*error);
                return Err(report);
            }
        };
        let searched = quality.as_ref().map(|quality| quality.estimator);
        let choices = Choices {
            estimator: self.estimator.or(searched).unwrap_or(set.estimator),
            rejection,
            output_format: self.output_format,
        };
        if let Some(expected) = choices.estimator.refused_taps() {
            let (name, taps) = (choices.estimator.name(), choices.estimator.taps());
            report.push(
                Diagnostic::error(format!("the estimator `{name}` cannot have {taps} taps"))
                    .help(format!("give `Compiler::estimator` {expected}")),
            );
            return Err(report);
        }
        let provenance = self.provenance(&report, &choices);
        let header = header(&set, &choices, quality.as_ref(), &provenance);
        let shaders = &ShaderFiles::default();
        let (gbuffer, debug_views, passes) = (self.gbuffer, self.debug_views, &self.passes);
        let wanted = Wanted { shaders, gbuffer, debug_views, passes };
        let generated = KernelModule::generate(&set, &choices, wanted, &header, &mut report);
        let Some(KernelModule { linked, emitted, validated, reflection, row_binding }) = generated else {
            return Err(report);
        };
        let module = &validated.module;
        if emitted.knots.len() > KNOT_LIMIT {
            let message = format!("{} knots in the tables of one set", emitted.knots.len());
            report.push(
                Diagnostic::error(message)
                    .help(format!("a set holds at most {KNOT_LIMIT}: use wider bins or fewer tables")),
            );
            return Err(report);
        }
        if emitted.curves.texels() > CURVE_TEXEL_LIMIT {
            report.push(
                Diagnostic::error("the Gaussian sums of one set have too many terms").help(format!(
                    "a set holds about {CURVE_TEXEL_LIMIT}: use fewer terms, or two directories"
                )),
            );
            return Err(report);
        }
        let rows = match Rows::of(module, &linked.docs, ROW, &emitted.rows) {
            Ok(rows) => rows,
            Err(diagnostic) => {
                report.push(*diagnostic);
                return Err(report);
            }
        };
        let knots = (!emitted.knots.is_empty()).then(|| Rows::of(module, &linked.docs, KNOT, &emitted.knots));
        let knots = match knots.transpose() {
            Ok(knots) => knots,
            Err(diagnostic) => {
                report.push(*diagnostic);
                return Err(report);
            }
        };
        let entry_points = reflection.entry_points.iter().map(|entry| entry.name.clone());
        let mut parts_module =
            ModuleParts::new(choices.estimator, linked.text.clone(), rows.structure.size, row_binding)
                .with_entry_points(entry_points)
                .with_output_format(choices.output_format, linked.output_format.clone());
        if let Some(knots) = &knots {
            parts_module = parts_module.with_profile_tables(knots.structure.size);
        }
        let curve_size = emitted.curves.size();
        let names = set.materials.iter().map(|material| material.name.clone());
        let mut builder = KernelParts::builder(parts_module)
            .materials(names, rows.bytes, rows.structure.size)
            .profile_curves(emitted.curves.bytes(), curve_size);
        if let Some(knots) = knots {
            builder = builder.profile_tables(knots.bytes);
        }
        let parts = match builder.build() {
            Ok(parts) => parts,
            Err(error) => {
                report.push(Diagnostic::error(error.to_string()).help(DEFECT));
                return Err(report);
            }
        };
        let mut tokens = bindings::set_tokens(
            module,
            &SetBindings { set: &set, rows: &emitted.rows, provenance: &provenance, parts: &parts },
            &rows.structure,
            &paths,
        );
        tokens.extend(quality.as_ref().map(bindings::quality_tokens));
        tokens.extend(bindings::module_tokens(module, &linked.docs, &reflection, &paths, |_| true, &[]));
        let rust_header = format!(
            "// Generated by subsurface-codegen. Change the material files instead.\n// Provenance: {provenance}"
        );
        Ok(Compilation {
            rust: bindings::format(&rust_header, tokens),
            manifest: crate::manifest::manifest(
                &ManifestOf {
                    set: &set,
                    choices: &choices,
                    quality: quality.as_ref(),
                    curve_size,
                    has_tables: !parts.profile_tables().is_empty(),
                    provenance: &provenance,
                },
                module,
                &reflection,
            ),
            parts,
            rejection: choices.rejection,
            quality,
            set,
            provenance,
            report,
            files_read,
            directories_read,
        })
    }

    /// Compiles into Cargo's `OUT_DIR`: the files of [`Compilation::write_to`]; tells Cargo which files were read and
    /// prints warnings as Cargo's.
    ///
    /// # Errors
    /// Material errors, or a file that cannot be written.
    #[allow(clippy::print_stdout, reason = "Cargo reads a build script's standard output")]
    pub fn build(&self) -> Result<(), BuildError> {
        let out_dir = std::env::var_os("OUT_DIR").ok_or(BuildError::NoOutDir)?;
        let loaded = self.load();
        for path in loaded.files_read.iter().chain(&loaded.directories_read) {
            println!("cargo::rerun-if-changed={}", path.display());
        }
        let compilation = self.compile_from(loaded)?;
        for line in compilation.report.render(false).lines() {
            println!("cargo::warning={line}");
        }
        compilation.write_to(Path::new(&out_dir))
    }

    /// [`build`](Self::build) for a build script: prints errors as rustc does and exits with 1.
    #[allow(clippy::print_stderr, reason = "Cargo shows a failed build script's standard error")]
    pub fn build_or_exit(&self) {
        if let Err(error) = self.build() {
            eprintln!("{error}");
            std::process::exit(1);
        }
    }

    /// SHA-256 over what the output depends on: this crate's version, the shaders, the choices of the caller and every
    /// material file by name.
    fn provenance(&self, report: &Report, choices: &Choices) -> String {
        let mut hash = Sha256::new();
        let mut add = |name: &str, text: &[u8]| {
            for part in [name.as_bytes(), text] {
                // Lengths keep neighbours apart: ("ab", "c") is not ("a", "bc").
                hash.update((part.len() as u64).to_le_bytes());
                hash.update(part);
            }
        };
        add("subsurface-codegen", env!("CARGO_PKG_VERSION").as_bytes());
        for module in subsurface_shaders::modules() {
            add(module.name, module.text.as_bytes());
        }
        for pass in &self.passes {
            add(pass.name, pass.text.as_bytes());
            add("entry points", pass.entry_points.join(" ").as_bytes());
        }
        add("runtime path", self.runtime_path.as_bytes());
        add("G-buffer pass", &[u8::from(self.gbuffer)]);
        add("debug views", &[u8::from(self.debug_views)]);
        add("choices", format!("{choices:?}").as_bytes());
        let sources = report.sources();
        let mut files: Vec<_> =
            sources.files().map(|file| (self.relative(sources.path(file)), sources.text(file))).collect();
        files.sort();
        for (path, text) in files {
            add(&path, text.as_bytes());
        }
        hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// A file's path below the materials directory, so that the place of a checkout does not enter the hash.
    fn relative(&self, path: &str) -> String {
        match &self.source {
            Source::Directory(directory) => {
                let below = Path::new(path).strip_prefix(directory).unwrap_or(Path::new(path));
                below
                    .components()
                    .map(|part| part.as_os_str().to_string_lossy())
                    .collect::<Vec<_>>()
                    .join("/")
            }
            Source::Memory(_) => path.to_owned(),
        }
    }
}

const DEFECT: &str = "no material file is to blame: please report this as a defect of the compiler";

fn header(set: &MaterialSet, choices: &Choices, quality: Option<&QualityReport>, provenance: &str) -> String {
    let mut header = format!(
        "// Generated by subsurface-codegen {} from material files. Change those instead.\n\
         // Provenance: {provenance}\n//\n// Estimator: {}\n{}// Rejects: {}\n//\n// Materials by number:\n",
        env!("CARGO_PKG_VERSION"),
        choices.estimator,
        quality.map(quality::comment).unwrap_or_default(),
        choices.rejection,
    );
    for (number, material) in set.materials.iter().enumerate() {
        let profile = material.profile.stem.as_deref().unwrap_or("inline profile");
        header.push_str(&format!("//   {number} {} ({profile})\n", material.name));
    }
    header
}

/// Paths below the runtime crate, through which generated code reaches wgpu and bytemuck.
fn paths(runtime: &str) -> Result<Paths, Box<Diagnostic>> {
    let runtime: TokenStream =
        syn::parse_str::<syn::Path>(runtime).map(|path| quote!(#path)).map_err(|_| {
            Box::new(
                Diagnostic::error(format!("`{runtime}` is no Rust path"))
                    .help("Compiler::runtime_path takes a path such as `::subsurface_runtime`"),
            )
        })?;
    Ok(Paths { wgpu: quote!(#runtime::wgpu), bytemuck: quote!(#runtime::bytemuck), runtime })
}

#[cfg(test)]
mod tests;
