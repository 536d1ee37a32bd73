//! The light of the G-buffer on scenes whose light is known.

#![allow(clippy::print_stdout, reason = "measured figures, shown on request")]

mod gpu;

use std::f64::consts::PI;

use gpu::{Gpu, compile};
use subsurface_profile::single_scattering_albedo::{Entry, to_surface_albedo};
use subsurface_profile::{Channel, HalfSpace, Medium, Model, Slab};
use subsurface_runtime::{
    Bounds, Camera, CompositeSettings, DirectionalLight, Extent, Frame, Geometry, Light, LoadedKernel,
    Object, PointLight, Renderer, RendererDescriptor, SurfaceDescriptor, Target, TexturePixels, Vertex, wgpu,
};

/// Odd: a pixel is in the very middle.
const SIZE: Extent = Extent::new(33, 33);
const MIDDLE: usize = (SIZE.height / 2 * SIZE.width + SIZE.width / 2) as usize;

const SURFACE_ALBEDO: [f64; 3] = [0.83, 0.64, 0.55];
const MEAN_FREE_PATH_MM: [f64; 3] = [1.3, 0.95, 0.67];
const REFLECTANCE_AT_NORMAL: f64 = 0.028;

/// Skin without angles of its own, under a mirror's reflectance, with fields of a caller's.
fn skin(fields: &str) -> String {
    medium(&format!("specular: (coupling: Entry), diffuse: Lambert, {fields}"))
}

/// Skin with fields of a caller's.
fn medium(fields: &str) -> String {
    let [[ar, ag, ab], [lr, lg, lb]] = [SURFACE_ALBEDO, MEAN_FREE_PATH_MM];
    format!(
        "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: ({lr:?}, {lg:?}, {lb:?}), \
         surface_albedo: ({ar:?}, {ag:?}, {ab:?}), {fields})"
    )
}

/// A mesh, in metres.
type Mesh = (Vec<Vertex>, Vec<u32>);

/// A box around the origin from corner to corner, facing outwards.
fn block(half: [f32; 3]) -> Mesh {
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
fn quad() -> Mesh {
    tilted(1.0)
}

/// A square whose normal has this cosine to +z.
fn tilted(cosine: f64) -> Mesh {
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
fn sphere(radius: f32) -> Mesh {
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
struct Scene<'a> {
    gpu: &'a Gpu,
    kernel: LoadedKernel,
    renderer: Renderer,
    objects: Vec<Object>,
}

/// A texel of the targets: red, green, blue and alpha.
type Texel = [f64; 4];

impl<'a> Scene<'a> {
    fn new(gpu: &'a Gpu, material: &str, meshes: &[Mesh]) -> Self {
        let kernel = gpu.load(&compile(&[("skin.ron", material)]).parts);
        let descriptor =
            RendererDescriptor { format: wgpu::TextureFormat::Rgba32Float, ..Default::default() };
        let mut renderer =
            Renderer::new(&gpu.device, &kernel, &descriptor).expect("the kernel has a G-buffer");
        renderer.resize(&gpu.device, SIZE).expect("a small frame");
        let mut scene = Self { gpu, kernel, renderer, objects: Vec::new() };
        scene.objects = meshes.iter().map(|mesh| scene.object(mesh)).collect();
        scene
    }

    fn object(&self, (vertices, indices): &Mesh) -> Object {
        let geometry = Geometry::new(&self.gpu.device, vertices, indices);
        let surface =
            SurfaceDescriptor { material: self.kernel.material_number("skin"), ..Default::default() };
        Object::new(&self.gpu.device, &self.gpu.queue, geometry, &surface).expect("no textures")
    }

    /// The middle of the frame, seen from +z: irradiance, and what is not scattered.
    fn middle(&mut self, towards_light: [f64; 3], bounds: Bounds) -> [Texel; 2] {
        let light = DirectionalLight { direction: towards_light.map(|x| -x as f32), ..Default::default() };
        let [irradiance, unscattered, _] = self.lit(&[light.into()], 0.0, bounds);
        [irradiance, unscattered]
    }

    /// Radiance in the middle that is diffuse, and that is not, under a light of irradiance π or under light of radiance 1
    /// from everywhere.
    fn radiance(&mut self, towards_light: Option<[f64; 3]>) -> [[f64; 3]; 2] {
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
    fn lit(&mut self, lights: &[Light], ambient: f32, bounds: Bounds) -> [Texel; 3] {
        let camera = Camera { position: [0.0, 0.0, 0.2], fov_y_radians: 0.05, ..Default::default() };
        let frame = Frame {
            lights,
            ambient_irradiance: [ambient; 3],
            taps: Some(0),
            composite: CompositeSettings { tone_map: false, ..Default::default() },
            ..Frame::new(camera, bounds, 1000.0)
        };
        self.renderer.prepare(&self.gpu.queue, &frame).expect("resized above");
        let output =
            Target::new(&self.gpu.device, SIZE, wgpu::TextureFormat::Rgba32Float, "picture").expect("small");
        self.gpu.submit(|encoder| self.renderer.encode(encoder, &self.objects, &output.view));
        let picture: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&self.gpu.read_texture(&output.texture));
        let targets = self.renderer.targets().expect("resized above");
        let [irradiance, unscattered] =
            [&targets.irradiance, &targets.unscattered].map(|target| self.texel(target));
        [irradiance, unscattered, picture[MIDDLE].map(f64::from)]
    }

    /// The middle of a target.
    fn texel(&self, target: &Target) -> Texel {
        let bytes = self.gpu.read_texture(&target.texture);
        let halves: &[[u8; 2]] = bytemuck::cast_slice(&bytes);
        [0, 1, 2, 3].map(|channel: usize| half(halves[4 * MIDDLE + channel]))
    }
}

/// The value of a half float.
fn half(bytes: [u8; 2]) -> f64 {
    let bits = u16::from_le_bytes(bytes);
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023) / 1024.0);
    let size = if exponent == 0 {
        fraction * 2.0_f64.powi(-14)
    } else {
        (1.0 + fraction) * 2.0_f64.powi(exponent - 15)
    };
    if bits >> 15 == 0 { size } else { -size }
}

