//! One material in front of a camera, and what the middle of the frame shows of it.

#![allow(unreachable_pub, reason = "a test binary's own")]

use std::f64::consts::PI;

use subsurface_runtime::{
    Bounds, Camera, CompositeSettings, DirectionalLight, Extent, Frame, Geometry, Light, LoadedKernel,
    Object, Renderer, RendererDescriptor, SurfaceDescriptor, Target, Vertex, wgpu,
};

use crate::gpu::{Gpu, compile};

/// Odd: a pixel is in the very middle.
pub const SIZE: Extent = Extent::new(33, 33);
pub const MIDDLE: usize = (SIZE.height / 2 * SIZE.width + SIZE.width / 2) as usize;

pub const SURFACE_ALBEDO: [f64; 3] = [0.83, 0.64, 0.55];
pub const MEAN_FREE_PATH_MM: [f64; 3] = [1.3, 0.95, 0.67];
pub const REFLECTANCE_AT_NORMAL: f64 = 0.028;

/// Skin without angles of its own, under a mirror's reflectance, with fields of a caller's.
pub fn skin(fields: &str) -> String {
    medium(&format!("specular: (coupling: Entry), diffuse: Lambert, {fields}"))
}

/// Skin with fields of a caller's.
pub fn medium(fields: &str) -> String {
    let [[ar, ag, ab], [lr, lg, lb]] = [SURFACE_ALBEDO, MEAN_FREE_PATH_MM];
    format!(
        "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: ({lr:?}, {lg:?}, {lb:?}), \
         surface_albedo: ({ar:?}, {ag:?}, {ab:?}), {fields})"
    )
}

/// A mesh, in metres.
pub type Mesh = (Vec<Vertex>, Vec<u32>);

/// A box around the origin from corner to corner, facing outwards.
pub fn block(half: [f32; 3]) -> Mesh {
    let (mut vertices, mut indices) = (Vec::new(), Vec::new());
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let mut normal = [0.0; 3];
            normal[axis] = side;
            let first = vertices.len() as u32;
            for (u, v) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                let mut position = [0.0; 3];
                position[axis] = side * half[axis];
                position[(axis + 1) % 3] = u * half[(axis + 1) % 3];
                position[(axis + 2) % 3] = side * v * half[(axis + 2) % 3];
                vertices.push(Vertex { position, normal, texture_coordinate: [0.0; 2] });
            }
            indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
        }
    }
    (vertices, indices)
}

/// A square that faces +z.
pub fn quad() -> Mesh {
    tilted(1.0)
}

/// A square whose normal has this cosine to +z.
pub fn tilted(cosine: f64) -> Mesh {
    let [sin, cos] = [(1.0 - cosine * cosine).sqrt() as f32, cosine as f32];
    let corner = |x: f32, y: f32| Vertex {
        position: [0.05 * x * cos, 0.05 * y, -0.05 * x * sin],
        normal: [sin, 0.0, cos],
        // Many times over: a pixel holds many texels.
        texture_coordinate: [40.0 * x, 40.0 * y],
    };
    (vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)], vec![0, 1, 2, 0, 2, 3])
}

/// A sphere around the origin.
pub fn sphere(radius: f32) -> Mesh {
    const RINGS: u32 = 96;
    const SECTORS: u32 = 192;
    let vertices = (0..=RINGS).flat_map(|ring| {
        (0..=SECTORS).map(move |sector| {
            let theta = ring as f32 / RINGS as f32 * std::f32::consts::PI;
            let phi = sector as f32 / SECTORS as f32 * std::f32::consts::TAU;
            let normal = [theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()];
            Vertex { position: normal.map(|x| radius * x), normal, texture_coordinate: [0.0; 2] }
        })
    });
    let quads = (0..RINGS).flat_map(|ring| (0..SECTORS).map(move |sector| ring * (SECTORS + 1) + sector));
    let indices = quads.flat_map(|a| [a, a + SECTORS + 1, a + 1, a + 1, a + SECTORS + 1, a + SECTORS + 2]);
    (vertices.collect(), indices.collect())
}

/// One material in front of a camera, with other meshes beside it.
pub struct Scene<'a> {
    pub gpu: &'a Gpu,
    pub kernel: LoadedKernel,
    pub renderer: Renderer,
    pub objects: Vec<Object>,
    /// Of the subsurface pass; by default it does nothing.
    pub taps: Option<u32>,
    /// Radiance where nothing is.
    pub background: f32,
}

/// A texel of the targets: red, green, blue and alpha.
pub type Texel = [f64; 4];

impl<'a> Scene<'a> {
    pub fn new(gpu: &'a Gpu, material: &str, meshes: &[Mesh]) -> Self {
        Self::of(gpu, &[("skin.ron", material)], meshes)
    }

    /// The material `skin` of a set of files.
    pub fn of(gpu: &'a Gpu, files: &[(&str, &str)], meshes: &[Mesh]) -> Self {
        Self::with(gpu, files, meshes, false)
    }

