//! The compute path and the fragment path are two forms of one thing; and both are still.

use crate::buffers::{Buffers, DISTANCE_MM, noise};
use crate::gpu::Gpu;
use crate::setup::{Description, Diffuser, KERNELS, PATHS, psnr, shared_gpu};
use subsurface_codegen::Estimator;
use subsurface_runtime::{
    ComputeShape, Extent, GBuffer, Path, SubsurfaceView, TRANSLUCENT_STENCIL, Target, wgpu,
};

/// Sides that are multiples of neither a tile nor a block.
const SIZE: [u32; 2] = [53, 39];

/// Two materials side by side, a silhouette, an empty tile, and noise in all that may have some.
fn scene(size: [u32; 2], first: u32, second: u32) -> Buffers {
    let is_background = |x: u32, y: u32| (x < 18 && y < 17) || (x + 2 * y).is_multiple_of(37);
    Buffers::plane(size, first)
        .lit(|x, y| [0, 1, 2].map(|salt| noise(x, y, salt)))
        .coloured(|x, y| [3, 4, 5].map(|salt| 0.2 + 0.7 * noise(x, y, salt)))
        .covered(|x, y| {
            let material = if x + y < 50 { first } else { second };
            if is_background(x, y) { -1.0 } else { material as f32 }
        })
        .distant(|x, y| {
            let hill = 3.0 * (0.2 * x as f32).sin() + if y > 25 { 40.0 } else { 0.0 };
            if is_background(x, y) { 1e6 } else { DISTANCE_MM + hill }
        })
        .scaled(|x, y| 0.5 + noise(x, y, 6))
}

fn view() -> SubsurfaceView {
    SubsurfaceView::orthographic_distances(0.3)
}

#[test]
fn compute_and_fragment_give_the_same_picture() {
    for kernel in KERNELS {
        let description = Description::all_profiles(kernel);
        let [mut compute, mut fragment] = PATHS.map(|path| Diffuser::new(&description, path));
        assert_eq!((compute.pass().path(), fragment.pass().path()), (Path::Compute, Path::Fragment));
        let mut least = f64::INFINITY;
        // A sum over all pixels takes long on software drivers.
        let size = if kernel == Estimator::Dense { [25, 21] } else { SIZE };
        for material in 0..description.stems.len() as u32 {
            let second = (material + 1) % description.stems.len() as u32;
            let buffers = scene(size, material, second);
            let pictures = (compute.diffuse(&view(), &buffers), fragment.diffuse(&view(), &buffers));
            let decibels = psnr(&pictures.0, &pictures.1);
            least = least.min(decibels);
            assert!(decibels >= 60.0, "{kernel}, {}: {decibels:.1} dB", description.stems[material as usize]);
        }
        println!("{kernel}: the paths agree to {least:.1} dB");
    }
}

#[test]
fn alpha_is_handed_through_by_every_kernel() {
    for kernel in KERNELS {
        let description = Description::pair(kernel);
        let mut buffers = scene([25, 21], 0, 1);
        for (place, texel) in (0..).zip(&mut buffers.irradiance) {
            texel[3] = 0.25 + noise(place, place / 7, 8);
        }
        for path in PATHS {
            let picture = Diffuser::new(&description, path).diffuse(&view(), &buffers);
            let alphas = picture.iter().zip(&buffers.irradiance);
            assert!(alphas.into_iter().all(|(drawn, before)| drawn[3] == before[3]), "{kernel}, {path:?}");
        }
    }
}

#[test]
fn light_beyond_the_limit_of_packed_pixels_counts_alike_on_both_paths() {
    // One pixel of each square of 4×4, far above 4.29e9: the mean of what is packed, or what is packed of the mean?
    let is_bright = |x: u32, y: u32| x % 4 == 1 && y % 4 == 2;
    let buffers = Buffers::plane(SIZE, 0).lit(|x, y| if is_bright(x, y) { [1e30; 3] } else { [0.0; 3] });
    let description = Description::pair(Estimator::Interleaved { taps: 4 });
    let [compute, fragment] = PATHS.map(|path| Diffuser::new(&description, path).diffuse(&view(), &buffers));
    let brightest = compute.iter().map(|pixel| pixel[0]).fold(0.0, f32::max);
    for (one, other) in compute.iter().zip(&fragment) {
        // As much as 60 dB allow.
        assert!((one[0] - other[0]).abs() < 1e-3 * brightest, "{one:?} on one path, {other:?} on the other");
    }
}