/// Share of the light that a surface lets in at a cosine under `coupling: Entry`.
fn entering(cosine: f64) -> f64 {
    1.0 - REFLECTANCE_AT_NORMAL - (1.0 - REFLECTANCE_AT_NORMAL) * (1.0 - cosine).powi(5)
}

fn slabs() -> [Slab; 3] {
    [0, 1, 2].map(|channel: usize| {
        Slab::new(Medium::new(SURFACE_ALBEDO[channel], MEAN_FREE_PATH_MM[channel]).expect("in the domain"))
    })
}

fn slab_law(thickness_mm: f64) -> [f64; 3] {
    slabs().map(|slab| slab.transmittance(thickness_mm))
}

fn slab_reflection(thickness_mm: f64) -> [f64; 3] {
    slabs().map(|slab| slab.reflectance(thickness_mm))
}

fn profile_law(thickness_mm: f64) -> [f64; 3] {
    let model = Model::published("two_exponential_dipole_searchlight").expect("it is published");
    Channel::ALL.map(|channel| {
        let index = channel.index();
        let medium = Medium::new(SURFACE_ALBEDO[index], MEAN_FREE_PATH_MM[index]).expect("in the domain");
        model.profile(medium, channel).expect("in the domain").transmittance(thickness_mm)
    })
}

