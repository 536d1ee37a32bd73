//! Names and numbers that no material has.

/// A name or a number that no material of a set has. Generated `Material` enums give it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum UnknownMaterial {
    /// No material is called so.
    #[error("no material of the set is called `{0}`: `Material::NAMES` lists them")]
    Name(String),
    /// No material has this number.
    #[error("no material of the set has the number {0}: they count from 0, and `Material::ALL` lists them")]
    Number(u32),
}
