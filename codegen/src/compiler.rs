//! The compiler: a directory of materials in; WGSL, Rust and a manifest out.

mod runtime_bindings;

use std::path::{Path, PathBuf};

use proc_macro2::TokenStream;
use quote::quote;
use sha2::{Digest, Sha256};
use subsurface_shaders::{KERNELS, LIBRARY, Module, PASSES, PROFILES};

use crate::bindings::{self, Paths, SetBindings};
use crate::compose::{Linked, link};
use crate::diagnostics::{Diagnostic, Report};
use crate::emit::{Emitted, emit};
use crate::layout::{array_bytes, bytes_of, structure};
use crate::load::{Loaded, load_directory, load_memory};
use crate::material::MaterialSet;
use crate::output::{self, BuildError};
use crate::reflect::{Reflection, reflect};
use crate::validate::{Validated, validate};

pub use runtime_bindings::runtime_bindings;

/// Name of the struct that is one row of the parameter table.
const ROW: &str = "SubsurfaceMaterial";

/// Name of the struct that is one knot of a tabulated profile.
const KNOT: &str = "TabulatedKnot";

/// Knots that fit a set: 84 MB, within the 128 MiB that WebGPU grants a storage buffer; their numbers are exact as f32.
const KNOT_LIMIT: usize = 1 << 22;

/// Entry points of the kernel module, by the pass that uses them.
const SUBSURFACE_ENTRIES: &[&str] = &["subsurface_vertex", "subsurface_fragment", "passthrough_fragment"];
const GBUFFER_ENTRIES: &[&str] = &["gbuffer_vertex", "gbuffer_fragment"];

/// Materials that fit a set: the surface target keeps the number as a 16-bit float, exact up to 2048.
const MATERIAL_LIMIT: usize = 2048;

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
/// assert!(compilation.wgsl.contains("fn burley_sample_radius"));
/// ```
#[derive(Clone, Debug)]
pub struct Compiler {
    source: Source,
    runtime_path: String,
    gbuffer: bool,
    passes: Vec<Pass>,
}

/// A pass of the caller's own that is linked into the kernel module.
///
/// It may use whatever the library, the kernels and the material set declare: `material_table`, `material_profiles`,
/// `profile_radial_cdf`, `gather_importance_sampled`, …
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// Name for messages and for the comment above its text.
    pub name: &'static str,
    /// WGSL with bindings and entry points.
    pub text: &'static str,
    /// Names of its entry points.
    pub entry_points: &'static [&'static str],
}

/// What a set compiles to.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Compilation {
    /// The kernel module: validated WGSL.
    pub wgsl: String,
    /// Rust bindings; they include the WGSL from `subsurface.wgsl` beside them.
    pub rust: String,
    /// Reflection manifest: JSON.
    pub manifest: String,
    /// The materials, by number.
    pub set: MaterialSet,
    /// The parameter table, as the bytes of the storage buffer.
    pub material_table: Vec<u8>,
    /// The tables of tabulated profiles, as the bytes of the second storage buffer; empty where no material uses one.
    pub profile_tables: Vec<u8>,
    /// SHA-256 of the inputs, hexadecimal.
    pub provenance: String,
    /// Warnings.
    pub report: Report,
    /// Every file that was read, sorted.
    pub files_read: Vec<PathBuf>,
    /// Every directory that was listed, sorted.
    pub directories_read: Vec<PathBuf>,
}

impl Compilation {
    /// Names of the materials, by number.
    pub fn material_names(&self) -> Vec<String> {
        self.set.materials.iter().map(|material| material.name.clone()).collect()
    }
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
        Self { source, runtime_path: "::subsurface_runtime".to_owned(), gbuffer: true, passes: Vec::new() }
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

