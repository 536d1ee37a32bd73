//! Pass 4: radiance, tone mapping, sRGB.

use crate::bindings::composite::{self, BindGroup0, ENTRY_COMPOSITE_FRAGMENT, ENTRY_COMPOSITE_VERTEX, WGSL};

/// What the pass reads. All views are of one size.
#[derive(Clone, Copy, Debug)]
pub struct CompositeInputs<'a> {
    /// Diffused irradiance, linear RGB.
    pub diffused: &'a wgpu::TextureView,
    /// Specular reflection + transmission; alpha 1 on geometry, 0 where the background shows.
    pub unscattered: &'a wgpu::TextureView,
    /// Surface albedo.
    pub surface: &'a wgpu::TextureView,
}

/// How radiance becomes a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompositeSettings {
    /// Factor on all radiance before tone mapping.
    pub exposure: f32,
    /// Tone map to [0, 1] (Khronos PBR Neutral) and, where the target does not do it, encode as sRGB. Off: linear
    /// radiance.
    pub tone_map: bool,
    /// Radiance of the background at the top and at the bottom, linear red, green, blue.
    pub background: [[f32; 3]; 2],
}

impl Default for CompositeSettings {
    fn default() -> Self {
        Self { exposure: 1.0, tone_map: true, background: [[0.035, 0.037, 0.042], [0.012, 0.012, 0.014]] }
    }
}

/// Multiplies with the surface albedo, adds what was not scattered and maps to the display.
#[derive(Debug)]
pub struct CompositePass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    uniform: wgpu::Buffer,
    bind_group: Option<wgpu::BindGroup>,
    format: wgpu::TextureFormat,
}

impl CompositePass {
    /// Pipeline and layout for an output of `format`.
    pub fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Self {
        let layout = BindGroup0::layout(device, "CompositePass layout");
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("CompositePass module"),
            source: wgpu::ShaderSource::Wgsl(WGSL.into()),
        });
        let entries = (ENTRY_COMPOSITE_VERTEX, ENTRY_COMPOSITE_FRAGMENT);
        let pipeline = super::covering_pipeline(
            device,
            "CompositePass pipeline",
            &module,
            entries,
            &[Some(&layout)],
            &[Some(format.into())],
            None,
        );
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("CompositePass settings"),
            size: size_of::<composite::CompositeSettings>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { pipeline, layout, uniform, bind_group: None, format }
    }

    /// Binds the inputs. Call it again when a view is replaced; the pass has no target of its own.
    pub fn resize(&mut self, device: &wgpu::Device, inputs: &CompositeInputs<'_>) {
        let bind_group = BindGroup0 {
            composite_settings: self.uniform.as_entire_buffer_binding(),
            diffused_texture: inputs.diffused,
            unscattered_texture: inputs.unscattered,
            surface_texture: inputs.surface,
        }
        .create(device, &self.layout, "CompositePass bind group");
        self.bind_group = Some(bind_group);
    }

    /// Uploads this frame's settings.
    pub fn prepare(&mut self, queue: &wgpu::Queue, settings: &CompositeSettings) {
        let encode = settings.tone_map && !self.format.is_srgb();
        let uniform = composite::CompositeSettings {
            background_top: settings.background[0],
            background_bottom: settings.background[1],
            exposure: settings.exposure,
            tone_map: u32::from(settings.tone_map),
            encode_srgb: u32::from(encode),
            ..bytemuck::Zeroable::zeroed()
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
    }

    /// Records the pass into `output`, which has the inputs' size and the format given to [`new`](Self::new).
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, output: &wgpu::TextureView) {
        let Some(bind_group) = &self.bind_group else { return };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("CompositePass"),
            color_attachments: &[super::cleared(output, wgpu::Color::BLACK)],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, bind_group, &[]);
        pass.draw(0..3, 0..1);
    }
}
