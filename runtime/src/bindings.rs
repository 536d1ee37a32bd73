//! Typed bindings that the build script generated from the pass shaders.

#![allow(dead_code, reason = "generated for every entry point, whichever the passes use")]
#![allow(unreachable_pub, reason = "generated for use in any module")]
#![allow(clippy::all, clippy::pedantic, reason = "generated")]

include!(concat!(env!("OUT_DIR"), "/bindings.rs"));
