//! Steps that `Separable` leaves beside an edge: its strips stand in few lines of pixels, which an edge crosses at once.

use std::path::Path as FilePath;

use crate::buffers::Buffers;
use crate::setup::{Diffuser, descriptor, shared_gpu};
use subsurface_codegen::{Compiler, Estimator, Material, OutputFormat, load_directory};
use subsurface_profile::{Channel, EdgeSpread, Medium};
use subsurface_runtime::{Path, SubsurfaceDescriptor, SubsurfacePass, SubsurfaceView};

const KERNEL: Estimator = Estimator::Separable { taps: 17, rotated: false };

/// Length that a pixel spans, mm.
const PIXELS_MM: [f64; 4] = [0.1, 0.2, 0.4, 1.0];

/// The materials that the project brings along.
fn presets() -> (Vec<Material>, Diffuser) {
    let directory = FilePath::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../materials"));
    let loaded = load_directory(directory);
    let materials = loaded.set.unwrap_or_else(|| panic!("{}", loaded.report)).materials;
    let compiler = Compiler::new(directory).estimator(KERNEL).output_format(OutputFormat::Rgba32Float);
    let compilation = compiler.compile().unwrap_or_else(|report| panic!("{report}"));
    let gpu = shared_gpu();
    let descriptor = SubsurfaceDescriptor { path: Some(Path::Compute), ..descriptor() };
    let pass = SubsurfacePass::new(&gpu.device, &gpu.load(&compilation.parts), &descriptor);
    (materials, Diffuser::of_pass(gpu, pass.unwrap_or_else(|error| panic!("{error}"))))
}

/// By channel: the largest step from a column to the next across an edge, and the one that is right, which lies at the edge
/// itself: what a pixel keeps of a line through it.
fn largest_steps(
    diffuser: &mut Diffuser,
    number: u32,
    material: &Material,
    surface_albedo: [f64; 3],
    pixel_mm: f64,
) -> [(f64, f64); 3] {
    // Wide enough that what the frame's border renormalizes is little.
    const SIZE: [u32; 2] = [2048, 2];
    const EDGE: u32 = SIZE[0] / 2;
    let buffers = Buffers::plane(SIZE, number)
        .lit(|x, _| [if x >= EDGE { 1.0 } else { 0.0 }; 3])
        .coloured(|_, _| surface_albedo.map(|albedo| albedo as f32));
    let picture = diffuser.diffuse(&SubsurfaceView::orthographic_distances(pixel_mm as f32), &buffers);
    Channel::ALL.map(|channel| {
        let index = channel.index();
        let columns = picture[..SIZE[0] as usize].windows(2);
        let steps = columns.map(|pair| f64::from(pair[1][index]) - f64::from(pair[0][index]));
        // The curves end below an albedo of 1, where profiles have no last quantile.
        let medium = Medium::new(surface_albedo[index].min(0.999), material.mean_free_path_mm[index]);
        let profile = material.profile.model.profile(medium.expect("in the domain"), channel);
        let profile = profile.expect("a preset's model has a profile");
        let right = 2.0 * EdgeSpread::new(&*profile).at(0.5 * pixel_mm) - 1.0;
        (steps.fold(0.0, f64::max), right)
    })
}

#[test]
fn a_step_of_separable_is_at_most_half_as_large_again_as_the_profiles() {
    let (materials, mut diffuser) = presets();
    let mut found = Vec::new();
    for (number, material) in (0..).zip(&materials) {
        // White is what a scene without a texture of surface albedos has.
        for (surface_albedo, most) in [(material.surface_albedo, 1.25), ([1.0; 3], 1.5)] {
            for pixel_mm in PIXELS_MM {
                let steps = largest_steps(&mut diffuser, number, material, surface_albedo, pixel_mm);
                for (channel, (step, right)) in Channel::ALL.into_iter().zip(steps) {
                    let ratio = step / right;
                    let case = format!("{}, {surface_albedo:?}, {pixel_mm} mm, {channel:?}", material.name);
                    println!("{case}: {step:.4} where {right:.4} is right, {ratio:.2}");
                    found.push((case, step, most * right, right));
                }
            }
        }
    }
    // What the centre keeps is right, and mostly the larger part. Of the widest channel the first strip has 1 − (7/8)^1.5
    // of the rest, half of it on each side, and stands in two lines: where a pixel is small, that is more. The border of the
    // frame, which takes what lies beyond from wide profiles, makes it more by up to a fifth.
    let half_a_strip = 1.2 * 0.25 * (1.0 - 0.875_f64.powf(1.5));
    for (case, step, most, right) in found {
        assert!(step < f64::max(most, half_a_strip), "{case}: {step:.4} where {right:.4} is right");
    }
}
