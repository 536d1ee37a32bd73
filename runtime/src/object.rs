//! What is drawn: a mesh with its surface, somewhere in the world.

use std::mem::offset_of;

use glam::{Mat3, Mat4, Vec3};

use crate::bindings::clear;
use crate::bindings::kernel::{BindGroup3, GBufferObject, ObjectTransform};
use crate::bindings::shadow;
use crate::clear_material::ClearMaterial;
use crate::extent::Extent;
use crate::geometry::Geometry;
use crate::mips::Encoding;
use crate::target::{Target, TexelsError};
use crate::wgpu::{self, util::DeviceExt as _};

/// Both passes that draw objects read the transform from one buffer.
const _: () = assert!(size_of::<ObjectTransform>() == size_of::<shadow::ObjectTransform>());

/// What a move changes: the transform, and behind it the curvature.
const PLACED_BYTES: usize = size_of::<ObjectTransform>() + size_of::<f32>();
const _: () = assert!(
    offset_of!(GBufferObject, mean_curvature)
        == offset_of!(GBufferObject, transform) + size_of::<ObjectTransform>()
);

/// Pixels of a texture, 8 bits each of red, green, blue and alpha, row by row from the top. Smaller levels, for surfaces
/// far away, are made of them.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct TexturePixels<'a> {
    /// Width in pixels, ≥ 1.
    pub width: u32,
    /// Height in pixels, ≥ 1.
    pub height: u32,
    /// `4 · width · height` bytes.
    pub rgba: &'a [u8],
}

impl<'a> TexturePixels<'a> {
    /// `width`×`height` pixels in `rgba`, four bytes each.
    pub const fn new(width: u32, height: u32, rgba: &'a [u8]) -> Self {
        Self { width, height, rgba }
    }

    fn upload(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoding: Encoding,
        label: &str,
    ) -> Result<Target, TexelsError> {
        Target::with_levels(device, queue, Extent::new(self.width, self.height), encoding, label, self.rgba)
    }
}

/// The surface of one object.
///
/// ```
/// use subsurface_runtime::SurfaceDescriptor;
///
/// let plaster = SurfaceDescriptor::default();
/// assert_eq!((plaster.material, plaster.opaque_roughness), (None, 0.6));
/// let skin = SurfaceDescriptor { material: Some(0), ..Default::default() };
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SurfaceDescriptor<'a> {
    /// Number of the material in the kernel; `None`, the default, for an opaque object.
    pub material: Option<u32>,
    /// Surface albedo (sRGB) that overrides the material's per pixel; by default none.
    pub surface_albedo: Option<TexturePixels<'a>>,
    /// Factor on that texture, or the surface albedo itself without one; linear red, green, blue. Without a texture, 1 in
    /// all three, the default, leaves a material's own surface albedo.
    pub surface_albedo_factor: [f32; 3],
    /// Tangent-space normals (linear, y up as glTF has it); by default none.
    pub normals: Option<TexturePixels<'a>>,
    /// Scale of the normals' x and y; by default 1.
    pub normal_scale: f32,
    /// Roughness in the green channel (linear, as glTF's metallic-roughness texture has it), in place of the material's; by
    /// default none.
    pub roughness: Option<TexturePixels<'a>>,
    /// Factor on that texture, 0 to 1; by default 1.
    pub roughness_factor: f32,
    /// Strength of the specular reflection in the alpha channel (linear, as in glTF's `KHR_materials_specular`): a factor on
    /// the reflectance at normal incidence; by default none.
    pub specular_strength: Option<TexturePixels<'a>>,
    /// Factor on that strength, with a texture or without; by default 1.
    pub specular_strength_factor: f32,
    /// Factor on the mean free path in the red channel (linear), for a medium that is denser in some places; by default
    /// none. The renderer takes such objects where its descriptor's `mean_free_path_scale` says so.
    pub mean_free_path_scale: Option<TexturePixels<'a>>,
    /// Factor on that texture, or on the mean free path itself without one; kept within 0.001 and 1000, by default 1.
    pub mean_free_path_scale_factor: f32,
    /// Thickness in the green channel (linear, as in glTF's `KHR_materials_volume`), as a part of `thickness_mm`; by default
    /// none.
    pub thickness: Option<TexturePixels<'a>>,
    /// Thickness in mm where that texture is 1, or everywhere without one: of a sheet in place of the material's; of what is
    /// thick, for light that no shadow map sees through it, such as light from all around. 0, the default, is none.
    pub thickness_mm: f32,
    /// Specular reflectance at normal incidence where there is no material, 0 to 1; by default 0.04, a dielectric of
    /// refractive index 1.5.
    pub opaque_reflectance_at_normal: f32,
    /// Roughness where there is no material, 0 to 1; by default 0.6, that of plaster.
    pub opaque_roughness: f32,
    /// A material that absorbs light and does not scatter it, in place of `material`; by default none. The renderer draws
    /// such objects where its descriptor's `clear` says so.
    pub clear: Option<ClearMaterial>,
    /// Share of each pixel that a clear object covers, 0 to 1; by default 1.
    pub clear_coverage: f32,
    /// World space from the space of the vertices (columns); by default the identity.
    pub world_from_object: [[f32; 4]; 4],
}

