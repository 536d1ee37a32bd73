//! A kernel on a device, for all passes that use it.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use subsurface_kernel::{Estimator, KernelModule, KernelParts, OutputFormat};

use crate::albedo_mixes::AlbedoMixes;
use crate::load_error::LoadError;
use crate::material_table::{MaterialTable, storage_buffers};
use crate::target::Target;
use crate::texture_format::texture_format;
use crate::wgpu;

/// A kernel on a device: its module, its materials and their curves, held once for all passes.
///
/// It is cheap to clone. Make it once, and again when materials change; the passes take the new one with `set_kernel`.
///
/// ```no_run
/// # use subsurface_runtime::{KernelParts, LoadedKernel, SubsurfaceDescriptor, SubsurfacePass, wgpu};
/// # fn load(device: &wgpu::Device, queue: &wgpu::Queue, parts: &KernelParts) -> Result<(), Box<dyn std::error::Error>> {
/// let kernel = LoadedKernel::new(device, queue, parts)?;
/// let pass = SubsurfacePass::new(device, &kernel, &SubsurfaceDescriptor::default())?;
/// let skin = kernel.material_number("skin");
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct LoadedKernel(Arc<Loaded>);

#[derive(Debug)]
struct Loaded {
    module: KernelModule,
    material_names: Vec<String>,
    has_profile_tables: bool,
    table: MaterialTable,
    albedo_mixes: AlbedoMixes,
    shader: wgpu::ShaderModule,
    /// The module for other output formats, by their place in `OutputFormat::ALL`: made when a pass first asks for one.
    other_shaders: [OnceLock<wgpu::ShaderModule>; OutputFormat::ALL.len()],
    /// Stands for a scale of the mean free path that is not given: one pixel of 1.
    unit_scale: Target,
    /// Stands for material numbers that are not given: one pixel, which is not read.
    no_material_ids: Target,
}

impl LoadedKernel {
    /// Makes the module and uploads the tables; the next submission to `queue` carries them.
    ///
    /// # Errors
    /// Tables or curves beyond the device's limits; both values are named.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, parts: &KernelParts) -> Result<Self, LoadError> {
        let table = MaterialTable::new(device, queue, parts)?;
        let unit_scale = Target::single_pixel(
            device,
            queue,
            wgpu::TextureFormat::R32Float,
            "LoadedKernel scale of 1",
            bytemuck::bytes_of(&1.0_f32),
        );
        let no_material_ids = Target::single_pixel(
            device,
            queue,
            wgpu::TextureFormat::R8Uint,
            "LoadedKernel no material ids",
            &[0],
        );
        Ok(Self(Arc::new(Loaded {
            module: parts.module().clone(),
            material_names: parts.material_names().map(str::to_owned).collect(),
            has_profile_tables: !parts.profile_tables().is_empty(),
            table,
            albedo_mixes: AlbedoMixes::of(device, parts),
            shader: shader_module(device, "LoadedKernel module", parts.module().wgsl().into()),
            other_shaders: Default::default(),
            unit_scale,
            no_material_ids,
        })))
    }

    /// The module as text, and what the compiler knows of it.
    pub fn module(&self) -> &KernelModule {
        &self.0.module
    }

    /// The estimator that the kernel was compiled for.
    pub fn estimator(&self) -> Estimator {
        self.0.module.estimator()
    }

    /// Names of the materials, by number.
    pub fn material_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.0.material_names.iter().map(String::as_str)
    }

    /// Number of the material of that name: what the surface input holds where the material is.
    ///
    /// Numbers belong to one kernel: a set compiled again may give another number to the same name, or none.
    pub fn material_number(&self, name: &str) -> Option<u32> {
        self.material_names().position(|known| known == name).and_then(|number| u32::try_from(number).ok())
    }

    /// Layout of bind group 0, for pipelines of passes of your own (`Compiler::with_pass`).
    pub fn bind_group_layout(&self) -> &wgpu::BindGroupLayout {
        &self.0.table.layout
    }

    /// Bind group 0: the parameter table, the tables of tabulated profiles where there are some, and the curves.
    pub fn bind_group(&self) -> &wgpu::BindGroup {
        &self.0.table.bind_group
    }

    /// The module on the device.
    pub fn shader_module(&self) -> &wgpu::ShaderModule {
        &self.0.shader
    }

    /// The module whose compute path writes `format`; `None` where the text has no place for another than its own.
    pub(crate) fn shader_module_for(
        &self,
        device: &wgpu::Device,
        format: OutputFormat,
    ) -> Option<&wgpu::ShaderModule> {
        if format == self.0.module.output_format() {
            return Some(&self.0.shader);
        }
        let index = OutputFormat::ALL.iter().position(|known| *known == format)?;
        let text = self.0.module.wgsl_for(format)?;
        let label = format!("LoadedKernel module, {}", format.wgsl());
        Some(self.0.other_shaders[index].get_or_init(|| shader_module(device, &label, text)))
    }

    /// Format that the compute path writes as the text stands.
    pub(crate) fn own_format(&self) -> Option<wgpu::TextureFormat> {
        texture_format(self.0.module.output_format())
    }

    /// Storage buffers that the kernel reads in every stage.
    pub(crate) fn storage_buffers(&self) -> u32 {
        storage_buffers(self.0.module.row_binding(), self.0.has_profile_tables)
    }

    pub(crate) fn albedo_mixes(&self) -> &AlbedoMixes {
        &self.0.albedo_mixes
    }

    pub(crate) fn unit_scale(&self) -> &wgpu::TextureView {
        &self.0.unit_scale.view
    }

    pub(crate) fn no_material_ids(&self) -> &wgpu::TextureView {
        &self.0.no_material_ids.view
    }
}

fn shader_module(device: &wgpu::Device, label: &str, text: Cow<'_, str>) -> wgpu::ShaderModule {
    let source = wgpu::ShaderSource::Wgsl(text);
    device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(label), source })
}