/// A law of transmittance, and the fields that choose it.
type Law = (&'static str, fn(f64) -> [f64; 3]);

const LAWS: [Law; 2] = [("", slab_law), ("transmittance: Profile", profile_law)];

/// Largest relative difference of what comes through from a law, over the channels that let some through.
fn off(found: Texel, cosine: f64, through: [f64; 3]) -> f64 {
    let expected = through.map(|through| cosine * entering(cosine) * through);
    let differences = expected.iter().zip(found).map(|(expected, found)| {
        // Of what half floats hold, and of what the eye does.
        (found - expected).abs() / expected.max(1e-3)
    });
    differences.fold(0.0, f64::max)
}

#[test]
fn a_slab_lets_through_what_its_law_says_whatever_the_angle_and_the_scene() {
    let gpu = Gpu::open();
    let mut worst = (0.0, String::new());
    for (fields, law) in LAWS {
        for thickness_mm in [0.3, 0.6, 1.0, 2.0, 4.0, 8.0] {
            let slab = block([0.15, 0.15, 0.5e-3 * thickness_mm as f32]);
            let mut scene = Scene::new(&gpu, &skin(fields), &[slab]);
            for radius in [0.22, 0.5, 3.0, 10.0] {
                for degrees in [0.0, 30.0, 45.0, 60.0, 75.0_f64] {
                    // Around the axis as well: no row of the map is along the slope.
                    let (sin, cos) = degrees.to_radians().sin_cos();
                    let towards_light = [0.8 * sin, 0.6 * sin, -cos];
                    let bounds = Bounds::new([0.3 * radius, -0.2 * radius, 0.1 * radius], radius);
                    let [_, found] = scene.middle(towards_light, bounds);
                    let off = off(found, cos, law(thickness_mm));
                    if off > worst.0 {
                        worst = (
                            off,
                            format!("{thickness_mm} mm at {degrees}°, {radius} m, {fields}: {found:?}"),
                        );
                    }
                }
            }
        }
    }
    println!("{:.4}: {}", worst.0, worst.1);
    // Half floats are good to 5e-4; depths of a map of 20 m to a micrometre, which is 0.3 % of the thinnest slab's loss.
    assert!(worst.0 < 0.02, "off by {:.4}: {}", worst.0, worst.1);
}

#[test]
fn a_sphere_lets_through_its_diameter_at_the_antipode() {
    let gpu = Gpu::open();
    for radius_mm in [1.0, 2.0, 4.0] {
        let mut scene = Scene::new(&gpu, &skin(""), &[sphere(1e-3 * radius_mm as f32)]);
        let bounds = Bounds::new([0.0; 3], 0.02);
        let [_, found] = scene.middle([0.0, 0.0, -1.0], bounds);
        let off = off(found, 1.0, slab_law(2.0 * radius_mm));
        println!("{radius_mm} mm: {off:.4}");
        // The mean over a disc of 0.3 mm, beside whose middle a sphere is thinner.
        assert!(off < 0.02, "{radius_mm} mm: {off:.4}");
    }
}

#[test]
fn what_stands_elsewhere_changes_nothing() {
    let gpu = Gpu::open();
    let slab = || block([0.05, 0.05, 1e-3]);
    let towards_light = [0.4, -0.3, -(1.0 - 0.25_f64).sqrt()];
    for (away, radius) in [(0.5, 0.4), (3.0, 1.7), (10.0, 5.2)] {
        let (mut other, indices) = block([0.02; 3]);
        for vertex in &mut other {
            vertex.position[0] += away;
        }
        let mut scene = Scene::new(&gpu, &skin(""), &[slab(), (other, indices)]);
        let [_, found] = scene.middle(towards_light, Bounds::new([0.5 * away, 0.0, 0.0], radius));
        let off = off(found, -towards_light[2], slab_law(2.0));
        assert!(off < 0.02, "another object {away} m away: {off:.4}");
    }
}

#[test]
fn what_stands_before_the_light_darkens() {
    let gpu = Gpu::open();
    let (mut screen, indices) = block([0.05, 0.05, 1e-3]);
    for vertex in &mut screen {
        vertex.position[2] -= 0.05;
    }
    let mut scene = Scene::new(&gpu, &skin(""), &[block([0.05, 0.05, 1e-3]), (screen, indices)]);
    let [_, found] = scene.middle([0.0, 0.0, -1.0], Bounds::new([0.0; 3], 0.2));
    // From the screen's lit face on, all counts as skin: 52 mm.
    let through = slab_law(52.0).map(|through| entering(1.0) * through);
    assert!((found[0] - through[0]).abs() < 1e-4 && found[0] < 5e-3, "{found:?}, {through:?}");
}

#[test]
fn a_sheet_sends_back_and_lets_through_what_a_slab_does() {
    let gpu = Gpu::open();
    const THICKNESS_MM: f64 = 0.25;
    let mut scene = Scene::new(&gpu, &skin(&format!("thin: (thickness_mm: {THICKNESS_MM})")), &[quad()]);
    let bounds = Bounds::new([0.0; 3], 0.1);
    for degrees in [0.0, 40.0, 70.0_f64] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        // As much from behind as through a slab, and nothing enters in front.
        let [irradiance, found] = scene.middle([sin, 0.0, -cos], bounds);
        let through = off(found, cos, slab_law(THICKNESS_MM));
        assert!(through < 2e-3 && irradiance[..3] == [0.0; 3], "{degrees}°: {through}, {irradiance:?}");
        // From in front, as much as a surface lets in; what is sent back of it stands in its surface albedo.
        let [irradiance, _] = scene.middle([sin, 0.0, cos], bounds);
        let entered = irradiance[0] / (PI * cos * entering(cos));
        assert!((entered - 1.0).abs() < 2e-3, "{degrees}°: {irradiance:?}");
        let targets = scene.renderer.targets().expect("resized");
        let sheet = scene.texel(&targets.surface);
        for (channel, sent_back) in slab_reflection(THICKNESS_MM).into_iter().enumerate() {
            assert!((sheet[channel] / sent_back - 1.0).abs() < 2e-3, "{sheet:?}, {sent_back} in {channel}");
        }
        // It has no material whose light diffuses.
        assert_eq!(sheet[3], -1.0);
    }
}

/// The direction of a light that falls on `tilted(view)` at the cosine `light`, from beside.
fn beside(view: f64, light: f64) -> [f64; 3] {
    let sin = (1.0 - view * view).sqrt();
    [light * sin, (1.0 - light * light).sqrt(), light * view]
}

const COSINES: [f64; 6] = [1.0, 0.8, 0.5, 0.3, 0.15, 0.05];

/// Share of the light that the specular lobe sends back, seen at a cosine: ∫ f μ_l dω_l over half vectors whose angle θ
/// to the normal is such that tan θ = α tan ψ with even steps of ψ.
fn specular_albedo(view: f64, roughness: f64, reflectance_at_normal: f64) -> f64 {
    const STEPS: [u32; 2] = [400, 200];
    let (alpha, k) = (roughness * roughness, (roughness + 1.0).powi(2) / 8.0);
    let masked = |cosine: f64| cosine * (1.0 - k) + k;
    let [psi_step, turn_step] = [PI / 2.0 / f64::from(STEPS[0]), PI / f64::from(STEPS[1])];
    let mut sum = 0.0;
    for place in 0..STEPS[0] * STEPS[1] {
        let psi = (f64::from(place / STEPS[1]) + 0.5) * psi_step;
        let turn = (f64::from(place % STEPS[1]) + 0.5) * turn_step;
        let theta = (alpha * psi.tan()).atan();
        let theta_by_psi = alpha / (psi.cos().powi(2) + (alpha * psi.sin()).powi(2));
        let (sin, cos) = theta.sin_cos();
        let view_half = view * cos + (1.0 - view * view).sqrt() * sin * turn.cos();
        let light = 2.0 * view_half * cos - view;
        if light <= 0.0 || view_half <= 0.0 {
            continue;
        }
        let narrowing = cos * cos * (alpha * alpha - 1.0) + 1.0;
        let distribution = alpha * alpha / (PI * narrowing * narrowing);
        let fresnel = reflectance_at_normal + (1.0 - reflectance_at_normal) * (1.0 - view_half).powi(5);
        let brdf = distribution * fresnel / (4.0 * masked(light) * masked(view));
        sum += brdf * light * 4.0 * view_half * sin * theta_by_psi;
    }
    // Both halves of the turn are alike.
    2.0 * sum * psi_step * turn_step
}

