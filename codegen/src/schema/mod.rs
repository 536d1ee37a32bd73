//! What material and profile files may say: shapes with spans in, checked values with spans out.
//!
//! Everything that can be said of one file alone is said here; names of other files stay names.

mod body;
mod choice;
mod clear;
mod decoder;
mod diffuse;
mod material;
mod medium;
mod model;
mod model_error_text;
mod profile;
mod quality;
mod quantity;
mod set_file;

pub(crate) use clear::{CLEAR, ClearFile, decode_clear};
pub(crate) use decoder::{Decoder, Given, Tables, Triple};
pub(crate) use diffuse::{DiffuseGiven, no_entry, other_coupling};
pub(crate) use material::{LengthGiven, MaterialFile, SCHEMA_VERSION, decode_material};
pub(crate) use medium::{OrMedium, clear_medium, reflectance_at_normal};
pub(crate) use model::length_word;
pub(crate) use profile::{ProfileExpression, ProfileFile, decode_profile_file};
pub(crate) use set_file::{SET, SetFile, decode_set_file};
pub(crate) use subsurface_profile::rounded;
