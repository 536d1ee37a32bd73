//! `subsurface build`.

use super::material_set;
use crate::failure::Failure;
use crate::say;
use clap::Args;
use std::path::PathBuf;

/// Arguments of `subsurface build`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface build --materials materials --out generated")]
pub struct BuildArguments {
    /// Directory of materials: one .ron file each, profiles in DIR/profiles.
    #[arg(long, value_name = "DIR", default_value = material_set::DEFAULT_DIRECTORY)]
    pub materials: PathBuf,
    /// Directory for the files; created if missing. A file that would not change is left alone.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// Runs the command.
pub fn run(arguments: &BuildArguments) -> Result<(), Failure> {
    let compilation = material_set::compile(&arguments.materials)?;
    compilation.write_to(&arguments.out).map_err(|error| Failure::reported(error.to_string()))?;
    let tables = (!compilation.parts.profile_tables().is_empty()).then_some("tables");
    for extension in ["wgsl", "rs", "json"].into_iter().chain(tables) {
        say!("{}", arguments.out.join("subsurface").with_extension(extension).display());
    }
    Ok(())
}
