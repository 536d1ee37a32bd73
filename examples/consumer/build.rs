fn main() {
    subsurface_codegen::Compiler::new("materials").build_or_exit();
}