#[test]
fn a_white_furnace_is_white_under_two_lobes() {
    let gpu = Gpu::open();
    for (first, second, weight) in [(0.4, 0.2, 0.3), (0.9, 0.1, 0.5), (0.3, 1.0, 1.0)] {
        let white = format!(
            "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.0, 1.0, 1.0), \
             surface_albedo: (1.0, 1.0, 1.0), specular: (roughness: {first:?}, second: (roughness: {second:?}, \
             weight: {weight:?})))"
        );
        for view in COSINES {
            let mut scene = Scene::new(&gpu, &white, &[tilted(view)]);
            let [diffuse, unscattered] = scene.radiance(None);
            for (diffuse, unscattered) in diffuse.into_iter().zip(unscattered) {
                // As for one lobe.
                assert!((diffuse + unscattered - 1.0).abs() < 2e-3, "{view}: {diffuse} + {unscattered}");
            }
        }
    }
}

#[test]
fn a_white_furnace_is_white_at_every_roughness() {
    let gpu = Gpu::open();
    let mut worst = 0.0_f64;
    for (roughness, reflectance) in
        [(0.1, 0.2), (0.17, 0.028), (0.2, 0.028), (0.33, 1.0), (0.4, 0.028), (0.8, 0.028), (1.0, 0.5)]
    {
        let white = format!(
            "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.0, 1.0, 1.0), \
             surface_albedo: (1.0, 1.0, 1.0), specular: (reflectance_at_normal: {reflectance:?}, \
             roughness: {roughness:?}))"
        );
        for view in COSINES {
            let mut scene = Scene::new(&gpu, &white, &[tilted(view)]);
            let reflected = specular_albedo(view, roughness, reflectance);
            let [diffuse, unscattered] = scene.radiance(None);
            for (diffuse, unscattered) in diffuse.into_iter().zip(unscattered) {
                let case =
                    format!("{roughness}, {reflectance} at {view}: {diffuse} + {unscattered}, {reflected}");
                worst = worst.max((diffuse + unscattered - 1.0).abs());
                assert!((diffuse + unscattered - 1.0).abs() < 2e-3, "{case}");
                assert!((unscattered - reflected).abs() < 2e-3, "{case}");
            }
        }
    }
    println!("off by {worst:.1e} at most");
}

#[test]
fn light_that_goes_back_the_way_it_came_is_as_bright() {
    let gpu = Gpu::open();
    for fields in
        ["specular: (reflectance_at_normal: 0)", "diffuse: Lambert", "", "specular: (roughness: 0.9)"]
    {
        let seen = |view: f64, light: f64| {
            let mut scene = Scene::new(&gpu, &medium(fields), &[tilted(view)]);
            let [diffuse, _] = scene.radiance(Some(beside(view, light)));
            diffuse.map(|radiance| radiance / light)
        };
        for (one, other) in [(1.0, 0.5), (0.8, 0.15), (0.3, 0.5), (0.15, 1.0)] {
            for (there, back) in seen(one, other).into_iter().zip(seen(other, one)) {
                // Three half floats on the way: irradiance, the specular share and the angle.
                assert!((there / back - 1.0).abs() < 4e-3, "{fields} {one}, {other}: {there}, {back}");
            }
        }
    }
}

#[test]
fn angles_are_those_of_the_half_space() {
    let gpu = Gpu::open();
    for (stem, entry) in
        [("two_exponential_dipole_searchlight", Entry::Searchlight), ("burley_diffuse", Entry::Diffuse)]
    {
        let [ar, ag, ab] = SURFACE_ALBEDO;
        let text = format!(
            "Material(profile: \"{stem}\", mean_free_path_mm: (1.0, 1.0, 1.0), \
             surface_albedo: ({ar:?}, {ag:?}, {ab:?}), specular: (reflectance_at_normal: 0, coupling: None))"
        );
        let media = SURFACE_ALBEDO.map(|albedo| HalfSpace::of(entry, albedo));
        for view in COSINES {
            let mut scene = Scene::new(&gpu, &text, &[tilted(view)]);
            let check = |radiance: [f64; 3], arriving: &dyn Fn(&HalfSpace) -> f64, what: &str| {
                for (channel, medium) in media.iter().enumerate() {
                    let expected = SURFACE_ALBEDO[channel] * arriving(medium) * medium.exit(view);
                    // Half floats: of light, and of the angle, where the albedo is steep.
                    let off = (radiance[channel] / expected - 1.0).abs();
                    assert!(off < 4e-3, "{stem}, {what}, seen at {view}: {radiance:?}, {expected}");
                }
            };
            check(scene.radiance(None)[0], &HalfSpace::diffuse_entry, "light from everywhere");
            for light in COSINES {
                let [radiance, _] = scene.radiance(Some(beside(view, light)));
                let arriving = |medium: &HalfSpace| light * medium.entry(light) * medium.pairing(light, view);
                check(radiance, &arriving, &format!("a light at {light}"));
            }
        }
    }
}

