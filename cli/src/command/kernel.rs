//! `--kernel`, `--taps`, `--path` and `--shape`, as several commands take them.

use super::material_set;
use crate::draw::{LARGEST_TAPS, Route};
use crate::failure::Failure;
use crate::suggestion::suggest;
use clap::{Args, ValueEnum, value_parser};
use subsurface_codegen::{Compilation, Compiler, Estimator};
use subsurface_runtime::EstimatorError;
use subsurface_runtime::{ComputeShape, Path};

/// Which kernel diffuses, and how.
#[derive(Clone, Copy, Debug, Args)]
pub struct KernelArguments {
    /// Estimator, with its number of taps: interleaved[:1…64], importance-sampled[:1…4096], separable[:3…65, odd],
    /// separable-rotated[:3…65, odd] or dense; by default what the material set says.
    ///
    /// Without a number: 4 taps for interleaved, 17 for the others; dense reads every pixel in reach.
    #[arg(long, value_name = "NAME[:TAPS]", value_parser = estimator)]
    pub kernel: Option<Estimator>,
    /// Taps per pixel, instead of the kernel's own number.
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=i64::from(LARGEST_TAPS)))]
    pub taps: Option<u32>,
    /// Which shaders diffuse.
    #[command(flatten)]
    pub route: RouteArguments,
}

/// Which shaders diffuse.
#[derive(Clone, Copy, Debug, Args)]
pub struct RouteArguments {
    /// Whether compute or fragment shaders diffuse; by default compute shaders where the device has them.
    #[arg(long, value_enum)]
    pub path: Option<PathName>,
    /// How the compute shaders of interleaved share their work; by default as suits the kind of device. The pictures are
    /// alike.
    #[arg(long, value_enum)]
    pub shape: Option<ShapeName>,
}

impl RouteArguments {
    /// What is asked for.
    pub(super) fn chosen(self) -> Route {
        Route { path: self.path.map(Path::from), shape: self.shape.map(ComputeShape::from) }
    }
}

/// A way to share the work of compute shaders.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShapeName {
    /// A pixel per invocation: for GPUs.
    Hardware,
    /// Four pixels per invocation: for drivers that run on a CPU.
    Software,
}

impl From<ShapeName> for ComputeShape {
    fn from(name: ShapeName) -> Self {
        match name {
            ShapeName::Hardware => Self::Hardware,
            ShapeName::Software => Self::Software,
        }
    }
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

/// An estimator as people write it, `interleaved:8`; a misspelt name gets a suggestion.
pub(super) fn estimator(text: &str) -> Result<Estimator, String> {
    text.parse().map_err(|error| match error {
        EstimatorError::UnknownName { name } => {
            let names = Estimator::ALL.map(|estimator| estimator.command_name().to_owned());
            format!("no kernel is called `{name}`; {}", suggest(&name, &names))
        }
        other => other.to_string(),
    })
}

impl KernelArguments {
    /// Compiles with the kernel that is asked for; prints warnings.
    ///
    /// Taps go into the module's header with the kernel, so a number alone means compiling again with the set's own.
    pub(super) fn compile(&self, compiler: &Compiler) -> Result<Compilation, Failure> {
        let with = |estimator| material_set::finish(compiler.clone().estimator(estimator).compile());
        match (self.kernel, self.taps) {
            (Some(estimator), None) => with(estimator),
            (Some(estimator), Some(taps)) => with(retapped(estimator, taps)?),
            (None, None) => material_set::finish(compiler.compile()),
            (None, Some(taps)) => {
                let own = compiler.compile().map_err(|report| material_set::failure(&report))?;
                with(retapped(own.estimator(), taps)?)
            }
        }
    }
}

/// The estimator with another number of taps.
fn retapped(estimator: Estimator, taps: u32) -> Result<Estimator, Failure> {
    estimator.checked_taps(taps).map_err(|error| {
        Failure::new(format!("--taps {taps}: {error}"), "choose another number, or another --kernel")
    })
}

#[cfg(test)]
mod tests {
    use super::estimator;

    #[test]
    fn a_misspelt_kernel_says_what_is_meant() {
        for (text, says) in [
            ("interleafed", "did you mean `interleaved`?"),
            ("gauss", "there are: interleaved, importance-sampled"),
            ("separable:16", "an odd number of taps from 3 to 65"),
        ] {
            let error = estimator(text).err().unwrap_or_default();
            assert!(error.contains(says), "{text}: {error}");
        }
    }
}
