//! Memory layout of host-shareable structs as naga has it, and values laid out by it.

use naga::{Handle, Module, ScalarKind, Type, TypeInner, VectorSize};

use crate::docs::Docs;
use crate::value::Value;

/// Shape of a field, as far as the generated Rust needs it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum FieldType {
    F32,
    I32,
    U32,
    /// Vector of 32-bit scalars.
    Vector {
        scalar: &'static str,
        length: usize,
    },
    /// Matrix of f32 by columns; `rows_padded` floats lie between the starts of two columns.
    Matrix {
        columns: usize,
        rows_padded: usize,
    },
    /// Fixed-size array.
    Array {
        element: Box<FieldType>,
        length: u32,
    },
    /// Another struct.
    Struct(Handle<Type>),
}

/// One field.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) docs: Vec<String>,
    pub(crate) offset: u32,
    pub(crate) size: u32,
    pub(crate) ty: FieldType,
}

/// A struct.
#[derive(Clone, Debug)]
pub(crate) struct Structure {
    pub(crate) name: String,
    pub(crate) docs: Vec<String>,
    pub(crate) size: u32,
    pub(crate) fields: Vec<Field>,
}

/// The layout of a struct; `None` for another type, or one that no Rust struct can mirror.
pub(crate) fn structure(module: &Module, docs: &Docs, handle: Handle<Type>) -> Option<Structure> {
    let ty = &module.types[handle];
    let TypeInner::Struct { members, span } = &ty.inner else { return None };
    let name = ty.name.clone()?;
    let mut fields = Vec::with_capacity(members.len());
    for member in members {
        let member_name = member.name.clone()?;
        fields.push(Field {
            docs: docs.of_member(&name, &member_name),
            name: member_name,
            offset: member.offset,
            size: module.types[member.ty].inner.try_size(module.to_ctx())?,
            ty: field_type(module, member.ty)?,
        });
    }
    Some(Structure { docs: docs.of(&name), name, size: *span, fields })
}

fn field_type(module: &Module, handle: Handle<Type>) -> Option<FieldType> {
    Some(match &module.types[handle].inner {
        TypeInner::Scalar(scalar) => match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 4) => FieldType::F32,
            (ScalarKind::Sint, 4) => FieldType::I32,
            (ScalarKind::Uint, 4) => FieldType::U32,
            _ => return None,
        },
        TypeInner::Vector { size, scalar } => {
            let name = match (scalar.kind, scalar.width) {
                (ScalarKind::Float, 4) => "f32",
                (ScalarKind::Sint, 4) => "i32",
                (ScalarKind::Uint, 4) => "u32",
                _ => return None,
            };
            FieldType::Vector { scalar: name, length: *size as usize }
        }
        TypeInner::Matrix { columns, rows, scalar } if scalar.width == 4 => FieldType::Matrix {
            columns: *columns as usize,
            rows_padded: if *rows == VectorSize::Bi { 2 } else { 4 },
        },
        TypeInner::Array { base, size: naga::ArraySize::Constant(length), stride } => {
            let element = field_type(module, *base)?;
            // A Rust array has no gaps: refuse elements whose stride is larger than they are.
            if module.types[*base].inner.try_size(module.to_ctx())? != *stride {
                return None;
            }
            FieldType::Array { element: Box::new(element), length: length.get() }
        }
        TypeInner::Struct { .. } => FieldType::Struct(handle),
        _ => return None,
    })
}

/// The bytes of `value`, which [`check`](crate::value_mismatch::check) accepts, in the layout of the struct `handle`.
pub(crate) fn bytes_of(module: &Module, handle: Handle<Type>, value: &Value) -> Vec<u8> {
    array_bytes(module, handle, std::slice::from_ref(value))
}

/// The bytes of an array of such values.
pub(crate) fn array_bytes(module: &Module, handle: Handle<Type>, values: &[Value]) -> Vec<u8> {
    let Some(layout) = structure(module, &Docs::default(), handle) else { return Vec::new() };
    values.iter().flat_map(|value| encoded(module, &layout, value)).collect()
}

fn encoded(module: &Module, layout: &Structure, value: &Value) -> Vec<u8> {
    let mut bytes = vec![0; layout.size as usize];
    for field in &layout.fields {
        let Some(value) = value.field(&field.name) else { continue };
        let encoded = match (value, &field.ty) {
            (Value::F32(value), FieldType::F32) => value.to_le_bytes().to_vec(),
            (Value::U32(value), FieldType::U32) => value.to_le_bytes().to_vec(),
            (Value::Vector(components), FieldType::Vector { .. }) => {
                components.iter().flat_map(|component| component.to_le_bytes()).collect()
            }
            (Value::Struct(_), FieldType::Struct(inner)) => bytes_of(module, *inner, value),
            (Value::Zero, _) => continue,
            _ => unreachable!("the emitter writes {} with the type it declares", field.name),
        };
        let start = field.offset as usize;
        bytes[start..start + encoded.len()].copy_from_slice(&encoded);
    }
    bytes
}
