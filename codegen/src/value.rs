//! Values of host-shareable types, written by field name and laid out later.

/// A value of a WGSL struct, vector or scalar.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    F32(f32),
    U32(u32),
    /// Components of a vector of f32.
    Vector(Vec<f32>),
    /// Fields of a struct by name.
    Struct(Vec<(&'static str, Value)>),
    /// Zero throughout, whatever the type: a part of a row that its material does not use.
    Zero,
}

impl Value {
    /// A vector of channels or coefficients, rounded to f32.
    pub(crate) fn vector<const N: usize>(components: [f64; N]) -> Self {
        Self::Vector(components.iter().map(|&component| single(component)).collect())
    }

    /// A scalar, rounded to f32.
    pub(crate) fn scalar(value: f64) -> Self {
        Self::F32(single(value))
    }

    /// The field of that name, if this is a struct that has it.
    pub(crate) fn field(&self, name: &str) -> Option<&Value> {
        match self {
            Self::Struct(fields) => fields.iter().find(|(field, _)| *field == name).map(|(_, value)| value),
            _ => None,
        }
    }
}

/// Rounds to the precision of the GPU.
#[allow(
    clippy::cast_possible_truncation,
    reason = "rounding to f32 is the point; the loader checked the range"
)]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}