    /// Links a pass of the caller's own into the kernel module.
    #[must_use]
    pub fn with_pass(mut self, pass: Pass) -> Self {
        self.passes.push(pass);
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
        let provenance = self.provenance(&report);
        let mut roots = SUBSURFACE_ENTRIES.to_vec();
        if self.gbuffer {
            roots.extend(GBUFFER_ENTRIES);
        }
        roots.extend(self.passes.iter().flat_map(|pass| pass.entry_points));
        let Some(kernel) =
            Kernel::generate(&set, &self.passes, &roots, &header(&set, &provenance), &mut report)
        else {
            return Err(report);
        };
        let Kernel { linked, emitted, validated, reflection } = kernel;
        let module = &validated.module;
        if emitted.knots.len() > KNOT_LIMIT {
            let message = format!("{} knots in the tables of one set", emitted.knots.len());
            report.push(
                Diagnostic::error(message)
                    .help(format!("a set holds at most {KNOT_LIMIT}: use wider bins or fewer tables")),
            );
            return Err(report);
        }
        let named = |name: &str| {
            module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).map(|(handle, _)| handle)
        };
        let profile_tables =
            named(KNOT).map(|knot| array_bytes(module, knot, &emitted.knots)).unwrap_or_default();
        let Some((row_handle, row)) =
            named(ROW).and_then(|handle| Some((handle, structure(module, &linked.docs, handle)?)))
        else {
            report.push(Diagnostic::error("the kernel has no parameter table").help(DEFECT));
            return Err(report);
        };
        let mut tokens = bindings::set_tokens(
            module,
            &SetBindings {
                set: &set,
                rows: &emitted.rows,
                provenance: &provenance,
                has_tables: !profile_tables.is_empty(),
            },
            &row,
            &paths,
        );
        tokens.extend(bindings::module_tokens(module, &linked.docs, &reflection, &paths, |_| true, &[]));
        let rust_header = format!(
            "// Generated by subsurface-codegen. Change the material files instead.\n// Provenance: {provenance}"
        );
        Ok(Compilation {
            rust: bindings::format(&rust_header, tokens),
            manifest: crate::manifest::manifest(
                &set,
                module,
                &reflection,
                &provenance,
                !profile_tables.is_empty(),
            ),
            material_table: emitted
                .rows
                .iter()
                .flat_map(|value| bytes_of(module, row_handle, value))
                .collect(),
            profile_tables,
            wgsl: linked.text,
            set,
            provenance,
            report,
            files_read,
            directories_read,
        })
    }

    /// Compiles into Cargo's `OUT_DIR`: `subsurface.rs`, `subsurface.wgsl` and `subsurface.json`; tells Cargo which
    /// files were read and prints warnings as Cargo's.
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

    /// SHA-256 over what the output depends on: this crate's version, the shaders and every material file by name.
    fn provenance(&self, report: &Report) -> String {
        let mut hash = Sha256::new();
        let mut add = |name: &str, text: &[u8]| {
            for part in [name.as_bytes(), text] {
                // Lengths keep neighbours apart: ("ab", "c") is not ("a", "bc").
                hash.update((part.len() as u64).to_le_bytes());
                hash.update(part);
            }
        };
        add("subsurface-codegen", env!("CARGO_PKG_VERSION").as_bytes());
        for module in LIBRARY.iter().chain(PROFILES).chain(KERNELS).chain(PASSES) {
            add(module.name, module.text.as_bytes());
        }
        for pass in &self.passes {
            add(pass.name, pass.text.as_bytes());
            add("entry points", pass.entry_points.join(" ").as_bytes());
        }
        add("runtime path", self.runtime_path.as_bytes());
        add("G-buffer pass", &[u8::from(self.gbuffer)]);
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

impl Compilation {
    /// Writes `subsurface.rs`, `subsurface.wgsl` and `subsurface.json` into `directory`, each whole or not at all; a
    /// file that already holds the text is left alone. A set with tabulated profiles adds `subsurface.tables`.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_to(&self, directory: &Path) -> Result<(), BuildError> {
        for (name, text) in [
            ("subsurface.wgsl", self.wgsl.as_bytes()),
            ("subsurface.rs", self.rust.as_bytes()),
            ("subsurface.json", self.manifest.as_bytes()),
            (PROFILE_TABLES_FILE, &self.profile_tables),
        ] {
            // Most sets have no tables, and need no empty file.
            if !text.is_empty() {
                output::write_if_changed(&directory.join(name), text)?;
            }
        }
        Ok(())
    }
}

