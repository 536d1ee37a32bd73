//! Values and the WGSL struct that they fill: every member has a value, and every value a member.

use naga::Module;

use crate::docs::Docs;
use crate::layout::{FieldType, Structure, structure};
use crate::value::Value;

/// How values differ from the members of a struct.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum ValueMismatch {
    /// Members without a value, and values without a member.
    #[error(
        "the values of `{structure}` are not those of its WGSL: {}",
        differences(without_value, without_member)
    )]
    Names {
        /// The WGSL struct.
        structure: String,
        /// Its members that get no value.
        without_value: Vec<String>,
        /// Values for which it has no member.
        without_member: Vec<String>,
    },
    /// A member of another type than its value.
    #[error("the member `{member}` of `{structure}` is {expected} in WGSL, and its value is {found}")]
    Type {
        /// The WGSL struct.
        structure: String,
        /// The member.
        member: String,
        /// Its type.
        expected: String,
        /// What the value is.
        found: &'static str,
    },
}

fn differences(without_value: &[String], without_member: &[String]) -> String {
    let list = |names: &[String]| names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let mut parts = Vec::new();
    if !without_value.is_empty() {
        parts.push(format!("no value for the member {}", list(without_value)));
    }
    if !without_member.is_empty() {
        parts.push(format!("no member for the value {}", list(without_member)));
    }
    parts.join(", ")
}

/// Checks `value` against the struct `layout` and all structs within it.
pub(crate) fn check(module: &Module, layout: &Structure, value: &Value) -> Result<(), ValueMismatch> {
    let structure_name = || layout.name.clone();
    let fields = match value {
        Value::Struct(fields) => fields,
        Value::Zero => return Ok(()),
        _ => {
            return Err(ValueMismatch::Type {
                structure: structure_name(),
                member: String::new(),
                expected: "a struct".to_owned(),
                found: kind(value),
            });
        }
    };
    let is_given = |name: &str| fields.iter().any(|(field, _)| *field == name);
    let without_value: Vec<String> =
        layout.fields.iter().map(|field| field.name.clone()).filter(|name| !is_given(name)).collect();
    let without_member: Vec<String> = fields
        .iter()
        .map(|(field, _)| (*field).to_owned())
        .filter(|name| layout.fields.iter().all(|field| field.name != *name))
        .collect();
    if !(without_value.is_empty() && without_member.is_empty()) {
        return Err(ValueMismatch::Names { structure: structure_name(), without_value, without_member });
    }
    for field in &layout.fields {
        let Some(value) = value.field(&field.name) else { continue };
        let fits = match (&field.ty, value) {
            (_, Value::Zero) | (FieldType::F32, Value::F32(_)) | (FieldType::U32, Value::U32(_)) => true,
            (FieldType::Vector { scalar: "f32", length }, Value::Vector(components)) => {
                components.len() == *length
            }
            (FieldType::Struct(handle), Value::Struct(_)) => {
                if let Some(inner) = structure(module, &Docs::default(), *handle) {
                    check(module, &inner, value)?;
                }
                true
            }
            _ => false,
        };
        if !fits {
            return Err(ValueMismatch::Type {
                structure: structure_name(),
                member: field.name.clone(),
                expected: format!("{:?}", field.ty),
                found: kind(value),
            });
        }
    }
    Ok(())
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::F32(_) => "an f32",
        Value::U32(_) => "a u32",
        Value::Vector(_) => "a vector of f32 of its own length",
        Value::Struct(_) => "a struct",
        Value::Zero => "zero",
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    fn mismatch(value: &Value) -> Option<String> {
        let text = "struct Inner { c: vec3f } struct Row { a: f32, b: u32, inner: Inner }\n\
                    @group(0) @binding(0) var<uniform> row: Row;";
        let module = naga::front::wgsl::parse_str(text).unwrap();
        let (handle, _) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some("Row")).unwrap();
        let layout = structure(&module, &Docs::default(), handle).unwrap();
        check(&module, &layout, value).err().map(|mismatch| mismatch.to_string())
    }

    #[test]
    fn every_member_has_a_value_and_every_value_a_member() {
        let inner = || ("inner", Value::Struct(vec![("c", Value::vector([1.0; 3]))]));
        let whole = Value::Struct(vec![("a", Value::scalar(1.0)), ("b", Value::U32(2)), inner()]);
        assert_eq!(mismatch(&whole), None);
        let zero =
            Value::Struct(vec![("a", Value::scalar(1.0)), ("b", Value::U32(2)), ("inner", Value::Zero)]);
        assert_eq!(mismatch(&zero), None);
        let renamed = Value::Struct(vec![("a", Value::scalar(1.0)), ("old", Value::U32(2)), inner()]);
        let text = mismatch(&renamed).unwrap();
        assert!(text.contains("no value for the member `b`, no member for the value `old`"), "{text}");
        let deep = ("inner", Value::Struct(vec![("d", Value::vector([1.0; 3]))]));
        let text = mismatch(&Value::Struct(vec![("a", Value::scalar(1.0)), ("b", Value::U32(2)), deep]));
        assert!(text.unwrap().contains("`Inner`"));
    }

    #[test]
    fn types_must_agree() {
        for value in [Value::U32(1), Value::vector([1.0; 2]), Value::Struct(Vec::new())] {
            let inner = ("inner", Value::Zero);
            let text = mismatch(&Value::Struct(vec![("a", value), ("b", Value::U32(2)), inner])).unwrap();
            assert!(text.contains("the member `a` of `Row` is F32"), "{text}");
        }
    }
}
