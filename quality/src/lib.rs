//! How large the error of a kernel is, before there is a picture: kernels and tap counts are tried on the processor until
//! one is within the error that is asked for.
//!
//! The central function is [`search`]: materials and an error in, a [`QualityReport`] out. The rooms are those of the
//! shaders: [`gather`] and `kernels` hold the twins of the WGSL files under the same stems.
//!
//! # The error
//!
//! A family of pictures whose diffusion is known exactly is drawn by an f64 twin of each kernel. Every material is tried
//! on all of them, with its own surface albedo, and every model with a surface albedo of 1, which a scene without textures
//! has (but for the albedo edge); the irradiance is white (1 in all channels) or black (0):
//!
//! - *step edge*: a plane, one half of it white;
//! - *line*: a white line, one pixel wide, on a black plane;
//! - *disc*: a white disc on a black plane, its radius half as long again as the mean radius of the profile;
//! - *crease*: two planes that meet at a right angle, each 45° from the view axis, one of them white;
//! - *albedo edge*: a plane, one half of it white and with a surface albedo less by 15 %;
//! - *pixel*: one white pixel on a black plane;
//! - *pan*: a white disc with a radius of 3.5 pixels that moves by one to three pixels along both axes: what matters is how
//!   much the result differs from what it was before;
//! - *ball*: a ball of eight mean radii in stripes of light of three, with nothing behind its rim;
//! - *frame*: a step edge in a frame of two mean radii, beyond which nothing is seen.
//!
//! Each is seen at footprints where the mean radius of the widest channel's profile spans 1, 3 and 10 pixels, but the ball
//! at 3 alone, and the frame at 10, 30 and 100; the step edge is seen at 30 and 100 pixels too, as close up.
//!
//! The test region of a picture reaches two mean radii and three pixels beyond the feature, on both sides; of ball and frame
//! it is all that shows a surface. It consists of squares of 4×4 pixels. Four pixels are the period of everything that
//! kernels lay on the pixel grid (blocks of two, lattices of two blocks), so each square holds every phase once; the feature
//! takes every phase as well, in each square or, where there are many, from square to square. Of more than 24 squares in a
//! row, more than 16 around what is lit (8 for the disc that moves) or more than 64 on a ball, only as many are taken.
//!
//! The error of one picture is the root mean square over the test region of the difference between kernel and exact
//! result, in one channel. The error of a kernel is the largest over pictures, footprints, channels and materials. As the
//! white level is 1, it is a fraction of the step's height. The largest difference of a single pixel is stated beside it.
//!
//! The exact result is what an infinite number of taps gives: the profile integrated over each lit pixel. On crease and ball
//! light travels along the straight line between two pixels' centres, which is what `Dense` takes it for too. What a kernel
//! returns to the centre (`rejected: ReturnedToCentre`) is returned there as well; rejection by normals is left out on
//! both sides, since nothing in these pictures is told apart by normals alone.
//!
//! # What it is not
//!
//! Rounding of the GPU's own is left out: nine bits per number between the stages of `Interleaved` are within 2e-3 of a
//! pixel's brightest channel. Of textured surface albedos only one edge is tried.
//!
//! What this crate does not know: RON, WGSL, the GPU; what a texture makes of a material.

mod angle;
mod device;
pub mod gather;
mod kernels;
mod material;
mod no_profile;
mod noise;
mod optics;
mod pictures;
mod quality;
mod report;
mod search;
mod search_error;

#[cfg(test)]
mod tests;

pub use device::Device;
pub use material::Material;
pub use no_profile::NoProfile;
pub use quality::{Quality, Tier};
pub use report::{PictureReport, QualityReport, TierReport};
pub use search::cost::cost;
pub use search::search;
pub use search_error::SearchError;
