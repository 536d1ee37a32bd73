//! Values as the bytes of a WGSL struct.

use naga::Module;

use crate::diagnostics::Diagnostic;
use crate::docs::Docs;
use crate::layout::{Structure, array_bytes, structure};
use crate::value::Value;
use crate::value_mismatch::check;

use super::DEFECT;

/// Values of one WGSL struct, laid out one after the other as naga says.
pub(super) struct Rows {
    pub(super) structure: Structure,
    pub(super) bytes: Vec<u8>,
}

impl Rows {
    /// Lays `values` out as the struct `name` of the module.
    ///
    /// # Errors
    /// A module without that struct, a member without a value, or a value without a member.
    pub(super) fn of(
        module: &Module,
        docs: &Docs,
        name: &str,
        values: &[Value],
    ) -> Result<Self, Box<Diagnostic>> {
        let defect = |message: String| Box::new(Diagnostic::error(message).help(DEFECT));
        let found = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
        let (handle, structure) = found
            .and_then(|(handle, _)| Some((handle, structure(module, docs, handle)?)))
            .ok_or_else(|| defect(format!("no module declares the struct `{name}`")))?;
        for value in values {
            check(module, &structure, value).map_err(|mismatch| defect(mismatch.to_string()))?;
        }
        Ok(Self { bytes: array_bytes(module, handle, values), structure })
    }
}
