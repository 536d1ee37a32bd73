//! Inputs in other shapes: a part of a texture, a layer of an array, material numbers of their own.

use crate::buffers::{Buffers, DISTANCE_MM, Uploaded, noise};
use crate::gpu::Gpu;
use crate::setup::{Description, Diffuser, KERNELS, PATHS, descriptor, run, run_to, shared_gpu};
use subsurface_codegen::Estimator;
use subsurface_runtime::{
    Path, SubsurfaceDescriptor, SubsurfacePass, SubsurfaceView, Target, Viewport, wgpu,
};

/// Sides that are multiples of neither a tile nor a block, from a pixel that begins neither.
const PART: Viewport = Viewport::new(7, 5, 35, 27);

/// Two materials, background, hills, and noise in all that may have some.
fn scene(size: [u32; 2]) -> Buffers {
    let number = |x: u32, y: u32| match (x / 9 + y / 7) % 5 {
        0 => -1.0,
        1 | 2 => 0.0,
        _ => 1.0,
    };
    Buffers::plane(size, 0)
        .lit(|x, y| [0, 1, 2].map(|salt| noise(x, y, salt)))
        .coloured(|x, y| [3, 4, 5].map(|salt| 0.2 + 0.7 * noise(x, y, salt)))
        .covered(number)
        .distant(|x, _| DISTANCE_MM + 3.0 * (0.2 * x as f32).sin())
        .scaled(|x, y| 0.5 + noise(x, y, 6))
}

/// The part of the buffers that a viewport shows.
fn cut(buffers: &Buffers, part: Viewport) -> Buffers {
    let place = |x: u32, y: u32| buffers.index(x + part.x, y + part.y);
    let mut cut = Buffers::plane([part.width, part.height], 0);
    cut.irradiance = cut.each(|x, y| buffers.irradiance[place(x, y)]);
    cut.surface = cut.each(|x, y| buffers.surface[place(x, y)]);
    cut.distance_mm = cut.each(|x, y| buffers.distance_mm[place(x, y)]);
    cut.scale = buffers.scale.as_ref().map(|scale| cut.each(|x, y| scale[place(x, y)]));
    cut
}

fn view() -> SubsurfaceView {
    SubsurfaceView::orthographic_distances(0.3).with_frame_index(3)
}

#[test]
fn a_viewport_shows_what_inputs_cut_to_it_show() {
    let gpu = shared_gpu();
    let buffers = scene([50, 40]);
    let uploaded = buffers.upload(gpu);
    let inputs = uploaded.inputs().with_viewport(PART);
    for estimator in KERNELS {
        for path in PATHS {
            let mut diffuser = Diffuser::new(&Description::pair(estimator), path);
            let alone = diffuser.diffuse(&view(), &cut(&buffers, PART));
            let pass = diffuser.pass();
            let picture = gpu.validated(|| {
                pass.bind(&gpu.device, &inputs).expect("the part lies within");
                let output = pass.create_output(&gpu.device).expect("bound above");
                clear(gpu, &output, 0.25);
                run_to(gpu, pass, &view(), &output)
            });
            for (index, pixel) in picture.iter().enumerate() {
                let (x, y) = (index as u32 % 50, index as u32 / 50);
                let column = x.checked_sub(PART.x).filter(|column| *column < PART.width);
                let row = y.checked_sub(PART.y).filter(|row| *row < PART.height);
                let expected = match (column, row) {
                    (Some(column), Some(row)) => alone[(row * PART.width + column) as usize],
                    // The other eye's.
                    _ => [0.25; 4],
                };
                assert_eq!(*pixel, expected, "{estimator}, {path:?}, ({x}, {y})");
            }
        }
    }
}

fn clear(gpu: &Gpu, target: &Target, value: f64) {
    let colour = wgpu::Color { r: value, g: value, b: value, a: value };
    gpu.submit(|encoder| {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("test background"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(colour), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        });
        Ok(())
    });
}

