//! What a compiler puts out for one set of materials.

use std::borrow::Cow;

use crate::constants::{CURVE_ROWS, CURVE_STEPS, CURVE_TEXEL_BYTES};
use crate::{KernelModule, PartsError};

/// Everything that the passes need for one set of materials: parts that fit each other.
///
/// Borrowed where they stand in the program, owned where they were compiled at run time. Generated Rust returns one from
/// `kernel()`, a compilation at run time turns into one; [`builder`](Self::builder) makes one from parts of any origin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KernelParts {
    module: KernelModule,
    material_names: Vec<Cow<'static, str>>,
    material_rows: Cow<'static, [u8]>,
    profile_curves: Cow<'static, [u8]>,
    curve_size: [u32; 2],
    profile_tables: Cow<'static, [u8]>,
}

impl KernelParts {
    /// Begins with the module; materials and curves must follow.
    pub fn builder(module: KernelModule) -> KernelPartsBuilder {
        KernelPartsBuilder {
            module,
            material_names: Vec::new(),
            material_rows: Cow::Borrowed(&[]),
            row_stride: 0,
            profile_curves: Cow::Borrowed(&[]),
            curve_size: [0; 2],
            profile_tables: Cow::Borrowed(&[]),
        }
    }

    /// The module.
    #[must_use]
    pub fn module(&self) -> &KernelModule {
        &self.module
    }

    /// Names by material number.
    pub fn material_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.material_names.iter().map(AsRef::as_ref)
    }

    /// Number of the material of that name: what the surface target's fourth component holds.
    #[must_use]
    pub fn material_number(&self, name: &str) -> Option<u32> {
        self.material_names().position(|known| known == name).and_then(|number| u32::try_from(number).ok())
    }

    /// Bytes of the parameter table: one row of [`KernelModule::row_stride`] bytes per material, by number.
    #[must_use]
    pub fn material_rows(&self) -> &[u8] {
        &self.material_rows
    }

    /// Texels of the profiles' curves: four f32 each, rows from the top.
    #[must_use]
    pub fn profile_curves(&self) -> &[u8] {
        &self.profile_curves
    }

    /// Width and height of the curves, texels.
    #[must_use]
    pub fn curve_size(&self) -> [u32; 2] {
        self.curve_size
    }

    /// Bytes of the tables of tabulated profiles; empty where the module reads none.
    #[must_use]
    pub fn profile_tables(&self) -> &[u8] {
        &self.profile_tables
    }
}

/// Parts that [`build`](Self::build) checks against each other.
#[derive(Clone, Debug)]
#[must_use]
pub struct KernelPartsBuilder {
    module: KernelModule,
    material_names: Vec<Cow<'static, str>>,
    material_rows: Cow<'static, [u8]>,
    row_stride: u32,
    profile_curves: Cow<'static, [u8]>,
    curve_size: [u32; 2],
    profile_tables: Cow<'static, [u8]>,
}

impl KernelPartsBuilder {
    /// The materials: names by number, and a row of `stride` bytes for each.
    pub fn materials<N: Into<Cow<'static, str>>>(
        mut self,
        names: impl IntoIterator<Item = N>,
        rows: impl Into<Cow<'static, [u8]>>,
        stride: u32,
    ) -> Self {
        self.material_names = names.into_iter().map(Into::into).collect();
        self.material_rows = rows.into();
        self.row_stride = stride;
        self
    }

    /// The curves of all profiles: texels of four f32, rows from the top, and width and height in texels.
    pub fn profile_curves(mut self, texels: impl Into<Cow<'static, [u8]>>, size: [u32; 2]) -> Self {
        self.profile_curves = texels.into();
        self.curve_size = size;
        self
    }

    /// The tables of tabulated profiles; left out where the module reads none.
    pub fn profile_tables(mut self, knots: impl Into<Cow<'static, [u8]>>) -> Self {
        self.profile_tables = knots.into();
        self
    }

    /// The parts, if they fit.
    ///
    /// # Errors
    /// Parts that are not of one compilation; both values are named.
    pub fn build(self) -> Result<KernelParts, PartsError> {
        let Self { module, material_names, material_rows, row_stride, .. } = self;
        let (profile_curves, curve_size, profile_tables) =
            (self.profile_curves, self.curve_size, self.profile_tables);
        if material_names.is_empty() {
            return Err(PartsError::NoMaterials);
        }
        if row_stride != module.row_stride {
            return Err(PartsError::RowStride { module: module.row_stride, rows: row_stride });
        }
        let expected = (row_stride as usize).checked_mul(material_names.len());
        if row_stride == 0 || expected != Some(material_rows.len()) {
            let (bytes, materials) = (material_rows.len(), material_names.len());
            return Err(PartsError::Rows { bytes, materials, stride: row_stride });
        }
        check_curves(&profile_curves, curve_size)?;
        match module.knot_stride {
            Some(stride)
                if profile_tables.is_empty() || profile_tables.len() % (stride.max(1) as usize) != 0 =>
            {
                return Err(PartsError::ProfileTables { bytes: profile_tables.len(), stride });
            }
            None if !profile_tables.is_empty() => {
                return Err(PartsError::UnreadProfileTables { bytes: profile_tables.len() });
            }
            _ => {}
        }
        let estimator = module.estimator;
        if let Some(entry_point) = estimator.entry_points().find(|name| !module.has_entry_point(name)) {
            let found = module.entry_points().map(str::to_owned).collect();
            return Err(PartsError::Estimator { estimator, entry_point, found });
        }
        if let Some(expected) = estimator.refused_taps() {
            return Err(PartsError::Taps { estimator, expected });
        }
        Ok(KernelParts { module, material_names, material_rows, profile_curves, curve_size, profile_tables })
    }
}