#[test]
fn a_boundary_makes_angles_alike() {
    let gpu = Gpu::open();
    let index = (1.0 + REFLECTANCE_AT_NORMAL.sqrt()) / (1.0 - REFLECTANCE_AT_NORMAL.sqrt());
    let below = |cosine: f64| (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
    let media = SURFACE_ALBEDO.map(|albedo| HalfSpace::below(Entry::Searchlight, index, albedo));
    // 2 ∫ A(μ′) μ dμ by many steps.
    let mean = |medium: &HalfSpace| {
        let cosines = (0..1000).map(|step| (f64::from(step) + 0.5) / 1000.0);
        cosines.map(|cosine| 2.0 * cosine * medium.entry(below(cosine))).sum::<f64>() / 1000.0
    };
    let shape = |cosine: f64| {
        media.iter().map(|medium| medium.entry(below(cosine)) / mean(medium)).sum::<f64>() / 3.0
    };
    for view in COSINES {
        let fields = format!("specular: (reflectance_at_normal: {REFLECTANCE_AT_NORMAL:?}, coupling: None)");
        let mut scene = Scene::new(&gpu, &medium(&fields), &[tilted(view)]);
        assert!((shape(view) - 1.0).abs() < 0.1, "{} at {view}", shape(view));
        for light in COSINES {
            let [radiance, _] = scene.radiance(Some(beside(view, light)));
            for (channel, medium) in media.iter().enumerate() {
                let entered = light * mean(medium) * shape(light);
                let expected = SURFACE_ALBEDO[channel] * entered * shape(view);
                // Half floats, and the two points of the mean.
                let off = (radiance[channel] / expected - 1.0).abs();
                assert!(off < 5e-3, "a light at {light}, seen at {view}: {radiance:?}, {expected}");
            }
        }
    }
}

#[test]
fn a_texture_far_away_is_its_mean() {
    let gpu = Gpu::open();
    // White and black in turn, in a size that no power of two is.
    const SIDE: u32 = 255;
    let texels: Vec<u8> =
        (0..SIDE * SIDE).flat_map(|at| if at % 2 == 0 { [255; 4] } else { [0, 0, 0, 255] }).collect();
    let mut scene = Scene::new(&gpu, &medium(""), &[]);
    let (vertices, indices) = quad();
    let geometry = Geometry::new(&gpu.device, &vertices, &indices);
    let surface = SurfaceDescriptor {
        material: scene.kernel.material_number("skin"),
        surface_albedo: Some(TexturePixels::new(SIDE, SIDE, &texels)),
        ..Default::default()
    };
    scene.objects = vec![Object::new(&gpu.device, &gpu.queue, geometry, &surface).expect("four bytes each")];
    scene.middle([0.0, 0.0, 1.0], Bounds::new([0.0; 3], 0.1));
    let albedo = scene.texel(&scene.renderer.targets().expect("resized").surface);
    // Half of the light, in codes of eight bits on eight levels.
    assert!(albedo[..3].iter().all(|albedo| (albedo - 0.5).abs() < 0.02), "{albedo:?}");
}

/// The direction of a light behind a slab, at an angle from its normal.
fn behind(degrees: f64) -> [f64; 3] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [sin, 0.0, -cos]
}

#[test]
fn light_that_comes_through_remembers_no_angle_but_how_it_entered_and_leaves() {
    let gpu = Gpu::open();
    let slab = block([0.15, 0.15, 2e-3]);
    let mut scene =
        Scene::new(&gpu, &medium("specular: (reflectance_at_normal: 0, coupling: None)"), &[slab]);
    for degrees in [0.0, 30.0, 60.0, 75.0_f64] {
        let cosine = degrees.to_radians().cos();
        let [_, found] = scene.middle(behind(degrees), Bounds::new([0.0; 3], 0.25));
        for (channel, through) in slab_law(4.0).into_iter().enumerate() {
            let half_space = HalfSpace::of(Entry::Searchlight, SURFACE_ALBEDO[channel]);
            let angles = half_space.through_entry(cosine) * half_space.through_exit(1.0);
            let expected = cosine * through * angles;
            // What the law itself is held to.
            assert!((found[channel] / expected - 1.0).abs() < 0.02, "{degrees}°: {found:?}, {expected}");
        }
    }
}

