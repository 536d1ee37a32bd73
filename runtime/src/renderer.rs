//! All four passes in order.

use crate::camera::{Bounds, Camera};
use crate::error::{ResizeError, TexelsError};
use crate::geometry::{Geometry, Object, SurfaceDescriptor};
use crate::light::DirectionalLight;
use crate::pass::composite::{CompositeInputs, CompositePass, CompositeSettings};
use crate::pass::gbuffer::{GBufferPass, GBufferView};
use crate::pass::shadow::ShadowPass;
use crate::pass::subsurface::{SubsurfaceInputs, SubsurfacePass};
use crate::target::{Extent, GBuffer, Target};
use crate::view::SubsurfaceView;
use subsurface_kernel::KernelParts;

/// What one frame shows.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The camera.
    pub camera: Camera,
    /// Directional lights; those beyond [`LIGHT_CAPACITY`](crate::LIGHT_CAPACITY) are left out.
    pub lights: &'a [DirectionalLight],
    /// Irradiance that comes from everywhere alike, linear red, green, blue.
    pub ambient_irradiance: [f32; 3],
    /// Factor on every material's transmission: 1, or 0 for none.
    pub transmission: f32,
    /// A sphere around all objects.
    pub bounds: Bounds,
    /// Millimetres that a world unit has: 1000 for metres. There is no default: a wrong scale looks right too often.
    pub millimetres_per_world_unit: f32,
    /// Taps per pixel of the subsurface pass in place of the kernel's own number; 0 turns scattering off.
    pub taps: Option<u32>,
    /// Moves the pattern of the subsurface pass's taps on; 0 for a still picture.
    pub frame_index: u32,
    /// Exposure, tone mapping and background.
    pub composite: CompositeSettings,
}

impl Frame<'_> {
    /// How the subsurface pass sees this frame at a size of `size`.
    pub fn subsurface_view(&self, size: Extent) -> SubsurfaceView {
        let projection = self.camera.projection(size.width as f32 / size.height as f32, &self.bounds);
        let view = SubsurfaceView::from_projection(projection, size.height, self.millimetres_per_world_unit)
            .with_frame_index(self.frame_index);
        self.taps.map_or(view, |taps| view.with_taps(taps))
    }
}

/// Shadow → G-buffer → subsurface → composite.
#[derive(Debug)]
pub struct Renderer {
    /// Pass 1.
    pub shadow: ShadowPass,
    /// Pass 2.
    pub gbuffer: GBufferPass,
    /// Pass 3.
    pub subsurface: SubsurfacePass,
    /// Pass 4.
    pub composite: CompositePass,
    size: Option<Extent>,
}

impl Renderer {
    /// All that does not depend on the frame's size; `format` is that of the picture.
    pub fn new(device: &wgpu::Device, kernel: &KernelParts, format: wgpu::TextureFormat) -> Self {
        let shadow = ShadowPass::new(device);
        let gbuffer = GBufferPass::new(device, kernel, &shadow);
        let stencil = Some(GBuffer::DEPTH_STENCIL_FORMAT);
        let subsurface = SubsurfacePass::new(device, kernel, GBuffer::COLOUR_FORMAT, stencil);
        Self { shadow, gbuffer, subsurface, composite: CompositePass::new(device, format), size: None }
    }

    /// An object to draw.
    ///
    /// # Errors
    /// Textures whose bytes do not fit their size, or whose size is beyond the device's limit.
    pub fn object(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        geometry: Geometry,
        surface: &SurfaceDescriptor<'_>,
    ) -> Result<Object, TexelsError> {
        self.gbuffer.object(device, queue, geometry, surface)
    }

    /// Makes targets and bindings anew if `size` changed.
    ///
    /// # Errors
    /// A size of 0 or beyond the device's limit; the old targets stay.
    pub fn resize(&mut self, device: &wgpu::Device, size: Extent) -> Result<(), ResizeError> {
        if self.size == Some(size) {
            return Ok(());
        }
        self.gbuffer.resize(device, size)?;
        let Some(targets) = self.gbuffer.targets() else { return Ok(()) };
        let inputs = SubsurfaceInputs {
            irradiance: &targets.irradiance.view,
            surface: &targets.surface.view,
            depth: &targets.depth,
            depth_stencil: Some(&targets.depth_stencil.view),
            mean_free_path_scale: None,
        };
        self.subsurface.resize(device, size, &inputs)?;
        if let Some(Target { view: diffused, .. }) = self.subsurface.output() {
            let (unscattered, surface) = (&targets.unscattered.view, &targets.surface.view);
            self.composite.resize(device, &CompositeInputs { diffused, unscattered, surface });
        }
        self.size = Some(size);
        Ok(())
    }

    /// Uploads this frame's parameters.
    pub fn prepare(&mut self, queue: &wgpu::Queue, frame: &Frame<'_>) {
        let Some(size) = self.size else { return };
        self.shadow.prepare(queue, frame.lights, &frame.bounds);
        self.gbuffer.prepare(
            queue,
            &GBufferView {
                camera: &frame.camera,
                lights: frame.lights,
                ambient_irradiance: frame.ambient_irradiance,
                transmission: frame.transmission,
                bounds: frame.bounds,
                millimetres_per_world_unit: frame.millimetres_per_world_unit,
            },
        );
        self.subsurface.prepare(queue, &frame.subsurface_view(size));
        self.composite.prepare(queue, &frame.composite);
    }

    /// Records all four passes; the picture goes to `output`.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, objects: &[Object], output: &wgpu::TextureView) {
        self.shadow.encode(encoder, objects);
        self.gbuffer.encode(encoder, objects);
        self.subsurface.encode(encoder);
        self.composite.encode(encoder, output);
    }

    /// The G-buffer; `None` before the first [`resize`](Self::resize).
    pub fn targets(&self) -> Option<&GBuffer> {
        self.gbuffer.targets()
    }
}
