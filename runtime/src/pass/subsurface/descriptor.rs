//! How the subsurface pass is made.

use crate::label::Label;
use crate::timestamps::Timestamps;
use crate::wgpu;
use subsurface_kernel::ComputeShape;

use super::{NAME, Path};

/// How a [`SubsurfacePass`](crate::SubsurfacePass) is made.
///
/// ```
/// use subsurface_runtime::{GBuffer, SubsurfaceDescriptor, wgpu};
///
/// let descriptor = SubsurfaceDescriptor { stencil: Some(GBuffer::DEPTH_STENCIL_FORMAT), ..Default::default() };
/// assert_eq!(descriptor.format, wgpu::TextureFormat::Rgba16Float);
/// assert_eq!((descriptor.path, descriptor.material_ids), (None, false));
/// ```
#[derive(Clone, Debug)]
pub struct SubsurfaceDescriptor<'a> {
    /// What the labels of its objects begin with; `None`, the default, for `SubsurfacePass`.
    pub label: Option<&'a str>,
    /// Format of the output; by default `Rgba16Float`, which holds radiance and which every device with compute shaders
    /// can store to.
    pub format: wgpu::TextureFormat,
    /// Format of [`SubsurfaceInputs::depth_stencil`](crate::SubsurfaceInputs::depth_stencil), if there will be one; by
    /// default none.
    pub stencil: Option<wgpu::TextureFormat>,
    /// The path to take. `None`, the default: compute shaders where the device has them and can store to `format`, else
    /// fragment shaders; [`compute_refusal`](crate::SubsurfacePass::compute_refusal) says why.
    pub path: Option<Path>,
    /// How the compute path shares its work, where the kernel has a choice. `None`, the default: by the kind of adapter,
    /// a CPU or not.
    pub shape: Option<ComputeShape>,
    /// Whether material numbers come from a texture of their own,
    /// [`SubsurfaceInputs::material_ids`](crate::SubsurfaceInputs::material_ids); by default not.
    pub material_ids: bool,
    /// Where compiled pipelines are kept; by default nowhere.
    pub pipeline_cache: Option<&'a wgpu::PipelineCache>,
    /// Where the pass writes its times; by default nowhere.
    pub timestamps: Option<Timestamps>,
}

impl Default for SubsurfaceDescriptor<'_> {
    fn default() -> Self {
        Self {
            label: None,
            format: wgpu::TextureFormat::Rgba16Float,
            stencil: None,
            path: None,
            shape: None,
            material_ids: false,
            pipeline_cache: None,
            timestamps: None,
        }
    }
}

impl SubsurfaceDescriptor<'_> {
    /// The defaults for an output of `format`.
    pub fn new(format: wgpu::TextureFormat) -> Self {
        Self { format, ..Default::default() }
    }

    pub(super) fn settings(&self) -> Settings {
        Settings {
            label: Label::new(self.label, NAME),
            format: self.format,
            stencil: self.stencil,
            path: self.path,
            shape: self.shape,
            material_ids: self.material_ids,
            pipeline_cache: self.pipeline_cache.cloned(),
            timestamps: self.timestamps.clone(),
        }
    }
}

/// A descriptor that the pass keeps, for kernels to come.
#[derive(Debug)]
pub(super) struct Settings {
    pub(super) label: Label,
    pub(super) format: wgpu::TextureFormat,
    pub(super) stencil: Option<wgpu::TextureFormat>,
    pub(super) path: Option<Path>,
    shape: Option<ComputeShape>,
    material_ids: bool,
    pub(super) pipeline_cache: Option<wgpu::PipelineCache>,
    pub(super) timestamps: Option<Timestamps>,
}

impl Settings {
    pub(super) fn has_material_ids(&self) -> bool {
        self.material_ids
    }

    /// The shape that was asked for, or else the one that suits the device.
    pub(super) fn shape(&self, device: &wgpu::Device) -> ComputeShape {
        self.shape.unwrap_or_else(|| match device.adapter_info().device_type {
            wgpu::DeviceType::Cpu => ComputeShape::Software,
            _ => ComputeShape::Hardware,
        })
    }

    /// Values of the module's `override`s.
    pub(super) fn constants(&self) -> &'static [(&'static str, f64)] {
        if self.material_ids { &[("HAS_MATERIAL_IDS", 1.0)] } else { &[] }
    }
}