impl Default for SurfaceDescriptor<'_> {
    fn default() -> Self {
        Self {
            material: None,
            surface_albedo: None,
            surface_albedo_factor: [1.0; 3],
            normals: None,
            normal_scale: 1.0,
            roughness: None,
            roughness_factor: 1.0,
            specular_strength: None,
            specular_strength_factor: 1.0,
            mean_free_path_scale: None,
            mean_free_path_scale_factor: 1.0,
            thickness: None,
            thickness_mm: 0.0,
            opaque_reflectance_at_normal: 0.04,
            opaque_roughness: 0.6,
            clear: None,
            clear_coverage: 1.0,
            world_from_object: Mat4::IDENTITY.to_cols_array_2d(),
        }
    }
}

/// A mesh with its surface, ready to draw.
///
/// ```no_run
/// # use subsurface_runtime::{Geometry, Object, SurfaceDescriptor, wgpu};
/// # fn place(device: &wgpu::Device, queue: &wgpu::Queue, geometry: Geometry) -> Result<(), Box<dyn std::error::Error>> {
/// let surface = SurfaceDescriptor { material: Some(0), ..Default::default() };
/// let object = Object::new(device, queue, geometry, &surface)?;
/// // A step to the right: one write of 116 bytes, and nothing else.
/// object.set_transform(
///     queue,
///     [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.1, 0.0, 0.0, 1.0]],
/// );
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Object {
    pub(crate) geometry: Geometry,
    pub(crate) surface_group: wgpu::BindGroup,
    pub(crate) shadow_group: wgpu::BindGroup,
    /// Where it is clear.
    pub(crate) clear_group: Option<wgpu::BindGroup>,
    clear_uniform: Option<wgpu::Buffer>,
    uniform: wgpu::Buffer,
    material: Option<u32>,
    has_details: bool,
    scales_mean_free_path: bool,
}

