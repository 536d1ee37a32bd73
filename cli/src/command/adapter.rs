//! `subsurface adapter`.

use clap::Args;

use crate::draw::device::Device;
use crate::failure::Failure;
use crate::say;

/// Name the graphics adapter that pictures are drawn on; exit with 1 if there is none.
#[derive(Debug, Args)]
pub struct AdapterArguments {}

/// Runs the command.
pub fn run(_: &AdapterArguments) -> Result<(), Failure> {
    say!("{}", Device::open()?.description());
    Ok(())
}
