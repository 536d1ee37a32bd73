//! Bindings of the runtime's own passes, which no material set changes.

use crate::constants::shared_constants;
use proc_macro2::{Literal, TokenStream};
use quote::quote;
use subsurface_shaders::{LIBRARY, LIGHT, Module, PASSES};

use crate::bindings::{self, Paths};
use crate::compose::{Files, Glue, link};
use crate::diagnostics::Diagnostic;
use crate::docs::Docs;
use crate::emit::Choices;
use crate::layout::structure;
use crate::reflect::reflect;
use crate::report::Report;
use crate::validate::validate;
use subsurface_kernel::OutputFormat;

use super::{Compiler, DEFECT, KernelModule, ROW, ShaderFiles, Wanted};

/// What all materials have, and the member of it that the composite pass takes.
const SURFACE: &str = "MaterialSurface";
const MIX: &str = "surface_albedo_mix";

/// Rust modules `shadow`, `composite` and `kernel` with the typed bindings of the runtime's own passes.
///
/// The runtime's build script calls this. `kernel` holds what every set has in common: all but the parameter table.
///
/// # Errors
/// A shader that is not valid; no material is involved.
pub fn runtime_bindings() -> Result<String, Report> {
    let paths = Paths { wgpu: quote!(crate::wgpu), bytemuck: quote!(::bytemuck), runtime: quote!(crate) };
    let mut tokens = TokenStream::new();
    for (name, roots) in [
        ("shadow", &["shadow_vertex"][..]),
        ("composite", &["composite_vertex", "composite_fragment"]),
        ("distance", &["distance_vertex", "distance_fragment"]),
        ("clear", &["clear_vertex", "clear_fragment"]),
        ("clear_exit", &["clear_exit_vertex", "clear_exit_fragment"]),
        ("halve", &["halve_vertex", "halve_fragment"]),
        ("tone", &["tone_vertex", "tone_fragment"]),
    ] {
        let mut report = Report::default();
        let module_name = format!("passes/{name}");
        let pass: Vec<Module> = PASSES.iter().filter(|pass| pass.name == module_name).copied().collect();
        let rooms: Vec<Module> = LIBRARY.iter().chain(LIGHT).copied().chain(shared_constants()).collect();
        let files = Files { rooms: &rooms, passes: &pass, guests: &[] };
        let header = format!("// Linked by subsurface-codegen from {module_name} and what it calls.\n");
        let linked = link(files, &Glue::default(), roots, &header);
        let linked = linked.map_err(|error| report_of(&error.to_string()))?;
        let Some(validated) = validate(&linked, &format!("{name}.wgsl"), &mut report) else {
            return Err(report);
        };
        let reflection = reflect(&validated.module, &validated.info, &linked)
            .map_err(|error| report_of(&error.to_string()))?;
        let inner =
            bindings::module_tokens(&validated.module, &linked.docs, &reflection, &paths, |_| true, &[]);
        let wgsl = &linked.text;
        let module = quote::format_ident!("{name}");
        let doc = format!(" Bindings of the {name} pass.");
        tokens.extend(quote! {
            #[doc = #doc]
            pub mod #module {
                #inner
                /// The module as WGSL.
                pub const WGSL: &str = #wgsl;
            }
        });
    }

    // Any set will do: nothing that differs between sets is kept.
    let sample = "Material(profile: Burley(parametrization: Searchlight), mean_free_path_mm: (1.0, 1.0, 1.0), \
                  surface_albedo: (0.5, 0.5, 0.5))";
    let loaded = Compiler::from_memory([("sample.ron", sample)]).load();
    let mut report = loaded.report;
    let Some(set) = loaded.set else { return Err(report) };
    let choices = Choices {
        estimator: set.estimator,
        rejection: set.rejection,
        output_format: OutputFormat::default(),
    };
    let shaders = &ShaderFiles::default();
    let wanted = Wanted { shaders, gbuffer: true, debug_views: true, passes: &[] };
    let Some(kernel) = KernelModule::generate(&set, &choices, wanted, "", &mut report) else {
        return Err(report);
    };
    let inner = bindings::module_tokens(
        &kernel.validated.module,
        &kernel.linked.docs,
        &kernel.reflection,
        &paths,
        |group| group != 0,
        &[ROW, SURFACE, "BurleyModel"],
    );
    let module = &kernel.validated.module;
    let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(SURFACE));
    let surface = found.and_then(|(handle, _)| structure(module, &Docs::default(), handle));
    let mix = surface.and_then(|surface| surface.fields.into_iter().find(|field| field.name == MIX));
    let Some(mix) = mix else { return Err(report_of(&format!("`{SURFACE}` has no `{MIX}`"))) };
    let mix_offset = Literal::u32_unsuffixed(mix.offset);
    tokens.extend(quote! {
        /// Bindings that every kernel module has, whatever its materials.
        pub mod kernel {
            #inner
            /// Byte of a row of the parameter table at which `surface_albedo_mix` stands: what all materials have is first.
            pub const SURFACE_ALBEDO_MIX_OFFSET: usize = #mix_offset;
        }
    });
    Ok(bindings::format("// Generated by subsurface-codegen from the pass shaders.", tokens))
}

fn report_of(message: &str) -> Report {
    let mut report = Report::default();
    report.push(Diagnostic::error(message).help(DEFECT));
    report
}