impl Object {
    /// Uploads the surface of `geometry`.
    ///
    /// # Errors
    /// Textures whose bytes do not fit their size, or whose size is beyond the device's limit.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        geometry: Geometry,
        surface: &SurfaceDescriptor<'_>,
    ) -> Result<Self, TexelsError> {
        let white = TexturePixels::new(1, 1, &[255; 4]);
        let flat = TexturePixels::new(1, 1, &[128, 128, 255, 255]);
        let upload = |given: Option<TexturePixels<'_>>, otherwise: TexturePixels<'_>, encoding, label| {
            given.unwrap_or(otherwise).upload(device, queue, encoding, label)
        };
        let linear = Encoding::Linear;
        let colour = upload(surface.surface_albedo, white, Encoding::Srgb, "Object surface albedo")?;
        let normals = upload(surface.normals, flat, linear, "Object normals")?;
        let roughness = upload(surface.roughness, white, linear, "Object roughness")?;
        let strength = upload(surface.specular_strength, white, linear, "Object specular strength")?;
        let scale = upload(surface.mean_free_path_scale, white, linear, "Object mean free path scale")?;
        let thickness = upload(surface.thickness, white, linear, "Object thickness")?;
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("Object sampler"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let overrides = surface.surface_albedo.is_some() || surface.surface_albedo_factor != [1.0; 3];
        let uniform = GBufferObject {
            transform: transform(surface.world_from_object),
            mean_curvature: mean_curvature(&geometry, surface.world_from_object),
            surface_albedo_factor: surface.surface_albedo_factor,
            material: stored_number(surface.material),
            normal_scale: if surface.normals.is_some() { surface.normal_scale } else { 0.0 },
            surface_albedo_override: if overrides { 1.0 } else { 0.0 },
            opaque_reflectance_at_normal: surface.opaque_reflectance_at_normal,
            opaque_roughness: surface.opaque_roughness,
            roughness_factor: if surface.roughness.is_some() {
                surface.roughness_factor.max(0.0)
            } else {
                -1.0
            },
            specular_strength_factor: surface.specular_strength_factor.max(0.0),
            mean_free_path_scale: surface.mean_free_path_scale_factor,
            thickness_mm: surface.thickness_mm.max(0.0),
            padding_116: [0; 12],
        };
        let uniform = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("Object uniform"),
            contents: bytemuck::bytes_of(&uniform),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        });
        // Equal layouts are one to wgpu: the passes' pipelines take these groups.
        let surface_group = BindGroup3 {
            object: uniform.as_entire_buffer_binding(),
            surface_albedo_texture: &colour.view,
            normal_texture: &normals.view,
            surface_sampler: &sampler,
            roughness_texture: &roughness.view,
            specular_strength_texture: &strength.view,
            object_scale_texture: &scale.view,
            thickness_texture: &thickness.view,
        }
        .create(
            device,
            &BindGroup3::layout(device, "Object surface layout"),
            "Object surface bind group",
        );
        let shadow_group = shadow::BindGroup1 {
            object_transform: wgpu::BufferBinding {
                buffer: &uniform,
                offset: offset_of!(GBufferObject, transform) as u64,
                size: wgpu::BufferSize::new(size_of::<ObjectTransform>() as u64),
            },
        }
        .create(
            device,
            &shadow::BindGroup1::layout(device, "Object shadow layout"),
            "Object shadow bind group",
        );
        let scales_mean_free_path =
            surface.mean_free_path_scale.is_some() || surface.mean_free_path_scale_factor != 1.0;
        let has_details = scales_mean_free_path
            || surface.roughness.is_some()
            || surface.specular_strength.is_some()
            || surface.specular_strength_factor != 1.0
            || surface.thickness_mm > 0.0;
        let material = surface.material.filter(|_| surface.clear.is_none());
        let clear_uniform = surface.clear.map(|clear| {
            // One type by two names: each module has its own.
            let transform = bytemuck::cast(transform(surface.world_from_object));
            let own = clear.uniform(transform, surface.clear_coverage);
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("Object clear uniform"),
                contents: bytemuck::bytes_of(&own),
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            })
        });
        let clear_group = clear_uniform.as_ref().map(|uniform| {
            let layout = clear::BindGroup1::layout(device, "Object clear layout");
            let group = clear::BindGroup1 { clear_object: uniform.as_entire_buffer_binding() };
            group.create(device, &layout, "Object clear bind group")
        });
        Ok(Self {
            geometry,
            surface_group,
            shadow_group,
            clear_group,
            clear_uniform,
            uniform,
            material,
            has_details,
            scales_mean_free_path,
        })
    }

    /// Whether it is drawn over the picture of the others.
    pub(crate) fn is_clear(&self) -> bool {
        self.clear_group.is_some()
    }

    /// Whether the mean free path is not its material's own everywhere.
    pub(crate) fn scales_mean_free_path(&self) -> bool {
        self.scales_mean_free_path && self.is_translucent()
    }

    /// Whether its shading reads more textures than that of most.
    pub(crate) fn has_details(&self) -> bool {
        self.has_details
    }

    /// Places the object: world space from the space of its vertices (columns). Uploads that alone; frames that are
    /// submitted from now on show it.
    ///
    /// Any affine matrix does, mirrors and uneven scales included. A scale does not change the material: its mean free
    /// path stays in millimetres.
    pub fn set_transform(&self, queue: &wgpu::Queue, world_from_object: [[f32; 4]; 4]) {
        let offset = offset_of!(GBufferObject, transform) as u64;
        let transform = transform(world_from_object);
        let mut placed = [0; PLACED_BYTES];
        placed[..size_of::<ObjectTransform>()].copy_from_slice(bytemuck::bytes_of(&transform));
        let curvature = mean_curvature(&self.geometry, world_from_object);
        placed[size_of::<ObjectTransform>()..].copy_from_slice(&curvature.to_ne_bytes());
        queue.write_buffer(&self.uniform, offset, &placed);
        if let Some(uniform) = &self.clear_uniform {
            let offset = offset_of!(clear::ClearObject, transform) as u64;
            queue.write_buffer(uniform, offset, bytemuck::bytes_of(&transform));
        }
    }

    /// Gives the object another material, or none: its number in the kernel, which
    /// [`LoadedKernel::material_number`](crate::LoadedKernel::material_number) knows by name.
    pub fn set_material(&mut self, queue: &wgpu::Queue, material: Option<u32>) {
        let offset = offset_of!(GBufferObject, material) as u64;
        queue.write_buffer(&self.uniform, offset, bytemuck::bytes_of(&stored_number(material)));
        self.material = material;
    }

    /// Number of its material in the kernel; `None` for an opaque object.
    pub fn material(&self) -> Option<u32> {
        self.material
    }

    pub(crate) fn is_translucent(&self) -> bool {
        self.material.is_some()
    }
}

