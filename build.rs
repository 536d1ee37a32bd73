//! Compiles `materials/` into the presets.

fn main() {
    subsurface_codegen::Compiler::new("materials").build_or_exit();
}