    /// The same, of which objects may be clear.
    pub fn with(gpu: &'a Gpu, files: &[(&str, &str)], meshes: &[Mesh], clear: bool) -> Self {
        let kernel = gpu.load(&compile(files).parts);
        let descriptor = RendererDescriptor {
            format: wgpu::TextureFormat::Rgba32Float,
            mean_free_path_scale: true,
            clear,
            ..Default::default()
        };
        let mut renderer =
            Renderer::new(&gpu.device, &kernel, &descriptor).expect("the kernel has a G-buffer");
        renderer.resize(&gpu.device, SIZE).expect("a small frame");
        let mut scene = Self { gpu, kernel, renderer, objects: Vec::new(), taps: Some(0), background: 0.0 };
        scene.objects = meshes.iter().map(|mesh| scene.object(mesh)).collect();
        scene
    }

    pub fn object(&self, mesh: &Mesh) -> Object {
        self.surfaced(mesh, SurfaceDescriptor::default())
    }

    /// A mesh of the material, with a surface of a caller's.
    pub fn surfaced(&self, (vertices, indices): &Mesh, surface: SurfaceDescriptor<'_>) -> Object {
        let geometry = Geometry::new(&self.gpu.device, vertices, indices);
        let surface = SurfaceDescriptor { material: self.kernel.material_number("skin"), ..surface };
        Object::new(&self.gpu.device, &self.gpu.queue, geometry, &surface).expect("four bytes each")
    }

    /// The middle of the frame, seen from +z: irradiance, and what is not scattered.
    pub fn middle(&mut self, towards_light: [f64; 3], bounds: Bounds) -> [Texel; 2] {
        let light = DirectionalLight { direction: towards_light.map(|x| -x as f32), ..Default::default() };
        let [irradiance, unscattered, _] = self.lit(&[light.into()], 0.0, bounds);
        [irradiance, unscattered]
    }

    /// Radiance in the middle that is diffuse, and that is not, under a light of irradiance π or under light of radiance 1
    /// from everywhere.
    pub fn radiance(&mut self, towards_light: Option<[f64; 3]>) -> [[f64; 3]; 2] {
        let light = |towards: [f64; 3]| -> Light {
            DirectionalLight { direction: towards.map(|x| -x as f32), ..Default::default() }.into()
        };
        let lights: Vec<Light> = towards_light.map(light).into_iter().collect();
        let ambient = if lights.is_empty() { PI as f32 } else { 0.0 };
        let [_, unscattered, picture] = self.lit(&lights, ambient, Bounds::new([0.0; 3], 0.1));
        let unscattered = [0, 1, 2].map(|channel: usize| unscattered[channel]);
        [[0, 1, 2].map(|channel: usize| picture[channel] - unscattered[channel]), unscattered]
    }

    /// The middle of the frame, seen from +z: irradiance, what is not scattered, and the picture.
    pub fn lit(&mut self, lights: &[Light], ambient: f32, bounds: Bounds) -> [Texel; 3] {
        let picture = self.picture(lights, ambient, bounds);
        let targets = self.renderer.targets().expect("resized above");
        let [irradiance, unscattered] =
            [&targets.irradiance, &targets.unscattered].map(|target| self.texel(target));
        [irradiance, unscattered, picture[MIDDLE].map(f64::from)]
    }

    /// All of the picture, linear.
    pub fn picture(&mut self, lights: &[Light], ambient: f32, bounds: Bounds) -> Vec<[f32; 4]> {
        let camera = Camera { position: [0.0, 0.0, 0.2], fov_y_radians: 0.05, ..Default::default() };
        let frame = Frame {
            lights,
            ambient_irradiance: [ambient; 3],
            taps: self.taps,
            composite: CompositeSettings {
                tone_map: false,
                background: [[self.background; 3]; 2],
                ..Default::default()
            },
            ..Frame::new(camera, bounds, 1000.0)
        };
        self.renderer.prepare(&self.gpu.queue, &frame).expect("resized above");
        let output =
            Target::new(&self.gpu.device, SIZE, wgpu::TextureFormat::Rgba32Float, "picture").expect("small");
        self.gpu.submit(|encoder| self.renderer.encode(encoder, &self.objects, &output.view));
        bytemuck::pod_collect_to_vec(&self.gpu.read_texture(&output.texture))
    }

    /// The middle of a target.
    pub fn texel(&self, target: &Target) -> Texel {
        let bytes = self.gpu.read_texture(&target.texture);
        let halves: &[[u8; 2]] = bytemuck::cast_slice(&bytes);
        [0, 1, 2, 3].map(|channel: usize| half(halves[4 * MIDDLE + channel]))
    }
}

/// The value of a half float.
pub fn half(bytes: [u8; 2]) -> f64 {
    let bits = u16::from_le_bytes(bytes);
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023) / 1024.0);
    let size = if exponent == 0 {
        fraction * 2.0_f64.powi(-14)
    } else {
        (1.0 + fraction) * 2.0_f64.powi(exponent - 15)
    };
    if bits >> 15 == 0 { size } else { -size }
}

/// The direction of a light that falls on `tilted(view)` at the cosine `light`, from beside.
pub fn beside(view: f64, light: f64) -> [f64; 3] {
    let sin = (1.0 - view * view).sqrt();
    [light * sin, (1.0 - light * light).sqrt(), light * view]
}

pub const COSINES: [f64; 6] = [1.0, 0.8, 0.5, 0.3, 0.15, 0.05];
