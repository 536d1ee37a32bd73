//! The subsurface pass alone, on somebody's own buffers.

use subsurface_codegen::Compilation;
use subsurface_runtime::wgpu;

use super::buffers::{Buffers, PixelScale};
use super::device::Device;
use super::route::Route;
use super::uploaded::{Precision, Uploaded};
use super::{beyond_device, out_of_order, subsurface_pass};
use crate::failure::Failure;
use crate::picture::LinearPicture;

/// Runs the subsurface pass alone: the diffused irradiance, background passed through.
pub fn diffuse(
    buffers: &Buffers,
    materials: &Compilation,
    scale: PixelScale,
    route: Route,
    frame_index: u32,
) -> Result<LinearPicture, Failure> {
    let device = Device::open()?;
    device.checked(|| {
        let uploaded = Uploaded::new(&device, buffers, materials, Precision::Single)?;
        let format = wgpu::TextureFormat::Rgba32Float;
        let mut pass = subsurface_pass(&device, &materials.parts, format, route)?;
        route.check(&pass)?;
        pass.bind(&device.device, &uploaded.inputs()).map_err(|error| beyond_device(&error))?;
        let output = pass.create_output(&device.device).map_err(out_of_order)?;
        let view = scale.view(buffers.size.height).with_frame_index(frame_index);
        pass.prepare(&device.queue, &view).map_err(out_of_order)?;
        device.submit(|encoder| pass.encode(encoder, &output.view))?;
        let texels = device.read(&output.texture)?;
        Ok(LinearPicture {
            size: buffers.size,
            pixels: texels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect(),
        })
    })
}
