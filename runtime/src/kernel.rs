//! The contract between a material set and the passes.

use std::borrow::Cow;

/// A kernel module and the parameter table of its materials.
///
/// Generated Rust makes one with [`from_generated`](Self::from_generated); whoever compiles materials at run time makes
/// one with [`new`](Self::new) from the compiler's output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SubsurfaceKernel {
    wgsl: Cow<'static, str>,
    material_table: Cow<'static, [u8]>,
    material_names: Vec<Cow<'static, str>>,
    profile_tables: Cow<'static, [u8]>,
}

/// How the compiler's WGSL declares the buffer of the profile tables. Comments of ours do not spell it.
const PROFILE_TABLES: &str = "@group(0) @binding(1) var<storage, read> profile_tables:";

/// Parts that do not make a kernel.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum KernelError {
    /// No material.
    #[error("a kernel needs at least one material: compile a set that has one")]
    NoMaterials,
    /// The table does not divide into one row per material.
    #[error(
        "a table of {bytes} bytes does not divide into rows for {materials} materials: give table and names of one compilation"
    )]
    Table {
        /// Bytes of the table.
        bytes: usize,
        /// Number of names.
        materials: usize,
    },
    /// No profile tables for WGSL that reads some, or some for WGSL that reads none.
    #[error(
        "the WGSL reads {}profile tables, and {bytes} bytes of them are given: give WGSL and profile tables of one compilation",
        if *bytes == 0 { "" } else { "no " }
    )]
    ProfileTables {
        /// Bytes of the profile tables: 0 where the WGSL reads some.
        bytes: usize,
    },
}

impl SubsurfaceKernel {
    /// A kernel from a compiler's output: the WGSL, the bytes of the parameter table, the material names by number, and
    /// the bytes of the tables of tabulated profiles, which are empty where no material has one.
    ///
    /// # Errors
    /// No material, a table that does not hold one row for each, no profile tables for WGSL that reads some, or some
    /// for WGSL that reads none.
    pub fn new(
        wgsl: String,
        material_table: Vec<u8>,
        material_names: Vec<String>,
        profile_tables: Vec<u8>,
    ) -> Result<Self, KernelError> {
        let (bytes, materials) = (material_table.len(), material_names.len());
        if materials == 0 {
            return Err(KernelError::NoMaterials);
        }
        // Rows of a storage buffer hold vec3f, hence come in multiples of 16 bytes.
        if bytes == 0 || bytes % (16 * materials) != 0 {
            return Err(KernelError::Table { bytes, materials });
        }
        if wgsl.contains(PROFILE_TABLES) == profile_tables.is_empty() {
            return Err(KernelError::ProfileTables { bytes: profile_tables.len() });
        }
        let material_names = material_names.into_iter().map(Cow::Owned).collect();
        Ok(Self {
            wgsl: Cow::Owned(wgsl),
            material_table: Cow::Owned(material_table),
            material_names,
            profile_tables: Cow::Owned(profile_tables),
        })
    }

    /// A kernel from generated Rust, whose parts fit by construction: those of [`new`](Self::new).
    pub fn from_generated(
        wgsl: &'static str,
        material_table: &'static [u8],
        material_names: &'static [&'static str],
        profile_tables: &'static [u8],
    ) -> Self {
        Self {
            wgsl: Cow::Borrowed(wgsl),
            material_table: Cow::Borrowed(material_table),
            material_names: material_names.iter().map(|name| Cow::Borrowed(*name)).collect(),
            profile_tables: Cow::Borrowed(profile_tables),
        }
    }

    /// The module's text.
    pub fn wgsl(&self) -> &str {
        &self.wgsl
    }

    /// Bytes of the parameter table: one row per material, by number.
    pub fn material_table(&self) -> &[u8] {
        &self.material_table
    }

    /// Bytes of the tables of tabulated profiles; empty where no material uses one.
    pub fn profile_tables(&self) -> &[u8] {
        &self.profile_tables
    }

    /// Bytes of one row.
    pub fn material_stride(&self) -> usize {
        self.material_table.len() / self.material_names.len()
    }

    /// Names by material number.
    pub fn material_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.material_names.iter().map(AsRef::as_ref)
    }

    /// Number of the material of that name: what the surface target's fourth component holds.
    pub fn material_number(&self, name: &str) -> Option<u32> {
        self.material_names().position(|known| known == name).and_then(|number| u32::try_from(number).ok())
    }

    pub(crate) fn shader_module(&self, device: &wgpu::Device) -> wgpu::ShaderModule {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("SubsurfaceKernel module"),
            source: wgpu::ShaderSource::Wgsl(self.wgsl.as_ref().into()),
        })
    }
}
