//! The contract between a material set and the passes.

use std::borrow::Cow;

use crate::kernel_kind::KernelKind;

/// A kernel module with the tables of its materials: [`KernelParts`] that fit each other.
///
/// Generated Rust makes one with [`from_generated`](Self::from_generated); whoever compiles materials at run time makes
/// one with [`new`](Self::new) from the compiler's output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SubsurfaceKernel {
    parts: KernelParts,
}

/// What a compiler puts out for one set of materials: borrowed where it stands in the program, owned where it was
/// compiled at run time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KernelParts {
    /// The module's text.
    pub wgsl: Cow<'static, str>,
    /// Bytes of the parameter table: one row per material, by number.
    pub material_table: Cow<'static, [u8]>,
    /// Names by material number.
    pub material_names: Vec<Cow<'static, str>>,
    /// Bytes of the tables of tabulated profiles; empty where no material has one.
    pub profile_tables: Cow<'static, [u8]>,
    /// Texels of the profiles' curves: four f32 each, rows from the top.
    pub profile_curves: Cow<'static, [u8]>,
    /// Width and height of the curves, texels.
    pub curve_size: [u32; 2],
    /// The estimator that the module holds.
    pub kind: KernelKind,
    /// Taps per pixel unless a [`SubsurfaceView`](crate::SubsurfaceView) says otherwise.
    pub taps: u32,
}

/// How the compiler's WGSL declares a parameter table that is a uniform buffer. Comments of ours do not spell it.
const UNIFORM_MATERIAL_TABLE: &str = "@group(0) @binding(0) var<uniform> material_table:";

/// How the compiler's WGSL declares the buffer of the profile tables. Comments of ours do not spell it.
const PROFILE_TABLES: &str = "@group(0) @binding(1) var<storage, read> profile_tables:";

/// How the compiler's WGSL declares what the compute path writes to.
const DIFFUSED_TEXTURE: &str = "alias DiffusedTexture = texture_storage_2d<";

/// Bytes of a texel of the curves.
const CURVE_TEXEL: usize = 16;

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
    /// The curves are not a texture of that size.
    #[error(
        "curves of {width}×{height} texels take 16 bytes each, not {bytes} in all: give curves and size of one compilation"
    )]
    ProfileCurves {
        /// Width, texels.
        width: u32,
        /// Height, texels.
        height: u32,
        /// Bytes of the curves.
        bytes: usize,
    },
}

impl SubsurfaceKernel {
    /// A kernel from a compiler's output.
    ///
    /// # Errors
    /// No material, a table that does not hold one row for each, no profile tables for WGSL that reads some, or some
    /// for WGSL that reads none, or curves that are not of their size.
    pub fn new(parts: KernelParts) -> Result<Self, KernelError> {
        let (bytes, materials) = (parts.material_table.len(), parts.material_names.len());
        if materials == 0 {
            return Err(KernelError::NoMaterials);
        }
        // Rows hold vec3f, hence come in multiples of 16 bytes.
        if bytes == 0 || bytes % (16 * materials) != 0 {
            return Err(KernelError::Table { bytes, materials });
        }
        if parts.wgsl.contains(PROFILE_TABLES) == parts.profile_tables.is_empty() {
            return Err(KernelError::ProfileTables { bytes: parts.profile_tables.len() });
        }
        let [width, height] = parts.curve_size;
        let texels = (width as usize).checked_mul(height as usize);
        let expected = texels.and_then(|texels| texels.checked_mul(CURVE_TEXEL));
        if expected != Some(parts.profile_curves.len()) || parts.profile_curves.is_empty() {
            return Err(KernelError::ProfileCurves { width, height, bytes: parts.profile_curves.len() });
        }
        Ok(Self { parts })
    }

    /// A kernel from generated Rust, whose parts fit by construction: nothing is checked. For parts from elsewhere
    /// there is [`new`](Self::new).
    pub fn from_generated(parts: KernelParts) -> Self {
        Self { parts }
    }

    /// The estimator that the module holds.
    pub fn kind(&self) -> KernelKind {
        self.parts.kind
    }

    /// Taps per pixel unless a [`SubsurfaceView`](crate::SubsurfaceView) says otherwise.
    pub fn taps(&self) -> u32 {
        self.parts.taps
    }

    /// Format that the compute path writes, as the compiler was told.
    pub fn compute_format(&self) -> Option<wgpu::TextureFormat> {
        let (_, rest) = self.parts.wgsl.split_once(DIFFUSED_TEXTURE)?;
        match rest.split_once(',')?.0 {
            "rgba16float" => Some(wgpu::TextureFormat::Rgba16Float),
            "rgba32float" => Some(wgpu::TextureFormat::Rgba32Float),
            _ => None,
        }
    }

    /// Texels of the profiles' curves, as bytes, and their size.
    pub fn profile_curves(&self) -> (&[u8], [u32; 2]) {
        (&self.parts.profile_curves, self.parts.curve_size)
    }

    /// The module's text.
    pub fn wgsl(&self) -> &str {
        &self.parts.wgsl
    }

    /// Bytes of the parameter table: one row per material, by number.
    pub fn material_table(&self) -> &[u8] {
        &self.parts.material_table
    }

    /// Bytes of the tables of tabulated profiles; empty where no material uses one.
    pub fn profile_tables(&self) -> &[u8] {
        &self.parts.profile_tables
    }

    /// Whether the module reads the parameter table from a uniform buffer: the compiler's choice, by its size.
    pub(crate) fn has_uniform_material_table(&self) -> bool {
        self.parts.wgsl.contains(UNIFORM_MATERIAL_TABLE)
    }

    /// Bytes of one row.
    pub fn material_stride(&self) -> usize {
        // Unchecked parts may name no material.
        self.parts.material_table.len() / self.parts.material_names.len().max(1)
    }

    /// Names by material number.
    pub fn material_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.parts.material_names.iter().map(AsRef::as_ref)
    }

    /// Number of the material of that name: what the surface target's fourth component holds.
    pub fn material_number(&self, name: &str) -> Option<u32> {
        self.material_names().position(|known| known == name).and_then(|number| u32::try_from(number).ok())
    }

    pub(crate) fn shader_module(&self, device: &wgpu::Device) -> wgpu::ShaderModule {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("SubsurfaceKernel module"),
            source: wgpu::ShaderSource::Wgsl(self.parts.wgsl.as_ref().into()),
        })
    }
}