#[test]
fn diffusing_what_comes_through_changes_nothing_where_all_is_alike() {
    let gpu = Gpu::open();
    for fields in
        ["specular: (reflectance_at_normal: 0)", "", "diffuse: Lambert", "surface_albedo: (0.5, 0.3, 0.0)"]
    {
        let fields = |more: &str| {
            let (own, others) =
                if fields.starts_with("surface_albedo") { (fields, "") } else { ("", fields) };
            let text = medium(&format!("{others}{}{more}", if others.is_empty() { "" } else { ", " }));
            if own.is_empty() { text } else { text.replace("surface_albedo: (0.83, 0.64, 0.55)", own) }
        };
        let picture = |text: &str| {
            let mut scene = Scene::new(&gpu, text, &[block([0.15, 0.15, 2e-3])]);
            let light = DirectionalLight { direction: behind(40.0).map(|x| -x as f32), ..Default::default() };
            let [irradiance, _, picture] = scene.lit(&[light.into()], 0.0, Bounds::new([0.0; 3], 0.25));
            (irradiance[0], picture)
        };
        let (_, direct) = picture(&fields(""));
        let (entered, diffused) = picture(&fields("transmission: (diffused: true)"));
        assert!(entered > 0.01, "nothing went into the irradiance");
        for (channel, (direct, diffused)) in direct.into_iter().zip(diffused).take(3).enumerate() {
            // Half floats on both ways.
            assert!((direct - diffused).abs() < 3e-3 * direct + 1e-4, "{channel}: {direct}, {diffused}");
        }
    }
}

#[test]
fn without_a_boundary_nothing_shines() {
    let gpu = Gpu::open();
    let mut scene =
        Scene::new(&gpu, &medium("specular: (reflectance_at_normal: 0, roughness: 0.3)"), &[tilted(0.2)]);
    for light in [None, Some([0.0, 0.0, 1.0]), Some(beside(0.2, 0.1))] {
        let [_, unscattered] = scene.radiance(light);
        assert_eq!(unscattered, [0.0; 3], "{light:?}");
    }
}

#[test]
fn a_second_lobe_of_no_weight_or_of_the_same_roughness_changes_no_bit() {
    let gpu = Gpu::open();
    let seen = |fields: &str| {
        let mut scene = Scene::new(&gpu, &medium(fields), &[tilted(0.6)]);
        [Some([0.0, 0.0, 1.0]), Some(beside(0.6, 0.7)), None].map(|light| scene.radiance(light))
    };
    let one = seen("specular: (roughness: 0.4)");
    for second in ["roughness: 0.9, weight: 0.0", "roughness: 0.4, weight: 0.7"] {
        assert!(seen(&format!("specular: (roughness: 0.4, second: ({second}))")) == one, "{second}");
    }
    // A mixture lies between its parts, by their weights.
    let [other, both] = ["", ", second: (roughness: 0.9, weight: 0.25)"].map(|second| {
        seen(&format!("specular: (roughness: {}{second})", if second.is_empty() { 0.9 } else { 0.4 }))
    });
    for ((one, other), both) in one.iter().zip(&other).zip(&both) {
        let expected = 0.75 * one[1][0] + 0.25 * other[1][0];
        assert!((both[1][0] - expected).abs() < 1e-3 * expected + 1e-4, "{}: {expected}", both[1][0]);
    }
}

/// Radiance over A of what is diffuse, without a boundary: in light from everywhere alike at a cosine of view, or from a
/// light at another.
fn lobe(gpu: &Gpu, fields: &str, view: f64, light: Option<f64>) -> [f64; 3] {
    let material = medium(&format!("specular: (reflectance_at_normal: 0), {fields}"));
    let mut scene = Scene::new(gpu, &material, &[tilted(view)]);
    let [diffuse, _] = scene.radiance(light.map(|light| beside(view, light)));
    [0, 1, 2].map(|channel: usize| diffuse[channel] / SURFACE_ALBEDO[channel])
}

#[test]
fn lobes_have_the_albedos_of_their_formulas() {
    let gpu = Gpu::open();
    // Oren and Nayar at σ = 0.5, Disney's at roughness 1: integrals by another program.
    for (fields, albedos, tolerance) in [
        ("diffuse: OrenNayar(sigma: 0.5)", [(1.0, 0.785), (0.7, 0.852), (0.3, 0.912)], 0.03),
        ("diffuse: OrenNayar(sigma: 0.0)", [(1.0, 1.0), (0.5, 1.0), (0.1, 1.0)], 2e-3),
        ("diffuse: Coupled", [(1.0, 1.0), (0.5, 1.0), (0.1, 1.0)], 2e-3),
    ] {
        for (view, albedo) in albedos {
            let found = lobe(&gpu, fields, view, None)[0];
            // Twelve directions stand for all.
            assert!((found / albedo - 1.0).abs() < tolerance, "{fields} at {view}: {found}, not {albedo}");
        }
    }
    let disney = |view: f64| {
        let rough = "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1, 1, 1), \
                     surface_albedo: (0.5, 0.5, 0.5), diffuse: Disney(subsurface: 0), \
                     specular: (reflectance_at_normal: 0, roughness: 1.0))";
        let mut scene = Scene::new(&gpu, rough, &[tilted(view)]);
        2.0 * scene.radiance(None)[0][0]
    };
    for (view, albedo) in [(1.0, 1.04), (0.05, 1.46)] {
        assert!((disney(view) / albedo - 1.0).abs() < 0.04, "Disney's at {view}: {}", disney(view));
    }
}