/// Layer 1 of an array of three, which holds `texels`; the others are black.
fn layer(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat, texels: &[u8]) -> wgpu::TextureView {
    use wgpu::util::DeviceExt as _;
    let black = vec![0; texels.len()];
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("test layers"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 3 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        &[&black[..], texels, &black[..]].concat(),
    );
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        base_array_layer: 1,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

#[test]
fn a_layer_of_an_array_is_an_input_like_any_other() {
    let gpu = shared_gpu();
    let buffers = scene([30, 20]);
    let rgba = |texels: &[[f32; 4]]| {
        layer(gpu, buffers.size, wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(texels))
    };
    let single = |texels: &[f32]| {
        layer(gpu, buffers.size, wgpu::TextureFormat::R32Float, bytemuck::cast_slice(texels))
    };
    let layers = Uploaded {
        irradiance: rgba(&buffers.irradiance),
        surface: rgba(&buffers.surface),
        depth: single(&buffers.distance_mm),
        scale: buffers.scale.as_deref().map(single),
    };
    for path in PATHS {
        let mut diffuser = Diffuser::new(&Description::pair(Estimator::default()), path);
        let plain = diffuser.diffuse(&view(), &buffers);
        assert!(gpu.validated(|| run(gpu, diffuser.pass(), &view(), &layers.inputs())) == plain, "{path:?}");
    }
}

#[test]
fn material_numbers_of_their_own_give_the_same_picture() {
    let gpu = shared_gpu();
    let buffers = scene([30, 20]);
    let numbers: Vec<i32> = buffers.surface.iter().map(|texel| texel[3] as i32).collect();
    // −1 is the largest number of each format.
    let bytes: Vec<u8> = numbers.iter().map(|number| *number as u8).collect();
    let words: Vec<u16> = numbers.iter().map(|number| *number as u16).collect();
    let formats: [(_, &[u8]); 3] = [
        (wgpu::TextureFormat::R8Uint, &bytes),
        (wgpu::TextureFormat::R16Uint, bytemuck::cast_slice(&words)),
        (wgpu::TextureFormat::R32Uint, bytemuck::cast_slice(&numbers)),
    ];
    // A colour format without room for numbers, as many engines have it; and one whose alpha holds something else.
    let mut rough = buffers.clone();
    for texel in &mut rough.surface {
        texel[3] = 0.37;
    }
    let albedo: Vec<[u8; 4]> = buffers.surface.iter().map(|texel| texel.map(|c| (c * 255.0) as u8)).collect();
    let mut rounded = buffers.clone();
    for (texel, byte) in rounded.surface.iter_mut().zip(&albedo) {
        let [red, green, blue] = [0, 1, 2].map(|channel: usize| f32::from(byte[channel]) / 255.0);
        *texel = [red, green, blue, texel[3]];
    }
    let uploaded = rough.upload(gpu);
    let bytes_of_albedo =
        gpu.texture(buffers.size, wgpu::TextureFormat::Rgba8Unorm, bytemuck::cast_slice(&albedo));
    for estimator in KERNELS {
        let description = Description::pair(estimator);
        let kernel = gpu.load(description.compile());
        for path in PATHS {
            let mut plain = Diffuser::new(&description, path);
            let (expected, rounded) = (plain.diffuse(&view(), &buffers), plain.diffuse(&view(), &rounded));
            let with_ids = SubsurfaceDescriptor { path: Some(path), material_ids: true, ..descriptor() };
            let mut pass = SubsurfacePass::new(&gpu.device, &kernel, &with_ids).expect("the path is there");
            for (format, texels) in formats {
                let ids = gpu.texture(buffers.size, format, texels);
                let picture = gpu
                    .validated(|| run(gpu, &mut pass, &view(), &uploaded.inputs().with_material_ids(&ids)));
                assert!(picture == expected, "{estimator}, {path:?}, {format:?}");
                if format == wgpu::TextureFormat::R8Uint {
                    let mut inputs = uploaded.inputs().with_material_ids(&ids);
                    inputs.surface = &bytes_of_albedo;
                    let picture = run(gpu, &mut pass, &view(), &inputs);
                    // Bytes become floats by a division or by a factor, as the device likes.
                    let apart = picture.iter().flatten().zip(rounded.iter().flatten());
                    let apart = apart.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                    assert!(apart < 1e-4, "{estimator}, {path:?}: surface albedo in bytes, {apart} apart");
                }
            }
        }
    }
}

#[test]
fn a_kernel_that_takes_over_gives_the_picture_of_a_new_pass() {
    let gpu = shared_gpu();
    let buffers = scene([30, 20]);
    let uploaded = buffers.upload(gpu);
    for path in PATHS {
        let made_for = |estimator| Description::pair(estimator);
        let mut diffuser = Diffuser::unused(&made_for(Estimator::default()), path);
        diffuser.diffuse(&view(), &buffers);
        diffuser.pass().bind(&gpu.device, &uploaded.inputs()).expect("they fit");
        // Another estimator, with other textures between its stages; and back.
        for estimator in [Estimator::ImportanceSampled { taps: 17 }, Estimator::Dense, Estimator::default()] {
            let expected = Diffuser::new(&made_for(estimator), path).diffuse(&view(), &buffers);
            let kernel = gpu.load(made_for(estimator).compile());
            let picture = gpu.validated(|| {
                diffuser.pass().set_kernel(&gpu.device, &kernel).expect("the path is there");
                let output = diffuser.pass().create_output(&gpu.device).expect("still bound");
                run_to(gpu, diffuser.pass(), &view(), &output)
            });
            assert!(picture == expected, "{estimator}, {path:?}");
        }
    }
}

#[test]
fn one_pass_writes_to_as_many_outputs_as_there_are_frames() {
    let gpu = shared_gpu();
    let buffers = scene([30, 20]);
    let uploaded = buffers.upload(gpu);
    let mut diffuser = Diffuser::new(&Description::pair(Estimator::default()), Path::Compute);
    let expected = diffuser.diffuse(&view(), &buffers);
    let pass = diffuser.pass();
    gpu.validated(|| {
        pass.bind(&gpu.device, &uploaded.inputs()).expect("they fit");
        // More than the pass keeps bind groups for.
        let outputs: Vec<_> = (0..7).map(|_| pass.create_output(&gpu.device).expect("bound above")).collect();
        for output in outputs.iter().chain(&outputs[2..5]).chain(outputs.iter().rev()) {
            clear(gpu, output, 0.5);
            assert!(run_to(gpu, pass, &view(), output) == expected);
        }
    });
}
