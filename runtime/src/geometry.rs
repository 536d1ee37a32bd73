//! Meshes and their surfaces on the device.

use wgpu::util::DeviceExt as _;

use crate::Vertex;
use crate::bindings::kernel::{BindGroup3, GBufferObject};
use crate::error::TexelsError;
use crate::target::{Extent, Target};

/// Vertices and indices of one mesh.
#[derive(Clone, Debug)]
pub struct Geometry {
    pub(crate) vertices: wgpu::Buffer,
    pub(crate) indices: wgpu::Buffer,
    pub(crate) index_count: u32,
}

impl Geometry {
    /// Uploads a list of triangles in world space; front faces wind anticlockwise.
    ///
    /// No triangle is no error: such a mesh draws nothing.
    pub fn new(device: &wgpu::Device, vertices: &[Vertex], indices: &[u32]) -> Self {
        let buffer = |label, contents: &[u8], usage| {
            // A buffer of 0 bytes cannot be bound.
            let padded;
            let contents = if contents.is_empty() {
                padded = [0; 4];
                &padded[..]
            } else {
                contents
            };
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents,
                usage,
            })
        };
        Self {
            vertices: buffer("Geometry vertices", bytemuck::cast_slice(vertices), wgpu::BufferUsages::VERTEX),
            indices: buffer("Geometry indices", bytemuck::cast_slice(indices), wgpu::BufferUsages::INDEX),
            index_count: u32::try_from(indices.len()).unwrap_or(u32::MAX),
        }
    }
}

/// Pixels of a texture, 8 bits each of red, green, blue and alpha, row by row from the top.
#[derive(Clone, Copy, Debug)]
pub struct TexturePixels<'a> {
    /// Width in pixels, ≥ 1.
    pub width: u32,
    /// Height in pixels, ≥ 1.
    pub height: u32,
    /// `4 · width · height` bytes.
    pub rgba: &'a [u8],
}

impl TexturePixels<'_> {
    fn upload(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        format: wgpu::TextureFormat,
        label: &str,
    ) -> Result<Target, TexelsError> {
        Target::from_texels(device, queue, Extent::new(self.width, self.height), format, label, self.rgba)
    }
}

/// The surface of one object.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceDescriptor<'a> {
    /// Number of the material in the kernel; `None` for an opaque object.
    pub material: Option<u32>,
    /// Surface albedo (sRGB) that overrides the material's per pixel.
    pub surface_albedo: Option<TexturePixels<'a>>,
    /// Factor on that texture, or the surface albedo itself without one; linear red, green, blue. Without a texture, 1 in
    /// all three leaves a material's own surface albedo.
    pub surface_albedo_factor: [f32; 3],
    /// Tangent-space normals (linear, y up as glTF has it).
    pub normals: Option<TexturePixels<'a>>,
    /// Scale of the normals' x and y.
    pub normal_scale: f32,
    /// Specular reflectance at normal incidence where there is no material, 0 to 1.
    pub opaque_reflectance_at_normal: f32,
    /// Roughness where there is no material, 0 to 1.
    pub opaque_roughness: f32,
}

impl Default for SurfaceDescriptor<'_> {
    fn default() -> Self {
        Self {
            material: None,
            surface_albedo: None,
            surface_albedo_factor: [1.0; 3],
            normals: None,
            normal_scale: 1.0,
            // Plaster: a dielectric of n = 1.5, rather rough.
            opaque_reflectance_at_normal: 0.04,
            opaque_roughness: 0.6,
        }
    }
}

/// A mesh with its surface, ready to draw.
#[derive(Clone, Debug)]
pub struct Object {
    pub(crate) geometry: Geometry,
    pub(crate) bind_group: wgpu::BindGroup,
    pub(crate) translucent: bool,
}

impl Object {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        layout: &wgpu::BindGroupLayout,
        geometry: Geometry,
        surface: &SurfaceDescriptor<'_>,
    ) -> Result<Self, TexelsError> {
        let white = TexturePixels { width: 1, height: 1, rgba: &[255; 4] };
        let flat = TexturePixels { width: 1, height: 1, rgba: &[128, 128, 255, 255] };
        let colour = surface.surface_albedo.unwrap_or(white);
        let colour =
            colour.upload(device, queue, wgpu::TextureFormat::Rgba8UnormSrgb, "Object surface albedo")?;
        let normals = surface.normals.unwrap_or(flat);
        let normals = normals.upload(device, queue, wgpu::TextureFormat::Rgba8Unorm, "Object normals")?;
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("Object sampler"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let overrides = surface.surface_albedo.is_some() || surface.surface_albedo_factor != [1.0; 3];
        let uniform = GBufferObject {
            surface_albedo_factor: surface.surface_albedo_factor,
            material: surface.material.and_then(|number| i32::try_from(number).ok()).unwrap_or(-1),
            normal_scale: if surface.normals.is_some() { surface.normal_scale } else { 0.0 },
            surface_albedo_override: if overrides { 1.0 } else { 0.0 },
            opaque_reflectance_at_normal: surface.opaque_reflectance_at_normal,
            opaque_roughness: surface.opaque_roughness,
        };
        let uniform = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("Object uniform"),
            contents: bytemuck::bytes_of(&uniform),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let bind_group = BindGroup3 {
            object: uniform.as_entire_buffer_binding(),
            surface_albedo_texture: &colour.view,
            normal_texture: &normals.view,
            surface_sampler: &sampler,
        }
        .create(device, layout, "Object bind group");
        Ok(Self { geometry, bind_group, translucent: surface.material.is_some() })
    }
}
