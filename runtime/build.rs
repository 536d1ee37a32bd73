//! Generates the typed bindings of the runtime's own passes.

#[allow(clippy::print_stderr, reason = "Cargo shows a failed build script's standard error")]
fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let bindings = subsurface_codegen::runtime_bindings().unwrap_or_else(|report| {
        eprintln!("{report}");
        std::process::exit(1);
    });
    let out_dir = std::env::var_os("OUT_DIR").expect("Cargo sets OUT_DIR for build scripts");
    let path = std::path::Path::new(&out_dir).join("bindings.rs");
    if let Err(error) = std::fs::write(&path, bindings) {
        eprintln!("error: cannot write {}: {error}", path.display());
        std::process::exit(1);
    }
}