/// Mean curvature of a mesh in the world: a scale makes it flatter.
fn mean_curvature(geometry: &Geometry, world_from_object: [[f32; 4]; 4]) -> f32 {
    let scale = Mat4::from_cols_array_2d(&world_from_object).determinant().abs().cbrt();
    // What a transform flattens has no inside.
    if scale > 0.0 { geometry.mean_curvature() / scale } else { 0.0 }
}

/// The material as the shader takes it: −1 for none.
fn stored_number(material: Option<u32>) -> i32 {
    material.and_then(|number| i32::try_from(number).ok()).unwrap_or(-1)
}

fn transform(world_from_object: [[f32; 4]; 4]) -> ObjectTransform {
    let [x, y, z] =
        Mat3::from_mat4(Mat4::from_cols_array_2d(&world_from_object)).to_cols_array_2d().map(Vec3::from);
    // Mirrors turn the winding of faces round, and the cofactors' sign with it: the shader, which turns normals towards
    // the viewer by the winding, sees the right ones.
    let world_from_object_normal =
        [y.cross(z), z.cross(x), x.cross(y)].map(|column| column.extend(0.0).to_array());
    ObjectTransform { world_from_object, world_from_object_normal }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Quat;

    #[test]
    fn nothing_moves_at_the_identity() {
        let ObjectTransform { world_from_object_normal: [x, y, z], .. } =
            transform(Mat4::IDENTITY.to_cols_array_2d());
        assert_eq!([x, y, z], [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);
    }

    #[test]
    fn normals_stay_perpendicular_and_outside() {
        let turn = Quat::from_axis_angle(Vec3::new(0.3, -0.5, 0.8).normalize(), 1.1);
        for scale in [Vec3::new(2.0, 0.5, 3.0), Vec3::new(-1.0, 2.0, 0.7), Vec3::new(1.0, 1.0, 0.0)] {
            let matrix = Mat4::from_scale_rotation_translation(scale, turn, Vec3::new(1.0, 2.0, 3.0));
            let of = transform(matrix.to_cols_array_2d());
            let normals =
                Mat3::from_cols_array_2d(&of.world_from_object_normal.map(|[x, y, z, _]| [x, y, z]));
            // A face of the first two of these directions, whose normal is the third.
            let (along, across) = (Vec3::new(0.6, 0.0, 0.8), Vec3::Y);
            let normal = normals * along.cross(across);
            let edges = [along, across].map(|edge| matrix.transform_vector3(edge));
            let largest = normal.length() * edges[0].length().max(edges[1].length());
            for edge in edges {
                // Rounding of f32 in products of a few terms.
                assert!(normal.dot(edge).abs() <= 1e-6 * largest.max(1e-3), "{scale}: {normal} on {edge}");
            }
            // As the winding of the moved face says, mirrored or not.
            assert!(normal.dot(edges[0].cross(edges[1])) >= 0.0, "{scale}");
        }
    }
}
