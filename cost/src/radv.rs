//! Mesa's RADV, asked for what it makes of a stage.
#![allow(unsafe_code, reason = "Vulkan's functions are C")]

use std::collections::BTreeMap;
use std::ffi::CString;

use ash::vk;
use naga::valid::ModuleInfo;
use naga::{AddressSpace, ImageClass, ScalarKind, ShaderStage, TypeInner};

use crate::Failure;
use crate::stage::Stage;

/// What the driver says of one stage, by the names that it gives its figures.
pub(crate) type Statistics = BTreeMap<String, f64>;

/// The driver, compiling for the family that `RADV_FORCE_FAMILY` names.
pub(crate) struct Radv {
    // Fields are dropped in this order; the library must go last.
    statistics: ash::khr::pipeline_executable_properties::Device,
    device: ash::Device,
    instance: ash::Instance,
    _entry: ash::Entry,
    version: String,
}

impl Radv {
    pub(crate) fn open() -> Result<Self, Failure> {
        // SAFETY: the loader is a well-behaved library, and nothing of it is used after `_entry` is dropped.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| Failure::NoLoader(error.to_string()))?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
        let info = vk::InstanceCreateInfo::default().application_info(&application);
        // SAFETY: what the structure points to outlives the call.
        let instance = unsafe { entry.create_instance(&info, None) }.map_err(Failure::NoRadv)?;
        // SAFETY: the instance lives.
        let devices = unsafe { instance.enumerate_physical_devices() }.map_err(Failure::NoRadv)?;
        let Some(&physical) = devices.first() else {
            return Err(Failure::NoRadv(vk::Result::ERROR_INCOMPATIBLE_DRIVER));
        };
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
        // SAFETY: the physical device is the instance's.
        unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
        let name =
            properties.properties.device_name_as_c_str().unwrap_or_default().to_string_lossy().into_owned();
        if driver.driver_id != vk::DriverId::MESA_RADV {
            return Err(Failure::OtherDriver(name));
        }
        let version = driver.driver_info_as_c_str().unwrap_or_default().to_string_lossy().into_owned();

        let queue = [vk::DeviceQueueCreateInfo::default().queue_family_index(0).queue_priorities(&[1.0])];
        let extensions = [ash::khr::pipeline_executable_properties::NAME.as_ptr()];
        let mut executable = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
            .pipeline_executable_info(true);
        let mut vulkan_13 = vk::PhysicalDeviceVulkan13Features::default()
            .dynamic_rendering(true)
            .robust_image_access(true)
            .shader_zero_initialize_workgroup_memory(true);
        let features = vk::PhysicalDeviceFeatures::default()
            .robust_buffer_access(true)
            .shader_storage_image_extended_formats(true);
        let info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queue)
            .enabled_extension_names(&extensions)
            .enabled_features(&features)
            .push_next(&mut executable)
            .push_next(&mut vulkan_13);
        // SAFETY: what the structures point to outlives the call.
        let device = unsafe { instance.create_device(physical, &info, None) }.map_err(Failure::NoRadv)?;
        let statistics = ash::khr::pipeline_executable_properties::Device::new(&instance, &device);
        Ok(Self { statistics, device, instance, _entry: entry, version })
    }

    /// `Mesa` and its version.
    pub(crate) fn version(&self) -> &str {
        &self.version
    }

    /// Compiles the stage from `words` of SPIR-V, with the vertex stage in `vertex_words` for fragments.
    pub(crate) fn compile(
        &self,
        stage: &Stage,
        info: &ModuleInfo,
        words: &[u32],
        vertex: Option<(&str, &[u32])>,
    ) -> Result<Statistics, Failure> {
        let refused = |error: vk::Result| Failure::Refused { entry_point: stage.entry_point.clone(), error };
        let name = CString::new(stage.entry_point.as_str()).unwrap_or_default();
        let layouts = bindings(stage, info);
        // SAFETY: every handle is the device's own, is made before it is used and destroyed after the pipeline is; what
        // structures point to outlives the calls.
        unsafe {
            let module = self.module(words).map_err(refused)?;
            let sets: Vec<vk::DescriptorSetLayout> = layouts
                .iter()
                .map(|bindings| {
                    let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(bindings);
                    self.device.create_descriptor_set_layout(&info, None)
                })
                .collect::<Result<_, _>>()
                .map_err(refused)?;
            let layout = self
                .device
                .create_pipeline_layout(&vk::PipelineLayoutCreateInfo::default().set_layouts(&sets), None)
                .map_err(refused)?;
            let vertex = match vertex {
                Some((vertex_name, vertex_words)) => {
                    let name = CString::new(vertex_name).unwrap_or_default();
                    Some((name, self.module(vertex_words).map_err(refused)?))
                }
                None => None,
            };
            let pipeline = match &vertex {
                None => self.compute_pipeline(module, &name, layout),
                Some((vertex_name, vertex)) => {
                    self.graphics_pipeline((*vertex, vertex_name), (module, &name), layout, &formats(stage))
                }
            }
            .map_err(refused)?;
            let statistics = self.statistics_of(pipeline, stage.kind).map_err(refused)?;
            self.device.destroy_pipeline(pipeline, None);
            self.device.destroy_pipeline_layout(layout, None);
            for set in sets {
                self.device.destroy_descriptor_set_layout(set, None);
            }
            self.device.destroy_shader_module(module, None);
            if let Some((_, vertex)) = vertex {
                self.device.destroy_shader_module(vertex, None);
            }
            Ok(statistics)
        }
    }

    unsafe fn module(&self, words: &[u32]) -> Result<vk::ShaderModule, vk::Result> {
        // SAFETY: naga writes valid SPIR-V.
        unsafe { self.device.create_shader_module(&vk::ShaderModuleCreateInfo::default().code(words), None) }
    }

    unsafe fn compute_pipeline(
        &self,
        module: vk::ShaderModule,
        name: &CString,
        layout: vk::PipelineLayout,
    ) -> Result<vk::Pipeline, vk::Result> {
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(name);
        let info = vk::ComputePipelineCreateInfo::default()
            .flags(vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR)
            .stage(stage)
            .layout(layout);
        // SAFETY: the handles are the device's own.
        let made = unsafe {
            self.device.create_compute_pipelines(vk::PipelineCache::null(), std::slice::from_ref(&info), None)
        };
        first(made)
    }

    unsafe fn graphics_pipeline(
        &self,
        vertex: (vk::ShaderModule, &CString),
        fragment: (vk::ShaderModule, &CString),
        layout: vk::PipelineLayout,
        formats: &[vk::Format],
    ) -> Result<vk::Pipeline, vk::Result> {
        let stage = |flags, (module, name): (vk::ShaderModule, &'_ CString)| {
            // The name lives as long as the pipeline is made.
            vk::PipelineShaderStageCreateInfo {
                stage: flags,
                module,
                p_name: name.as_ptr(),
                ..Default::default()
            }
        };
        let stages =
            [stage(vk::ShaderStageFlags::VERTEX, vertex), stage(vk::ShaderStageFlags::FRAGMENT, fragment)];
        let input = vk::PipelineVertexInputStateCreateInfo::default();
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
            .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let raster = vk::PipelineRasterizationStateCreateInfo::default().line_width(1.0);
        let samples = vk::PipelineMultisampleStateCreateInfo::default()
            .rasterization_samples(vk::SampleCountFlags::TYPE_1);
        let attachment =
            vk::PipelineColorBlendAttachmentState::default().color_write_mask(vk::ColorComponentFlags::RGBA);
        let attachments = vec![attachment; formats.len()];
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
        let states = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&states);
        let mut rendering = vk::PipelineRenderingCreateInfo::default().color_attachment_formats(formats);
        let info = vk::GraphicsPipelineCreateInfo::default()
            .flags(vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR)
            .stages(&stages)
            .vertex_input_state(&input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&raster)
            .multisample_state(&samples)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(layout)
            .push_next(&mut rendering);
        // SAFETY: the handles are the device's own.
        let made = unsafe {
            self.device.create_graphics_pipelines(
                vk::PipelineCache::null(),
                std::slice::from_ref(&info),
                None,
            )
        };
        first(made)
    }

    /// The figures of the executable that runs `kind`.
    unsafe fn statistics_of(
        &self,
        pipeline: vk::Pipeline,
        kind: ShaderStage,
    ) -> Result<Statistics, vk::Result> {
        let wanted = match kind {
            ShaderStage::Compute => vk::ShaderStageFlags::COMPUTE,
            _ => vk::ShaderStageFlags::FRAGMENT,
        };
        let info = vk::PipelineInfoKHR::default().pipeline(pipeline);
        // SAFETY: the pipeline is the device's own and was made to keep its figures.
        let executables = unsafe { self.statistics.get_pipeline_executable_properties(&info) }?;
        let mut figures = Statistics::new();
        for (index, executable) in executables.iter().enumerate() {
            if !executable.stages.contains(wanted) {
                continue;
            }
            figures.insert("Subgroup size".to_owned(), f64::from(executable.subgroup_size));
            let info = vk::PipelineExecutableInfoKHR::default()
                .pipeline(pipeline)
                .executable_index(u32::try_from(index).unwrap_or(u32::MAX));
            // SAFETY: as above.
            for statistic in unsafe { self.statistics.get_pipeline_executable_statistics(&info) }? {
                let name = statistic.name_as_c_str().unwrap_or_default().to_string_lossy().into_owned();
                // SAFETY: the format says which member is written.
                let value = unsafe {
                    match statistic.format {
                        vk::PipelineExecutableStatisticFormatKHR::UINT64 => statistic.value.u64 as f64,
                        vk::PipelineExecutableStatisticFormatKHR::INT64 => statistic.value.i64 as f64,
                        vk::PipelineExecutableStatisticFormatKHR::FLOAT64 => statistic.value.f64,
                        _ => f64::from(statistic.value.b32),
                    }
                };
                figures.insert(name, value);
            }
        }
        Ok(figures)
    }
}

