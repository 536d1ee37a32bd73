//! What material and profile files may say: shapes with spans in, checked values with spans out.
//!
//! Everything that can be said of one file alone is said here; names of other files stay names.

mod decoder;
mod material;
mod model_error_text;
mod profile;
mod quantity;
mod rounded;

pub(crate) use decoder::{Decoder, Given, Tables, Triple};
pub(crate) use material::{LengthGiven, MaterialFile, SCHEMA_VERSION, decode_material};
pub(crate) use profile::{ProfileExpression, ProfileFile, decode_profile_file};
pub(crate) use rounded::rounded;
