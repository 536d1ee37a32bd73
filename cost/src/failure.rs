//! Why no figures come.

use std::path::PathBuf;

/// Why no figures come, and what helps.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    #[error("the materials do not compile:\n{0}")]
    Materials(String),
    #[error("naga refuses {0}: {1}")]
    Naga(String, String),
    #[error(
        "no Vulkan loader: {0}\n  = help: on Debian and Ubuntu `apt-get install mesa-vulkan-drivers libvulkan1`"
    )]
    NoLoader(String),
    #[error(
        "RADV, which compiles for AMD GPUs that are not there, does not start: {0}\n  = help: on Debian and Ubuntu \
         `apt-get install mesa-vulkan-drivers libvulkan1`; elsewhere name the file radeon_icd…json in VK_DRIVER_FILES"
    )]
    NoRadv(ash::vk::Result),
    #[error(
        "the first device is `{0}`, which is not RADV's\n  = help: name the file radeon_icd…json in VK_DRIVER_FILES"
    )]
    OtherDriver(String),
    #[error("RADV refuses `{entry_point}`: {error}")]
    Refused { entry_point: String, error: ash::vk::Result },
    #[error(
        "loop {place} of `{function}` has no known number of rounds\n  = help: say it in `Loop::rounds`, cost/src/loops.rs"
    )]
    UnknownLoop { function: String, place: usize },
    #[error("texels of `{0}` have no known size\n  = help: say it in `texel_bytes`, cost/src/loads.rs")]
    UnknownTexture(String),
    #[error("`{0}` in a loop cannot be copied\n  = help: say how in cost/src/copy.rs")]
    CannotCopy(String),
    #[error("cannot {action} {}: {why}", path.display())]
    File { action: &'static str, path: PathBuf, why: String },
    /// What [`is_missing`](Self::is_missing) said in the process for one GPU.
    #[error("{0}")]
    Missing(String),
    #[error("the process for {family} failed: {why}")]
    Child { family: &'static str, why: String },
    #[error("{count} figures differ by more than {percent} % from {}:\n{text}\n  = help: if they should, run `cargo xtask shader-cost --bless`, then look at `git diff`", path.display())]
    Stale { count: usize, percent: f64, path: PathBuf, text: String },
    #[error("{} was written with {theirs}, and this is {ours}: other compilers give other figures", path.display())]
    OtherVersion { path: PathBuf, theirs: String, ours: String },
}

impl Failure {
    /// Whether this machine lacks the compiler.
    fn is_missing(&self) -> bool {
        matches!(self, Self::NoLoader(_) | Self::NoRadv(_) | Self::OtherDriver(_) | Self::Missing(_))
    }

    /// What the process says to the one that started it.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::OtherVersion { .. } => OTHER_VERSION,
            other if other.is_missing() => MISSING,
            _ => 1,
        }
    }
}

/// Nothing was compared, since the accepted figures are another compiler's.
const OTHER_VERSION: u8 = 3;

/// Nothing was compiled, since the compiler is not there.
pub(crate) const MISSING: u8 = 4;
