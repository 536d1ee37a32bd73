//! A kernel module: WGSL, and what it asks of the tables beside it.

use std::borrow::Cow;
use std::ops::Range;

use crate::{DebugView, Estimator, OutputFormat};

/// Which buffer a module reads its rows from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RowBinding {
    /// A uniform buffer, which software drivers read faster: rows that fit 64 KiB.
    Uniform,
    /// A storage buffer.
    Storage,
}

/// A kernel module as text, with what the compiler knows of it from naga.
///
/// The text and the facts about it come from one compilation and travel together: nothing reads the text again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KernelModule {
    pub(crate) estimator: Estimator,
    pub(crate) wgsl: Cow<'static, str>,
    pub(crate) row_stride: u32,
    pub(crate) row_binding: RowBinding,
    pub(crate) knot_stride: Option<u32>,
    pub(crate) output_format: OutputFormat,
    pub(crate) output_format_place: Option<Range<usize>>,
    pub(crate) entry_points: Vec<Cow<'static, str>>,
}

impl KernelModule {
    /// A module that holds `estimator`, and reads rows of `row_stride` bytes from a buffer of kind `row_binding`.
    pub fn new(
        estimator: Estimator,
        wgsl: impl Into<Cow<'static, str>>,
        row_stride: u32,
        row_binding: RowBinding,
    ) -> Self {
        Self {
            estimator,
            wgsl: wgsl.into(),
            row_stride,
            row_binding,
            knot_stride: None,
            output_format: OutputFormat::default(),
            output_format_place: None,
            entry_points: Vec::new(),
        }
    }

    /// Names the entry points of the module, as naga has them.
    #[must_use]
    pub fn with_entry_points<N: Into<Cow<'static, str>>>(
        mut self,
        entry_points: impl IntoIterator<Item = N>,
    ) -> Self {
        self.entry_points = entry_points.into_iter().map(Into::into).collect();
        self
    }

    /// The module reads tables of profiles, knots of `knot_stride` bytes.
    #[must_use]
    pub fn with_profile_tables(mut self, knot_stride: u32) -> Self {
        self.knot_stride = Some(knot_stride);
        self
    }

    /// The compute path writes `format`; `place` is where the text spells it, in bytes. Without a place the module writes
    /// this format alone.
    #[must_use]
    pub fn with_output_format(mut self, format: OutputFormat, place: Option<Range<usize>>) -> Self {
        self.output_format = format;
        self.output_format_place = place;
        self
    }

    /// The estimator that the module holds, with the taps that a frame takes unless it says otherwise.
    #[must_use]
    pub fn estimator(&self) -> Estimator {
        self.estimator
    }

    /// The text.
    #[must_use]
    pub fn wgsl(&self) -> &str {
        &self.wgsl
    }

    /// Bytes of a row of the parameter table.
    #[must_use]
    pub fn row_stride(&self) -> u32 {
        self.row_stride
    }

    /// Which buffer the rows are read from.
    #[must_use]
    pub fn row_binding(&self) -> RowBinding {
        self.row_binding
    }

    /// Bytes of a knot of the profile tables; `None` for a module that reads none.
    #[must_use]
    pub fn knot_stride(&self) -> Option<u32> {
        self.knot_stride
    }

    /// Format that the compute path writes as the text stands.
    #[must_use]
    pub fn output_format(&self) -> OutputFormat {
        self.output_format
    }

    /// Where the text spells that format, in bytes.
    #[must_use]
    pub fn output_format_place(&self) -> Option<Range<usize>> {
        self.output_format_place.clone()
    }

    /// The text with another output format; `None` where the module does not say the place of its own.
    #[must_use]
    pub fn wgsl_for(&self, format: OutputFormat) -> Option<Cow<'_, str>> {
        if format == self.output_format {
            return Some(Cow::Borrowed(&self.wgsl));
        }
        let Range { start, end } = self.output_format_place.clone()?;
        let (before, after) = (self.wgsl.get(..start)?, self.wgsl.get(end..)?);
        Some(Cow::Owned([before, format.wgsl(), after].concat()))
    }

    /// Names of the entry points.
    pub fn entry_points(&self) -> impl ExactSizeIterator<Item = &str> {
        self.entry_points.iter().map(AsRef::as_ref)
    }

    /// Whether the module has an entry point of this name.
    #[must_use]
    pub fn has_entry_point(&self, name: &str) -> bool {
        self.entry_points().any(|known| known == name)
    }

    /// Whether the module has the entry points of the G-buffer pass.
    #[must_use]
    pub fn has_gbuffer(&self) -> bool {
        self.has_entry_point("gbuffer_vertex") && self.has_entry_point("gbuffer_fragment")
    }

    /// Whether the module can draw debug views.
    #[must_use]
    pub fn has_debug_views(&self) -> bool {
        self.has_entry_point(DebugView::ENTRY_POINT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_format_stands_in_the_place_of_the_first() {
        let text = "alias Output = texture_storage_2d<rgba16float, write>;";
        let start = text.find("rgba16float").unwrap_or_default();
        let module = KernelModule::new(Estimator::Dense, text, 16, RowBinding::Uniform);
        assert_eq!(module.wgsl_for(OutputFormat::Rgba32Float), None);
        let module = module.with_output_format(OutputFormat::Rgba16Float, Some(start..start + 11));
        assert_eq!(module.wgsl_for(OutputFormat::Rgba16Float).as_deref(), Some(text));
        let other = module.wgsl_for(OutputFormat::Rgba8Unorm);
        assert_eq!(other.as_deref(), Some("alias Output = texture_storage_2d<rgba8unorm, write>;"));
    }
}