#[test]
fn both_shapes_of_the_compute_path_give_the_same_picture() {
    let shaped = KERNELS.into_iter().filter(|kernel| kernel.has_software_shape());
    for kernel in shaped {
        let description = Description::all_profiles(kernel);
        let mut passes = ComputeShape::ALL.map(|shape| Diffuser::shaped(&description, shape));
        for (pass, shape) in passes.iter_mut().zip(ComputeShape::ALL) {
            assert_eq!(pass.pass().shape(), Some(shape));
        }
        let [hardware, software] = &mut passes;
        for material in 0..description.stems.len() as u32 {
            let second = (material + 1) % description.stems.len() as u32;
            let buffers = scene(SIZE, material, second);
            let pictures = (hardware.diffuse(&view(), &buffers), software.diffuse(&view(), &buffers));
            let decibels = psnr(&pictures.0, &pictures.1);
            // The same sums of the same numbers: what differs is what a compiler contracts.
            assert!(
                decibels >= 100.0,
                "{kernel}, {}: {decibels:.1} dB",
                description.stems[material as usize]
            );
        }
    }
}

#[test]
fn the_adapter_decides_on_the_shape_that_nobody_asks_for() {
    let mut pass = Diffuser::new(&Description::all_profiles(Estimator::default()), Path::Compute);
    let is_cpu = shared_gpu().device.adapter_info().device_type == wgpu::DeviceType::Cpu;
    let expected = if is_cpu { ComputeShape::Software } else { ComputeShape::Hardware };
    assert_eq!(pass.pass().shape(), Some(expected));
    let mut fragment = Diffuser::new(&Description::all_profiles(Estimator::default()), Path::Fragment);
    assert_eq!(fragment.pass().shape(), None);
    let mut other = Diffuser::new(&Description::all_profiles(Estimator::Dense), Path::Compute);
    assert_eq!(other.pass().shape(), None);
}

/// A stencil that marks the pixels of any material.
fn stencil_of(gpu: &Gpu, buffers: &Buffers) -> Target {
    let [width, height] = buffers.size;
    let format = GBuffer::DEPTH_STENCIL_FORMAT;
    let target = Target::new(&gpu.device, Extent::new(width, height), format, "test stencil").expect("small");
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    // Stencils cannot be written from the queue on every device: draw the marked pixels as scissored runs.
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("test stencil"),
        source: wgpu::ShaderSource::Wgsl(
            "@vertex fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
                 return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.5, 1.0);
             }"
            .into(),
        ),
    });
    let face =
        wgpu::StencilFaceState { pass_op: wgpu::StencilOperation::Replace, ..wgpu::StencilFaceState::IGNORE };
    let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("test stencil"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format,
            depth_write_enabled: Some(false),
            depth_compare: Some(wgpu::CompareFunction::Always),
            stencil: wgpu::StencilState { front: face, back: face, read_mask: !0, write_mask: !0 },
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    });
    {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("test stencil"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &target.view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0),
                    store: wgpu::StoreOp::Store,
                }),
            }),
            ..Default::default()
        });
        pass.set_pipeline(&pipeline);
        pass.set_stencil_reference(TRANSLUCENT_STENCIL);
        for y in 0..height {
            for x in (0..width).filter(|x| buffers.surface[buffers.index(*x, y)][3] >= 0.0) {
                pass.set_scissor_rect(x, y, 1, 1);
                pass.draw(0..3, 0..1);
            }
        }
    }
    gpu.queue.submit([encoder.finish()]);
    target
}

#[test]
fn the_stencil_saves_work_and_changes_nothing() {
    let gpu = shared_gpu();
    let buffers = scene(SIZE, 0, 1);
    let stencil = gpu.validated(|| stencil_of(gpu, &buffers));
    for kernel in KERNELS {
        let description = Description::pair(kernel);
        let without = Diffuser::new(&description, Path::Fragment).diffuse(&view(), &buffers);
        let mut diffuser = Diffuser::with_stencil(&description);
        let with = diffuser.diffuse_with_stencil(&view(), &buffers, Some(&stencil.view));
        assert!(without == with, "{kernel}: the stencil changed the picture");
    }
}