#[test]
fn a_mirror_and_what_it_lets_through_are_all_of_the_light() {
    let gpu = Gpu::open();
    for reflectance in [0.028, 0.2, 0.5_f64] {
        let white = format!(
            "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.0, 1.0, 1.0), \
             surface_albedo: (1.0, 1.0, 1.0), diffuse: Shirley, specular: (reflectance_at_normal: {reflectance:?}))"
        );
        for view in [1.0, 0.7, 0.4, 0.2_f64] {
            let mut scene = Scene::new(&gpu, &white, &[tilted(view)]);
            let mirrored = reflectance + (1.0 - reflectance) * (1.0 - view).powi(5);
            let found = scene.radiance(None)[0][0];
            // Half floats; the sum over directions is exact for fifth powers.
            assert!((found + mirrored - 1.0).abs() < 2e-3, "{reflectance} at {view}: {found} + {mirrored}");
        }
    }
}

#[test]
fn dust_without_opposition_is_the_half_space() {
    let gpu = Gpu::open();
    for (view, light) in [(1.0, 0.8), (0.5, 0.3), (0.3, 0.9), (0.8, 0.15)] {
        let hapke = lobe(&gpu, "diffuse: Hapke(opposition: 0, anisotropy: 0)", view, Some(light));
        let chandrasekhar = lobe(&gpu, "diffuse: Chandrasekhar(entry: Diffuse)", view, Some(light));
        for (hapke, chandrasekhar) in hapke.into_iter().zip(chandrasekhar) {
            // One writes its exit into a half float.
            assert!((hapke / chandrasekhar - 1.0).abs() < 4e-3, "{view}, {light}: {hapke}, {chandrasekhar}");
        }
        // Light that goes back the way it came is brighter by the opposition.
        let surge = lobe(&gpu, "diffuse: Hapke(opposition: 1, opposition_width: 0.1)", view, Some(view));
        let none = lobe(&gpu, "diffuse: Hapke(opposition: 0)", view, Some(view));
        assert!(surge.iter().zip(none).all(|(surge, none)| *surge >= none), "{surge:?}, {none:?}");
    }
}

#[test]
fn every_lobe_is_reciprocal_and_has_its_mean() {
    let gpu = Gpu::open();
    for fields in [
        "diffuse: Shirley",
        "diffuse: LommelSeeliger",
        "diffuse: Hapke(opposition: 0.5, opposition_width: 0.2, anisotropy: -0.3)",
        "diffuse: OrenNayar(sigma: 0.4)",
        "diffuse: Disney(subsurface: 0.4)",
    ] {
        for (one, other) in [(1.0, 0.5), (0.8, 0.15), (0.3, 0.5)] {
            let seen =
                |view: f64, light: f64| lobe(&gpu, fields, view, Some(light)).map(|value| value / light);
            for (there, back) in seen(one, other).into_iter().zip(seen(other, one)) {
                // Half floats.
                assert!((there / back - 1.0).abs() < 4e-3, "{fields} {one}, {other}: {there}, {back}");
            }
        }
    }
    // Light from everywhere returns with A in the mean: 2 ∫ μ over Gauss's points of μ².
    let mean = |fields: &str| {
        let points = [(0.069_43, 0.173_93), (0.330_01, 0.326_07), (0.669_99, 0.326_07), (0.930_57, 0.173_93)];
        points
            .iter()
            .map(|(square, weight): &(f64, f64)| weight * lobe(&gpu, fields, square.sqrt(), None)[1])
            .sum::<f64>()
    };
    for fields in ["diffuse: LommelSeeliger", "diffuse: Hapke(opposition: 0)"] {
        let found = mean(fields);
        // Twelve directions stand for all, and four of view.
        assert!((found - 1.0).abs() < 0.02, "{fields}: {found}");
    }
}

#[test]
fn a_medium_given_by_its_coefficients_lets_through_what_they_say() {
    let gpu = Gpu::open();
    let material = "Material(profile: \"two_exponential_dipole_searchlight\", transmittance: Slab, diffuse: Lambert, \
                    specular: (coupling: None), medium: (reduced_scattering_per_mm: (1.09, 1.59, 1.79), \
                    absorption_per_mm: (0.013, 0.07, 0.145), refractive_index: 1.3))";
    let mut scene = Scene::new(&gpu, material, &[block([0.15, 0.15, 1e-3])]);
    let [_, found] = scene.middle(behind(0.0), Bounds::new([0.0; 3], 0.25));
    for (channel, (scattering, absorption)) in
        [(1.09, 0.013), (1.59, 0.07), (1.79, 0.145_f64)].into_iter().enumerate()
    {
        let (extinction, alpha) = (scattering + absorption, scattering / (scattering + absorption));
        // The slab's law is for a medium without a boundary.
        let matched = to_surface_albedo(Entry::Searchlight, alpha);
        let law =
            Slab::new(Medium::new(matched, 1.0 / extinction).expect("in the domain")).transmittance(2.0);
        assert!((found[channel] / law - 1.0).abs() < 0.02, "{channel}: {found:?}, not {law}");
    }
}

