//! Numbers out of buffers: every access is checked, so that a damaged file gives a message and no panic.

use super::source::Sources;
use super::{GltfError, Place};
use gltf::accessor::{DataType, Dimensions};

/// Reads an accessor of vectors with `N` components as `f32`; integers are scaled to [0, 1] or [-1, 1] where the
/// accessor says that they are normalized.
pub(super) fn vectors<const N: usize>(
    accessor: &gltf::Accessor<'_>,
    what: &'static str,
    sources: &Sources,
    place: &Place,
) -> Result<Vec<[f32; N]>, GltfError> {
    let expected = match N {
        2 => (Dimensions::Vec2, "VEC2"),
        _ => (Dimensions::Vec3, "VEC3"),
    };
    if accessor.dimensions() != expected.0 {
        let found = format!("{:?}", accessor.dimensions()).to_uppercase();
        return Err(GltfError::AccessorType { place: place.clone(), what, expected: expected.1, found });
    }
    let kind = accessor.data_type();
    let scale = match (accessor.normalized(), kind) {
        (false, _) | (true, DataType::F32 | DataType::U32) => 1.0,
        (true, DataType::U8) => 1.0 / f32::from(u8::MAX),
        (true, DataType::U16) => 1.0 / f32::from(u16::MAX),
        (true, DataType::I8) => 1.0 / f32::from(i8::MAX),
        (true, DataType::I16) => 1.0 / f32::from(i16::MAX),
    };
    let mut vectors = Vec::new();
    for element in elements(accessor, what, sources, place)? {
        let mut vector = [0.0; N];
        for (component, bytes) in vector.iter_mut().zip(element.chunks_exact(kind.size())) {
            *component = scale * number(kind, bytes) as f32;
        }
        vectors.push(vector);
    }
    Ok(vectors)
}

/// Reads an accessor of indices.
pub(super) fn indices(
    accessor: &gltf::Accessor<'_>,
    sources: &Sources,
    place: &Place,
) -> Result<Vec<u32>, GltfError> {
    const WHAT: &str = "the index list";
    let kind = accessor.data_type();
    let unsigned = matches!(kind, DataType::U8 | DataType::U16 | DataType::U32);
    if !unsigned || accessor.dimensions() != Dimensions::Scalar {
        return Err(GltfError::AccessorType {
            place: place.clone(),
            what: WHAT,
            expected: "SCALAR of U8, U16 or U32",
            found: format!("{:?} of {kind:?}", accessor.dimensions()).to_uppercase(),
        });
    }
    // Every u32 is exact in f64.
    Ok(elements(accessor, WHAT, sources, place)?.map(|bytes| number(kind, bytes) as u32).collect())
}

/// The bytes of each element.
fn elements<'a>(
    accessor: &gltf::Accessor<'_>,
    what: &'static str,
    sources: &'a Sources,
    place: &Place,
) -> Result<impl Iterator<Item = &'a [u8]>, GltfError> {
    if accessor.sparse().is_some() {
        return Err(GltfError::AccessorSparse { place: place.clone(), what });
    }
    let out_of_range = || GltfError::AccessorOutOfRange { place: place.clone(), what };
    let view = accessor.view().ok_or_else(out_of_range)?;
    let bytes = sources.view(&view).ok_or_else(out_of_range)?;
    let size = accessor.size();
    let stride = view.stride().unwrap_or(size);
    let bytes = bytes.get(accessor.offset()..).ok_or_else(out_of_range)?;
    let count = accessor.count();
    // The last element needs only its own size, not a whole stride.
    let needed =
        count.checked_sub(1).and_then(|rest| rest.checked_mul(stride)).and_then(|n| n.checked_add(size));
    if count > 0 && needed.is_none_or(|needed| needed > bytes.len()) {
        return Err(out_of_range());
    }
    Ok((0..count).map(move |index| &bytes[index * stride..index * stride + size]))
}

/// One little-endian number; `bytes` is as long as `kind` says.
fn number(kind: DataType, bytes: &[u8]) -> f64 {
    match (kind, bytes) {
        (DataType::I8, [a]) => f64::from(i8::from_le_bytes([*a])),
        (DataType::U8, [a]) => f64::from(*a),
        (DataType::I16, [a, b]) => f64::from(i16::from_le_bytes([*a, *b])),
        (DataType::U16, [a, b]) => f64::from(u16::from_le_bytes([*a, *b])),
        (DataType::U32, [a, b, c, d]) => f64::from(u32::from_le_bytes([*a, *b, *c, *d])),
        (DataType::F32, [a, b, c, d]) => f64::from(f32::from_le_bytes([*a, *b, *c, *d])),
        _ => unreachable!("elements hands out whole numbers"),
    }
}