#[test]
fn nothing_of_an_earlier_frame_stays() {
    /// Three tiles along each side.
    const FULL: [u32; 2] = [48, 48];
    let lit = scene(FULL, 0, 1).lit(|_, _| [1000.0; 3]).covered(|_, _| 0.0);
    // One tile, a single pixel, nothing: around each, blocks and tiles were full of light a frame ago.
    let one_tile = scene(FULL, 0, 1).covered(|x, y| if x / 16 == 1 && y / 16 == 2 { 0.0 } else { -1.0 });
    let one_pixel = scene(FULL, 0, 1).covered(|x, y| if (x, y) == (31, 16) { 1.0 } else { -1.0 });
    let nothing = scene(FULL, 0, 1).covered(|_, _| -1.0);
    for kernel in KERNELS {
        let description = Description::pair(kernel);
        for path in PATHS {
            let mut used = Diffuser::new(&description, path);
            let mut fresh = Diffuser::new(&description, path);
            for (name, later) in [("tile", &one_tile), ("pixel", &one_pixel), ("nothing", &nothing)] {
                used.diffuse(&view(), &lit);
                // Another size has other textures, which start empty.
                fresh.diffuse(&view(), &scene([9, 5], 0, 1));
                let pictures = (used.diffuse(&view(), later), fresh.diffuse(&view(), later));
                assert!(pictures.0 == pictures.1, "{kernel}, {path:?}: one {name} shows the frame before");
            }
            let (large, small) = (used.diffuse(&view(), &lit), used.diffuse(&view(), &scene([9, 5], 0, 1)));
            assert_eq!((large.len(), small.len()), (48 * 48, 9 * 5));
            assert!(used.diffuse(&view(), &lit) == large, "{kernel}, {path:?}: another size stays");
        }
    }
}

#[test]
fn the_frame_index_moves_the_pattern_and_nothing_else_does() {
    let buffers = scene(SIZE, 0, 1);
    let rotated = Estimator::Separable { taps: 17, rotated: true };
    for kernel in KERNELS.into_iter().chain([rotated]) {
        let description = Description::pair(kernel);
        for path in PATHS {
            let mut diffuser = Diffuser::new(&description, path);
            let still = diffuser.diffuse(&view(), &buffers);
            let indexed =
                |diffuser: &mut Diffuser, index| diffuser.diffuse(&view().with_frame_index(index), &buffers);
            let moved = indexed(&mut diffuser, 5);
            assert!(indexed(&mut diffuser, 5) == moved, "{kernel}, {path:?}: frame 5 differs from itself");
            assert!(
                indexed(&mut diffuser, 0) == still,
                "{kernel}, {path:?}: frame 0 is not the still picture"
            );
            // Kernels without a pattern have nothing to move.
            let has_pattern =
                kernel != Estimator::Dense && kernel != Estimator::Separable { taps: 17, rotated: false };
            assert_eq!(moved != still, has_pattern, "{kernel}, {path:?}: frame 5");
            indexed(&mut diffuser, u32::MAX)
                .iter()
                .flatten()
                .for_each(|v| assert!(v.is_finite(), "{kernel}"));
        }
    }
}

#[test]
fn frames_that_accumulate_lose_noise() {
    let buffers = Buffers::plane([48, 48], 0).lit(|x, y| [noise(x / 4, y / 4, 0); 3]);
    let exact = Diffuser::new(&Description::pair(Estimator::Dense), Path::Compute).diffuse(&view(), &buffers);
    for kernel in [Estimator::ImportanceSampled { taps: 17 }, Estimator::Interleaved { taps: 4 }] {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        let mut sum = vec![[0.0_f32; 4]; exact.len()];
        for index in 0..9 {
            let picture = diffuser.diffuse(&view().with_frame_index(index), &buffers);
            for (sum, pixel) in sum.iter_mut().zip(picture) {
                *sum = std::array::from_fn(|c| sum[c] + pixel[c] / 9.0);
            }
        }
        let (one, nine) = (psnr(&diffuser.diffuse(&view(), &buffers), &exact), psnr(&sum, &exact));
        println!("{kernel}: {one:.1} dB against Dense, {nine:.1} dB over nine frames");
        // 1 dB: bias remains when noise averages out.
        assert!(nine > one + 1.0, "{kernel}: {one:.1} dB, {nine:.1} dB over nine frames");
    }
}
