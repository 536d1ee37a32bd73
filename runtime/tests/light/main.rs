//! The light of the G-buffer on scenes whose light is known.

#![allow(clippy::print_stdout, reason = "measured figures, shown on request")]

mod albedo_mix;
mod angles;
mod clear;
mod curvature;
mod energy;
#[path = "../gpu/mod.rs"]
mod gpu;
mod lobes;
mod scene;
mod textures;
mod thickness;
mod transmission;
