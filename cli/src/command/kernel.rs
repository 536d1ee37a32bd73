//! `--kernel`, `--taps` and `--path`, as several commands take them.

use super::material_set;
use crate::draw::LARGEST_TAPS;
use crate::failure::Failure;
use crate::kernel_name::KernelName;
use clap::{Args, ValueEnum, value_parser};
use subsurface_codegen::{Compilation, Compiler, Kernel};
use subsurface_runtime::Path;

/// Which kernel diffuses, and how.
#[derive(Clone, Copy, Debug, Args)]
pub struct KernelArguments {
    /// Kernel, with its number of taps: interleaved[:1…64], importance-sampled[:1…4096], separable[:3…65, odd],
    /// separable-rotated[:3…65, odd] or dense; by default what the material set says.
    ///
    /// Without a number: 4 taps for interleaved, 17 for the others; dense reads every pixel in reach.
    #[arg(long, value_name = "NAME[:TAPS]", value_parser = kernel)]
    pub kernel: Option<Kernel>,
    /// Taps per pixel, instead of the kernel's own number.
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=i64::from(LARGEST_TAPS)))]
    pub taps: Option<u32>,
    /// Whether compute or fragment shaders diffuse; by default compute shaders where the device has them.
    #[arg(long, value_enum)]
    pub path: Option<PathName>,
}

/// A path through the pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PathName {
    /// Compute shaders on the tiles that scatter.
    Compute,
    /// Fragment shaders behind the stencil test.
    Fragment,
}

impl From<PathName> for Path {
    fn from(name: PathName) -> Self {
        match name {
            PathName::Compute => Self::Compute,
            PathName::Fragment => Self::Fragment,
        }
    }
}

fn kernel(text: &str) -> Result<Kernel, String> {
    text.parse::<KernelName>()?.kernel()
}

impl KernelArguments {
    /// Compiles with the kernel that is asked for; prints warnings.
    ///
    /// Taps go into the module's header with the kernel, so a number alone means compiling again with the set's own.
    pub(super) fn compile(&self, compiler: &Compiler) -> Result<Compilation, Failure> {
        let with = |kernel| material_set::finish(compiler.clone().kernel(kernel).compile());
        match (self.kernel, self.taps) {
            (Some(kernel), None) => with(kernel),
            (Some(kernel), Some(taps)) => with(retapped(kernel, taps)?),
            (None, None) => material_set::finish(compiler.compile()),
            (None, Some(taps)) => {
                let own = compiler.compile().map_err(|report| material_set::failure(&report))?;
                with(retapped(own.kernel, taps)?)
            }
        }
    }

    /// The path that is asked for.
    pub(super) fn path(&self) -> Option<Path> {
        self.path.map(Path::from)
    }
}

/// The kernel with another number of taps.
fn retapped(kernel: Kernel, taps: u32) -> Result<Kernel, Failure> {
    let refused = |reason: String| {
        Failure::new(format!("--taps {taps}: {reason}"), "choose another number, or another --kernel")
    };
    let name = KernelName::of(kernel).ok_or_else(|| refused(format!("{kernel} has its own number")))?;
    KernelName { taps: Some(taps), ..name }.kernel().map_err(refused)
}
