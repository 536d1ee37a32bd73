//! What is drawn: plain data in world space, metres, without a trace of the GPU.

pub mod bust;
pub mod camera;
pub mod environment;
pub mod gltf;
pub mod light;
pub mod light_warning;
pub mod shapes;
pub mod texture_orientation;
mod texture_seam;

use subsurface_runtime::ClearMaterial;

use crate::picture::linear_from_srgb;

/// Scenes are in metres, materials in millimetres.
pub const MILLIMETRES_PER_METRE: f32 = 1000.0;

/// Everything to draw.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The objects, in the order of the file they came from.
    pub objects: Vec<Object>,
    /// The box about all vertices.
    pub bounds: Bounds,
}

impl Scene {
    /// A scene of these objects; measures its bounds.
    pub fn new(objects: Vec<Object>) -> Self {
        let mut bounds = Bounds::default();
        for position in objects.iter().flat_map(|object| &object.mesh.positions) {
            bounds.include(*position);
        }
        Self { objects, bounds }
    }

    /// Turns texture coordinates with (0, 0) at the lower left, as some converters write them, into glTF's.
    pub fn flip_texture_v(&mut self) {
        self.objects.iter_mut().for_each(|object| object.mesh.flip_texture_v());
    }

    /// How many triangles all objects have together.
    pub fn triangle_count(&self) -> usize {
        self.objects.iter().map(|object| object.mesh.indices.len() / 3).sum()
    }
}

/// An axis-aligned box in world space, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates (m).
    pub minimum: [f32; 3],
    /// The corner with the largest coordinates (m).
    pub maximum: [f32; 3],
}

impl Default for Bounds {
    /// The empty box: it holds no point, and including a point makes it that point.
    fn default() -> Self {
        Self { minimum: [f32::INFINITY; 3], maximum: [f32::NEG_INFINITY; 3] }
    }
}

impl Bounds {
    /// Grows the box to hold `position` (m).
    pub fn include(&mut self, position: [f32; 3]) {
        self.minimum = std::array::from_fn(|axis| self.minimum[axis].min(position[axis]));
        self.maximum = std::array::from_fn(|axis| self.maximum[axis].max(position[axis]));
    }

    /// Middle of the box (m).
    pub fn centre(&self) -> [f32; 3] {
        std::array::from_fn(|axis| 0.5 * (self.minimum[axis] + self.maximum[axis]))
    }

    /// Edge lengths of the box (m).
    pub fn size(&self) -> [f32; 3] {
        std::array::from_fn(|axis| self.maximum[axis] - self.minimum[axis])
    }

    /// Radius of the ball about the box (m).
    pub fn radius(&self) -> f32 {
        0.5 * glam::Vec3::from(self.size()).length()
    }
}

/// One mesh with one surface.
#[derive(Clone, Debug, Default)]
pub struct Object {
    /// Name in its file, or a description; for messages and labels.
    pub name: String,
    /// The triangles.
    pub mesh: Mesh,
    /// What is on them.
    pub surface: Surface,
}

/// Triangles in world space.
///
/// The three vertex lists are equally long; seen from outside, a triangle's corners run counter-clockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions (m).
    pub positions: Vec<[f32; 3]>,
    /// Unit normals, outwards.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates, (0, 0) at the upper left of the image; all zero where the file has none.
    pub texture_coordinates: Vec<[f32; 2]>,
    /// Three indices into the lists per triangle.
    pub indices: Vec<u32>,
}

impl Mesh {
    /// Turns texture coordinates with (0, 0) at the lower left into glTF's, or back.
    pub fn flip_texture_v(&mut self) {
        self.texture_coordinates.iter_mut().for_each(|[_, v]| *v = 1.0 - *v);
    }
}