/// Curves are texels of that size, in whole rows of a curve, and no taller than the shaders look for them.
fn check_curves(texels: &[u8], size: [u32; 2]) -> Result<(), PartsError> {
    let [width, height] = size;
    let count = (width as usize).checked_mul(height as usize);
    let expected = count.and_then(|count| count.checked_mul(CURVE_TEXEL_BYTES));
    let is_grid = width > 0 && width % CURVE_STEPS == 0 && (1..=CURVE_ROWS).contains(&height);
    if is_grid && expected == Some(texels.len()) {
        Ok(())
    } else {
        Err(PartsError::ProfileCurves { width, height, bytes: texels.len() })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::{Estimator, RowBinding};

    const DENSE: &[&str] = &[
        "subsurface_vertex",
        "subsurface_fragment",
        "passthrough_fragment",
        "classify_compute",
        "subsurface_compute",
    ];

    fn module(estimator: Estimator) -> KernelModule {
        KernelModule::new(estimator, "", 32, RowBinding::Uniform).with_entry_points(DENSE.iter().copied())
    }

    fn builder(module: KernelModule) -> KernelPartsBuilder {
        KernelParts::builder(module)
            .materials(["skin", "wax"], vec![0; 64], 32)
            .profile_curves(vec![0; 64 * 16], [64, 1])
    }

    #[test]
    fn parts_that_fit_are_taken() {
        let parts = builder(module(Estimator::Dense)).build().unwrap();
        assert_eq!((parts.material_number("wax"), parts.material_number("jade")), (Some(1), None));
        assert_eq!(parts.material_names().collect::<Vec<_>>(), ["skin", "wax"]);
    }

    #[test]
    fn parts_that_do_not_fit_are_refused_with_both_values() {
        let dense = || module(Estimator::Dense);
        let refusals = [
            (
                builder(dense()).materials(["skin"], vec![0; 48], 48),
                "rows of 48 bytes for a module that reads 32",
            ),
            (
                builder(dense()).materials(["skin"], vec![0; 64], 32),
                "64 bytes of rows do not hold 1 material",
            ),
            (builder(dense()).materials([""; 0], vec![], 32), "at least one material"),
            (builder(dense()).profile_curves(vec![0; 64 * 16], [64, 2]), "64×2 texels"),
            (builder(dense()).profile_curves(vec![0; 32 * 16], [32, 1]), "32×1 texels"),
            (builder(dense()).profile_tables(vec![0; 20]), "reads no profile tables, and 20 bytes"),
            (builder(dense().with_profile_tables(20)), "knots of 20 bytes, and 0 bytes"),
            (builder(dense().with_profile_tables(20)).profile_tables(vec![0; 30]), "20 bytes, and 30 bytes"),
            (
                builder(module(Estimator::Interleaved { taps: 4 })),
                "Interleaved, 4 taps needs `first_fragment`",
            ),
            (builder(module(Estimator::ImportanceSampled { taps: 0 })), "a whole number from 1 to 4096"),
        ];
        for (builder, says) in refusals {
            let error = builder.build().unwrap_err().to_string();
            assert!(error.contains(says), "{error}\ndoes not say: {says}");
        }
    }
}
