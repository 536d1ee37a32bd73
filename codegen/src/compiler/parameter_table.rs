//! How the kernel module declares its parameter table.

use std::fmt::Write as _;

use naga::TypeInner;
use subsurface_kernel::RowBinding;
use subsurface_shaders::Module;

use crate::compose::{Files, Glue, link};

use super::ROW;

/// Bytes that a uniform buffer may have on every device of WebGPU.
const LARGEST_UNIFORM_BUFFER: usize = 65536;

/// Adds the declaration to the glue: a uniform buffer where the rows fit, since software drivers load from a storage
/// buffer much more slowly at an index that is no constant. Returns what it declares.
pub(super) fn declare(glue: &mut Glue, rooms: &[Module], materials: usize) -> RowBinding {
    // Where the row cannot be laid out, the whole module cannot either, and linking or validating it says why.
    let bytes = row_bytes(glue, rooms).map(|bytes| bytes * materials);
    let (binding, declaration) = if bytes.is_some_and(|bytes| bytes <= LARGEST_UNIFORM_BUFFER) {
        (RowBinding::Uniform, format!("var<uniform> material_table: array<{ROW}, {materials}>;"))
    } else {
        (RowBinding::Storage, format!("var<storage, read> material_table: array<{ROW}>;"))
    };
    let _ = writeln!(
        glue.text,
        "\n/// One row per material of the set, in the order of the material numbers.\n\
         @group(0) @binding(0) {declaration}"
    );
    binding
}

/// Bytes of one row, as naga lays it out. Rows of either address space have one layout: see `emit_row`.
fn row_bytes(glue: &Glue, rooms: &[Module]) -> Option<usize> {
    let linked = link(Files { rooms, ..Files::default() }, glue, &[ROW], "").ok()?;
    let module = naga::front::wgsl::parse_str(&linked.text).ok()?;
    let (_, row) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(ROW))?;
    match row.inner {
        TypeInner::Struct { span, .. } => usize::try_from(span).ok(),
        _ => None,
    }
}