/// What a tilted square shows under a light, with a surface of a caller's.
fn textured(gpu: &Gpu, material: &str, surface: SurfaceDescriptor<'_>) -> [[f64; 3]; 2] {
    let mut scene = Scene::new(gpu, material, &[]);
    let (vertices, indices) = tilted(0.7);
    let geometry = Geometry::new(&gpu.device, &vertices, &indices);
    let surface = SurfaceDescriptor { material: scene.kernel.material_number("skin"), ..surface };
    scene.objects = vec![Object::new(&gpu.device, &gpu.queue, geometry, &surface).expect("four bytes each")];
    // The mirror's direction: 2 (n·v) n − v.
    let sine = (1.0 - 0.7 * 0.7_f64).sqrt();
    scene.radiance(Some([1.4 * sine, 0.0, 1.4 * 0.7 - 1.0]))
}

#[test]
fn a_texture_of_one_value_is_the_material_s_own_bit_for_bit() {
    let gpu = Gpu::open();
    // Codes that stand for numbers without rounding.
    let texel = |green: u8, alpha: u8| [7, green, 9, alpha].repeat(16);
    let map = texel(255, 255);
    let rough = TexturePixels::new(4, 4, &map);
    let own = textured(&gpu, &medium("specular: (roughness: 0.25)"), SurfaceDescriptor::default());
    let roughness =
        SurfaceDescriptor { roughness: Some(rough), roughness_factor: 0.25, ..Default::default() };
    assert_eq!(textured(&gpu, &medium("specular: (roughness: 0.9)"), roughness), own);
    let strength = SurfaceDescriptor { specular_strength: Some(rough), ..Default::default() };
    assert_eq!(textured(&gpu, &medium("specular: (roughness: 0.25)"), strength), own);
    // Half as strong, by the factor alone.
    let half = SurfaceDescriptor { specular_strength_factor: 0.5, ..Default::default() };
    let halved = textured(&gpu, &medium("specular: (roughness: 0.25, reflectance_at_normal: 0.06)"), half);
    let expected = textured(
        &gpu,
        &medium("specular: (roughness: 0.25, reflectance_at_normal: 0.03)"),
        SurfaceDescriptor::default(),
    );
    assert_eq!(halved[1], expected[1]);
}

#[test]
fn normals_that_differ_make_a_surface_rougher_from_afar() {
    let gpu = Gpu::open();
    let material = medium("specular: (roughness: 0.2)");
    let code = |value: f64| (127.5 + 127.5 * value).round() as u8;
    let map = |tilt: f64| -> Vec<u8> {
        (0..64 * 64)
            .flat_map(|at| {
                let x = if (at % 64 + at / 64) % 2 == 0 { tilt } else { -tilt };
                [code(x), 128, code((1.0 - x * x).sqrt()), 255]
            })
            .collect()
    };
    let seen = |texels: &[u8]| {
        let normals =
            SurfaceDescriptor { normals: Some(TexturePixels::new(64, 64, texels)), ..Default::default() };
        textured(&gpu, &material, normals)[1][0]
    };
    let (flat, bumpy) = (seen(&map(0.0)), seen(&map(0.4)));
    // The mean of the normals is as long as √(1 − 0.4²): α² = 0.2⁴ + 2 · (1 − 0.917 − 0.01).
    let alpha2 = 0.2_f64.powi(4) + 2.0 * (1.0 - (1.0_f64 - 0.16).sqrt() - 0.01);
    let expected = textured(
        &gpu,
        &medium(&format!("specular: (roughness: {})", alpha2.sqrt().sqrt())),
        SurfaceDescriptor::default(),
    )[1][0];
    assert!(bumpy < 0.1 * flat, "{bumpy} of {flat}");
    // Codes of eight bits.
    assert!((bumpy / expected - 1.0).abs() < 0.1, "{bumpy}, not {expected}");
    let none = textured(&gpu, &material, SurfaceDescriptor::default())[1][0];
    // The code 128 is a slope of 0.004.
    assert!((flat / none - 1.0).abs() < 0.05, "a flat map changes the roughness: {flat}, {none}");
}

#[test]
fn a_lamp_behind_a_slab_is_as_near_as_the_face_that_it_lights() {
    let gpu = Gpu::open();
    let mut scene = Scene::new(&gpu, &skin(""), &[block([0.05, 0.05, 2e-3])]);
    // 18 mm from the face behind, 22 from the one in view.
    let lamp = PointLight { position: [0.0, 0.0, -0.02], intensity: [1e-3; 3], radius_mm: 0.0 };
    let [_, found, _] = scene.lit(&[lamp.into()], 0.0, Bounds::new([0.0; 3], 0.08));
    for (channel, through) in slab_law(4.0).into_iter().enumerate() {
        let expected = 1e-3 / 0.018_f64.powi(2) * through * entering(1.0) / PI;
        // The mean over a disc, beside whose middle the way is longer.
        assert!((found[channel] / expected - 1.0).abs() < 0.03, "{channel}: {found:?}, not {expected}");
    }
}