/// File of the tables of tabulated profiles, beside the WGSL.
pub(crate) const PROFILE_TABLES_FILE: &str = "subsurface.tables";

const DEFECT: &str = "no material file is to blame: please report this as a defect of the compiler";

/// A kernel module on its way to text.
struct Kernel {
    linked: Linked,
    emitted: Emitted,
    validated: Validated,
    reflection: Reflection,
}

impl Kernel {
    fn generate(
        set: &MaterialSet,
        passes: &[Pass],
        roots: &[&str],
        header: &str,
        report: &mut Report,
    ) -> Option<Self> {
        let emitted = match emit(set) {
            Ok(emitted) => emitted,
            Err(unknown) => {
                report.push(
                    Diagnostic::error("this profile model has no shader yet")
                        .label(unknown.span, "not supported by this version of the compiler")
                        .help("use another model, or a newer version of subsurface-codegen"),
                );
                return None;
            }
        };
        let in_use = |module: &&Module| {
            emitted.models.iter().any(|model| module.name == format!("profiles/{}", model.stem()))
        };
        let kernel_passes = ["passes/subsurface", "passes/gbuffer"];
        let modules: Vec<Module> = LIBRARY
            .iter()
            .chain(PROFILES.iter().filter(in_use))
            .chain(KERNELS)
            .chain(PASSES.iter().filter(|pass| kernel_passes.contains(&pass.name)))
            .copied()
            .chain(passes.iter().map(|pass| Module { name: pass.name, text: pass.text }))
            .collect();
        let linked = match link(&modules, &emitted.glue, roots, header) {
            Ok(linked) => linked,
            Err(error) => {
                report.push(Diagnostic::error(error.to_string()).help(DEFECT));
                return None;
            }
        };
        let validated = validate(&linked, "subsurface.wgsl", report)?;
        match reflect(&validated.module, &validated.info, &linked.docs) {
            Ok(reflection) => Some(Self { linked, emitted, validated, reflection }),
            Err(error) => {
                report.push(Diagnostic::error(error.to_string()).help(DEFECT));
                None
            }
        }
    }
}

