//! SPIR-V as wgpu gives it to a Vulkan driver.

use naga::back::spv::{Options, PipelineOptions, WriterFlags, ZeroInitializeWorkgroupMemoryMode, write_vec};
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ShaderStage};

use crate::Failure;
use crate::stage::Stage;

/// Words of the SPIR-V of a stage.
pub(crate) fn of(stage: &Stage) -> Result<Vec<u32>, Failure> {
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&stage.module)
        .map_err(|error| Failure::Naga(stage.entry_point.clone(), error.emit_to_string("")))?;
    words(&stage.module, &info, &stage.entry_point, stage.kind)
}

/// Words of the SPIR-V of one entry point.
///
/// The options are those of wgpu's Vulkan backend on a device with robust buffers and images, which RADV's are.
pub(crate) fn words(
    module: &Module,
    info: &ModuleInfo,
    entry_point: &str,
    stage: ShaderStage,
) -> Result<Vec<u32>, Failure> {
    let options = Options {
        lang_version: (1, 6),
        flags: WriterFlags::empty(),
        bounds_check_policies: BoundsCheckPolicies {
            index: BoundsCheckPolicy::Restrict,
            buffer: BoundsCheckPolicy::Unchecked,
            image_load: BoundsCheckPolicy::Unchecked,
            binding_array: BoundsCheckPolicy::Unchecked,
        },
        // The pass asks for none: its stages write what they read.
        zero_initialize_workgroup_memory: ZeroInitializeWorkgroupMemoryMode::None,
        force_loop_bounding: true,
        ..Options::default()
    };
    let pipeline = PipelineOptions { shader_stage: stage, entry_point: entry_point.to_owned() };
    write_vec(module, info, &options, Some(&pipeline))
        .map_err(|error| Failure::Naga(entry_point.to_owned(), error.to_string()))
}