impl Drop for Radv {
    fn drop(&mut self) {
        // SAFETY: every pipeline is destroyed where it was made.
        unsafe {
            self.device.destroy_device(None);
            self.instance.destroy_instance(None);
        }
    }
}

fn first(
    made: Result<Vec<vk::Pipeline>, (Vec<vk::Pipeline>, vk::Result)>,
) -> Result<vk::Pipeline, vk::Result> {
    made.map_err(|(_, error)| error)?.into_iter().next().ok_or(vk::Result::ERROR_UNKNOWN)
}

/// The bindings that the entry point uses, by group.
fn bindings(stage: &Stage, info: &ModuleInfo) -> Vec<Vec<vk::DescriptorSetLayoutBinding<'static>>> {
    let module = &stage.module;
    let entry_point = module.entry_points.iter().position(|found| found.name == stage.entry_point);
    let Some(entry_point) = entry_point else { return Vec::new() };
    let uses = info.get_entry_point(entry_point);
    let mut groups: Vec<Vec<vk::DescriptorSetLayoutBinding<'static>>> = Vec::new();
    for (handle, variable) in module.global_variables.iter() {
        let Some(binding) = &variable.binding else { continue };
        if uses[handle].is_empty() {
            continue;
        }
        let kind = match (&module.types[variable.ty].inner, variable.space) {
            (TypeInner::Image { class: ImageClass::Storage { .. }, .. }, _) => {
                vk::DescriptorType::STORAGE_IMAGE
            }
            (TypeInner::Image { .. }, _) => vk::DescriptorType::SAMPLED_IMAGE,
            (TypeInner::Sampler { .. }, _) => vk::DescriptorType::SAMPLER,
            (_, AddressSpace::Storage { .. }) => vk::DescriptorType::STORAGE_BUFFER,
            _ => vk::DescriptorType::UNIFORM_BUFFER,
        };
        let group = binding.group as usize;
        if groups.len() <= group {
            groups.resize(group + 1, Vec::new());
        }
        groups[group].push(
            vk::DescriptorSetLayoutBinding::default()
                .binding(binding.binding)
                .descriptor_type(kind)
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE | vk::ShaderStageFlags::FRAGMENT),
        );
    }
    groups
}

/// Formats of what a fragment stage writes, by the type of each location.
fn formats(stage: &Stage) -> Vec<vk::Format> {
    let Some(result) = stage.function().and_then(|function| function.result.as_ref()) else {
        return Vec::new();
    };
    let format = |ty: naga::Handle<naga::Type>| match stage.module.types[ty].inner {
        TypeInner::Vector { size: naga::VectorSize::Bi, scalar } if scalar.kind == ScalarKind::Uint => {
            vk::Format::R32G32_UINT
        }
        TypeInner::Vector { scalar, .. } if scalar.kind == ScalarKind::Uint => vk::Format::R32G32B32A32_UINT,
        _ => vk::Format::R16G16B16A16_SFLOAT,
    };
    match &stage.module.types[result.ty].inner {
        TypeInner::Struct { members, .. } => members.iter().map(|member| format(member.ty)).collect(),
        _ => vec![format(result.ty)],
    }
}
