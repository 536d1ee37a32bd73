//! Scenes as Mitsuba 3 reads them.
//!
//! Each object is a medium inside its own mesh: homogeneous, scattering isotropically. One file per colour channel, since
//! a path through a medium has one mean free path.

mod closed;
mod emitter;
mod medium;
mod ply;
mod scene;

pub use closed::{Flaw, flaws};
pub use medium::{Boundary, Medium};
pub use ply::ply;
pub use scene::{CHANNELS, Exported, xml};