fn header(set: &MaterialSet, provenance: &str) -> String {
    let mut header = format!(
        "// Generated by subsurface-codegen {} from material files. Change those instead.\n\
         // Provenance: {provenance}\n//\n// Materials by number:\n",
        env!("CARGO_PKG_VERSION")
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
mod tests {
    use super::*;

    const LENGTH_AND_ALBEDO: &str = "mean_free_path_mm: (1.3, 0.95, 0.67), surface_albedo: (0.8, 0.6, 0.4)";

    fn material(profile: &str) -> String {
        format!("Material(profile: {profile}, {LENGTH_AND_ALBEDO})")
    }

    fn compile(files: &[(&str, String)]) -> Compilation {
        let files = files.iter().map(|(path, text)| (*path, text.as_str()));
        Compiler::from_memory(files).compile().unwrap_or_else(|report| panic!("{report}"))
    }

    #[test]
    fn only_the_models_in_use_are_linked_in() {
        let one = compile(&[("a.ron", material("Burley(parametrization: Diffuse)"))]);
        assert!(one.wgsl.contains("fn burley_sample_radius"));
        for other in ["polynomial", "gaussian_sum", "exponential_dipole"] {
            assert!(
                !one.wgsl.contains(&format!("fn {other}")) && !one.wgsl.contains(&format!("{other}:")),
                "{other}"
            );
        }
        assert!(!one.wgsl.contains("switch profile.model"), "one model needs no switch");
        let two = compile(&[
            ("a.ron", material("Burley(parametrization: Diffuse)")),
            ("b.ron", material("ExponentialDipole(entry: Searchlight)")),
        ]);
        assert!(
            two.wgsl.contains("switch profile.model")
                && two.wgsl.contains("fn exponential_dipole_radial_cdf")
        );
    }

    #[test]
    fn dead_functions_are_dropped_with_the_pass_that_used_them() {
        let files = [("a.ron", material("Burley(parametrization: Diffuse)"))];
        let whole = compile(&files);
        assert!(whole.wgsl.contains("fn gbuffer_fragment") && whole.wgsl.contains("fn burley_radial_cdf"));
        let files = files.iter().map(|(path, text)| (*path, text.as_str()));
        let lean = Compiler::from_memory(files).without_gbuffer().compile().unwrap_or_else(|r| panic!("{r}"));
        for name in
            ["fn gbuffer_fragment", "fn burley_radial_cdf", "fn shadow_visibility", "fn specular_reflection"]
        {
            assert!(!lean.wgsl.contains(name), "{name} is dead without the G-buffer pass");
        }
    }

    #[test]
    fn the_order_of_the_files_changes_no_byte() {
        let names = ["apple.ron", "bone.ron", "cream.ron", "profiles/mine.ron"];
        let text = |name: &str| match name {
            "profiles/mine.ron" => {
                "GaussianSum([(variance_mm2: 0.5, weight: 0.8), (variance_mm2: 2, weight: 0.2)])".to_owned()
            }
            "bone.ron" => material("\"mine\""),
            _ => material("Burley(parametrization: Searchlight)"),
        };
        let compiled = |order: &[usize]| {
            let files: Vec<_> = order.iter().map(|&i| (names[i], text(names[i]))).collect();
            let compilation = compile(&files);
            (compilation.wgsl, compilation.rust, compilation.manifest, compilation.material_table)
        };
        let first = compiled(&[0, 1, 2, 3]);
        assert!(first == compiled(&[3, 2, 1, 0]) && first == compiled(&[2, 0, 3, 1]));
    }

    #[test]
    fn provenance_follows_the_inputs() {
        let a = compile(&[("a.ron", material("Burley(parametrization: Diffuse)"))]);
        let same = compile(&[("a.ron", material("Burley(parametrization: Diffuse)"))]);
        let other = compile(&[("a.ron", material("Burley(parametrization: Searchlight)"))]);
        assert_eq!(a.provenance, same.provenance);
        assert_ne!(a.provenance, other.provenance);
        assert!(
            a.wgsl.contains(&a.provenance)
                && a.rust.contains(&a.provenance)
                && a.manifest.contains(&a.provenance)
        );
    }

    #[test]
    fn equal_gaussian_sums_share_their_terms() {
        let skin = || material("\"gaussian_skin\"");
        let compilation = compile(&[("a.ron", skin()), ("b.ron", skin())]);
        assert!(compilation.wgsl.contains("array<vec4f, 6>"), "two materials, six terms");
    }

    #[test]
    fn a_runtime_path_that_is_none_is_refused() {
        let files = [("a.ron", material("Burley(parametrization: Diffuse)"))];
        let files = files.iter().map(|(path, text)| (*path, text.as_str()));
        let report = Compiler::from_memory(files).runtime_path("not a path").compile().expect_err("no path");
        assert!(report.render(false).contains("`not a path` is no Rust path"));
    }

    #[test]
    fn too_many_materials_are_refused() {
        let files: Vec<_> = (0..=MATERIAL_LIMIT)
            .map(|i| (format!("m{i}.ron"), material("Burley(parametrization: Diffuse)")))
            .collect();
        let report = Compiler::from_memory(files).compile().expect_err("2049 materials");
        assert!(report.render(false).contains("a set holds at most 2048"));
    }
}