/// Colours and relief of a surface; how it scatters is the material's business.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Linear RGBA factor on the base colour, each in [0, 1].
    pub base_colour_factor: [f32; 4],
    /// Base colour image, sRGB.
    pub base_colour: Option<Image>,
    /// Tangent-space normal map, linear; x to increasing u, y to decreasing v (glTF's convention).
    pub normal_map: Option<Image>,
    /// Factor on the normal map's x and y.
    pub normal_scale: f32,
    /// Roughness in the green channel, linear.
    pub roughness: Option<Image>,
    /// Factor on it.
    pub roughness_factor: f32,
    /// Strength of the specular reflection in the alpha channel, linear.
    pub specular_strength: Option<Image>,
    /// Factor on it, with an image or without.
    pub specular_strength_factor: f32,
    /// Factor on the mean free path in the red channel, linear.
    pub mean_free_path_scale: Option<Image>,
    /// Factor on it, or on the mean free path without an image.
    pub mean_free_path_scale_factor: f32,
    /// Thickness in the green channel, linear, in parts of the next.
    pub thickness: Option<Image>,
    /// Thickness (mm) where the image is 1, or everywhere without one; 0 where the surface says none.
    pub thickness_mm: f32,
    /// Name of the material in the file.
    pub material_name: Option<String>,
    /// Absorbs light, and does not scatter it; in place of a material of the set.
    pub clear: Option<ClearMaterial>,
    /// Share of each pixel that it covers where it is clear, in [0, 1].
    pub clear_coverage: f32,
    /// Sends nothing back and lets nothing through: it only casts shadows.
    pub is_black: bool,
}

impl Default for Surface {
    fn default() -> Self {
        Self {
            base_colour_factor: [1.0; 4],
            base_colour: None,
            normal_map: None,
            normal_scale: 1.0,
            roughness: None,
            roughness_factor: 1.0,
            specular_strength: None,
            specular_strength_factor: 1.0,
            mean_free_path_scale: None,
            mean_free_path_scale_factor: 1.0,
            thickness: None,
            thickness_mm: 0.0,
            material_name: None,
            clear: None,
            clear_coverage: 1.0,
            is_black: false,
        }
    }
}

/// An RGBA8 image; whether its numbers are sRGB or linear is said where it is used.
#[derive(Clone, PartialEq, Eq)]
pub struct Image {
    /// Width in pixels, > 0.
    pub width: u32,
    /// Height in pixels, > 0.
    pub height: u32,
    /// Rows from the top, four bytes per pixel.
    pub rgba: Vec<u8>,
}

impl Image {
    /// Decodes a file's bytes; the format is told by the content, since names and MIME types are often wrong.
    pub fn decoded(bytes: &[u8]) -> Result<Self, image::ImageError> {
        let image = image::load_from_memory(bytes)?.into_rgba8();
        Ok(Self { width: image.width(), height: image.height(), rgba: image.into_raw() })
    }

    /// Mean of red, green and blue in linear light, of an image whose numbers are sRGB.
    pub fn mean_linear(&self) -> [f64; 3] {
        let mut counts = [[0u64; 256]; 3];
        for texel in self.rgba.chunks_exact(4) {
            for (channel, counts) in counts.iter_mut().enumerate() {
                counts[usize::from(texel[channel])] += 1;
            }
        }
        let texels = (self.rgba.len() / 4).max(1) as f64;
        counts.map(|counts| {
            let light = |(code, count): (usize, u64)| f64::from(linear_from_srgb(code as u8)) * count as f64;
            counts.into_iter().enumerate().map(light).sum::<f64>() / texels
        })
    }

    /// Mean of a channel, in [0, 1], of an image whose numbers are linear.
    pub fn mean_linear_code(&self, channel: usize) -> f64 {
        let texels = self.rgba.chunks_exact(4);
        let count = texels.len().max(1) as f64;
        texels.map(|texel| f64::from(texel[channel]) / 255.0).sum::<f64>() / count
    }
}

impl std::fmt::Debug for Image {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Image({}x{})", self.width, self.height)
    }
}
