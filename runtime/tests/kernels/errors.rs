//! What is refused, and in which words.

use crate::buffers::{Buffers, noise};
use crate::gpu::Gpu;
use crate::setup::{Description, Diffuser, KERNELS, PATHS, descriptor, run, shared_gpu};
use subsurface_codegen::{Estimator, OutputFormat};
use subsurface_runtime::{
    BindError, Extent, FrameError, KernelModule, KernelParts, PassError, Path, SubsurfaceDescriptor,
    SubsurfaceInputs, SubsurfacePass, SubsurfaceView, Target, Viewport, wgpu,
};

fn view() -> SubsurfaceView {
    SubsurfaceView::orthographic_distances(0.3)
}

#[test]
fn the_compute_path_writes_any_format_that_the_device_can_store_to() {
    let gpu = shared_gpu();
    let buffers = Buffers::plane([21, 13], 0).lit(|x, y| [0, 1, 2].map(|salt| noise(x, y, salt)));
    for estimator in KERNELS {
        let description = Description::pair(estimator);
        let half = description.compiler().output_format(OutputFormat::Rgba16Float);
        let half = gpu.load(&half.compile().unwrap_or_else(|report| panic!("{report}")).parts);
        let single = Diffuser::new(&description, Path::Compute).diffuse(&view(), &buffers);
        // The README's own case: a kernel as it comes, and an output of 32 bits.
        let mut pass = SubsurfacePass::new(&gpu.device, &half, &descriptor()).expect("every device can");
        assert_eq!((pass.path(), pass.compute_refusal()), (Path::Compute, None));
        let picture = gpu.validated(|| run(gpu, &mut pass, &view(), &buffers.upload(gpu).inputs()));
        assert!(picture == single, "{estimator}: the text of another format gives the same picture");
    }
}

#[test]
fn formats_that_cannot_be_stored_to_take_the_fragment_path_and_say_why() {
    let gpu = shared_gpu();
    let kernel = gpu.load(Description::pair(Estimator::default()).compile());
    let descriptor = SubsurfaceDescriptor::new(wgpu::TextureFormat::Rgba8UnormSrgb);
    let pass = SubsurfacePass::new(&gpu.device, &kernel, &descriptor).expect("it can be rendered to");
    assert_eq!(pass.path(), Path::Fragment);
    let refusal = pass.compute_refusal().expect("a reason");
    assert_eq!(
        refusal.to_string(),
        "the compute path cannot store to Rgba8UnormSrgb on this device: take Rgba16Float or Rgba32Float, or use \
         Path::Fragment"
    );
    let compute = SubsurfaceDescriptor { path: Some(Path::Compute), ..descriptor };
    assert_eq!(SubsurfacePass::new(&gpu.device, &kernel, &compute).expect_err("asked for"), refusal);
    let depth = SubsurfaceDescriptor::new(wgpu::TextureFormat::Rgb9e5Ufloat);
    let error = SubsurfacePass::new(&gpu.device, &kernel, &depth).expect_err("no colour target");
    assert!(matches!(error, PassError::NotRenderable { .. }), "{error}");
}

#[test]
fn a_module_of_one_format_says_so() {
    let gpu = shared_gpu();
    let parts = Description::pair(Estimator::Dense).compile();
    let module = parts.module();
    // As other compilers than ours may make it: without the place of the format.
    let fixed = KernelModule::new(
        module.estimator(),
        module.wgsl().to_owned(),
        module.row_stride(),
        module.row_binding(),
    )
    .with_entry_points(module.entry_points().map(str::to_owned))
    .with_output_format(OutputFormat::Rgba32Float, None);
    let names: Vec<_> = parts.material_names().map(str::to_owned).collect();
    let fixed = KernelParts::builder(fixed)
        .materials(names, parts.material_rows().to_vec(), module.row_stride())
        .profile_curves(parts.profile_curves().to_vec(), parts.curve_size())
        .build()
        .unwrap_or_else(|error| panic!("{error}"));
    let kernel = gpu.load(&fixed);
    let of = |format| SubsurfacePass::new(&gpu.device, &kernel, &SubsurfaceDescriptor::new(format));
    assert_eq!(of(wgpu::TextureFormat::Rgba32Float).expect("its own").path(), Path::Compute);
    let refusal = of(wgpu::TextureFormat::Rgba16Float).expect("it renders").compute_refusal();
    let expected = PassError::Format {
        kernel: Some(wgpu::TextureFormat::Rgba32Float),
        output: wgpu::TextureFormat::Rgba16Float,
    };
    assert_eq!(refusal, Some(expected));
}

#[test]
fn a_device_without_compute_takes_the_fragment_path() {
    let gpu: &'static Gpu = Box::leak(Box::new(Gpu::with_limits(wgpu::Limits::downlevel_webgl2_defaults())));
    for chosen in KERNELS {
        let description = Description::pair(chosen);
        let kernel = gpu.load(description.compile());
        let compute = SubsurfaceDescriptor { path: Some(Path::Compute), ..descriptor() };
        let error = SubsurfacePass::new(&gpu.device, &kernel, &compute).expect_err("no compute");
        assert_eq!(error, PassError::NoCompute);
        assert!(error.to_string().ends_with("use Path::Fragment"), "{error}");
        // Every kernel runs within the limits of WebGL 2.
        let pass = gpu.validated(|| SubsurfacePass::new(&gpu.device, &kernel, &descriptor()));
        let pass = pass.expect("every device renders");
        assert_eq!((pass.path(), pass.compute_refusal()), (Path::Fragment, Some(PassError::NoCompute)));
        let mut diffuser = Diffuser::of_pass(gpu, pass);
        let buffers = Buffers::plane([20, 12], 0).lit(|x, _| [(x % 2) as f32; 3]);
        let picture = diffuser.diffuse(&view(), &buffers);
        assert!(picture != buffers.irradiance, "{chosen}: nothing is diffused");
    }
}

#[test]
fn a_kernel_beyond_the_device_is_refused_with_both_values() {
    let narrow = wgpu::Limits { max_uniform_buffer_binding_size: 64, ..Default::default() };
    let gpu = Gpu::with_limits(narrow);
    let parts = Description::pair(Estimator::default()).compile();
    let error = subsurface_runtime::LoadedKernel::new(&gpu.device, &gpu.queue, parts).expect_err("too large");
    let bytes = parts.material_rows().len();
    let says = format!("material rows take {bytes} bytes, and this device binds 64 at most");
    assert!(error.to_string().contains(&says), "{error}");
    assert!(error.to_string().contains("`max_uniform_buffer_binding_size`"), "{error}");
}

/// A texture that nothing fills.
fn texture(
    gpu: &Gpu,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
    change: impl FnOnce(&mut wgpu::TextureDescriptor<'_>),
) -> wgpu::TextureView {
    let mut descriptor = wgpu::TextureDescriptor {
        label: Some("test input"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    };
    change(&mut descriptor);
    gpu.device.create_texture(&descriptor).create_view(&Default::default())
}

#[test]
fn inputs_that_do_not_fit_are_refused_by_name() {
    use wgpu::TextureFormat::{R8Uint, R32Float, Rgba8Unorm, Rgba16Float, Rgba32Float};
    let gpu = shared_gpu();
    let size = [12, 8];
    let plain = |format| texture(gpu, size, format, |_| {});
    let (irradiance, surface, depth) = (plain(Rgba16Float), plain(Rgba32Float), plain(R32Float));
    let half = |format| texture(gpu, [6, 4], format, |_| {});
    let (half_surface, half_depth) = (half(Rgba32Float), half(R32Float));
    let bytes = plain(Rgba8Unorm);
    let many = texture(gpu, size, Rgba16Float, |descriptor| descriptor.sample_count = 4);
    let unread = texture(gpu, size, Rgba16Float, |descriptor| {
        descriptor.usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
    });
    let solid = texture(gpu, size, Rgba16Float, |descriptor| {
        descriptor.dimension = wgpu::TextureDimension::D3;
        descriptor.usage = wgpu::TextureUsages::TEXTURE_BINDING;
    });
    let (one_colour, whole) = (plain(R32Float), plain(R8Uint));
    let inputs = SubsurfaceInputs::new(&irradiance, &surface, &depth);
    let of = |irradiance, surface, depth| SubsurfaceInputs::new(irradiance, surface, depth);
    let cases = [
        (
            of(&irradiance, &half_surface, &depth),
            "`surface` is a texture of 6×4 pixels, and `irradiance` one of 12×8: all inputs except the scale of the mean \
             free path have one size",
        ),
        (of(&irradiance, &surface, &half_depth), "`depth` is a texture of 6×4 pixels"),
        (
            of(&irradiance, &bytes, &depth),
            "`surface` is a texture of the format Rgba8Unorm, and the pass needs one that holds material numbers and −1 \
             beside the colour: Rgba16Float or Rgba32Float, or any colour format with `material_ids` beside it",
        ),
        (of(&one_colour, &surface, &depth), "`irradiance` is a texture of the format R32Float"),
        (of(&irradiance, &surface, &whole), "`depth` is a texture of the format R8Uint"),
        (of(&many, &surface, &depth), "`irradiance` has 4 samples per pixel, and the pass reads 1"),
        (of(&unread, &surface, &depth), "`irradiance` is a texture of the usages"),
        (of(&solid, &surface, &depth), "`irradiance` is a texture of the dimension D3"),
        (
            inputs.with_mean_free_path_scale(&whole),
            "`mean_free_path_scale` is a texture of the format R8Uint",
        ),
        (inputs.with_material_ids(&whole), "made without `material_ids`"),
        (
            inputs.with_viewport(Viewport::new(8, 0, 8, 8)),
            "the viewport 8×8 at (8, 0) is empty or reaches beyond the inputs' 12×8",
        ),
        (inputs.with_viewport(Viewport::new(0, 0, 0, 8)), "the viewport 0×8 at (0, 0) is empty"),
    ];
    let description = Description::pair(Estimator::default());
    for path in PATHS {
        let mut diffuser = Diffuser::unused(&description, path);
        for (inputs, says) in &cases {
            let error = diffuser.pass().bind(&gpu.device, inputs).expect_err(says);
            assert!(error.to_string().contains(says), "{error}\ndoes not say: {says}");
        }
        let unbound = FrameError::NotBound { pass: "SubsurfacePass" };
        assert_eq!(diffuser.pass().create_output(&gpu.device).expect_err("nothing is bound"), unbound);
        // What was bound stays.
        let buffers = Buffers::plane(size, 0).lit(|x, _| [x as f32; 3]);
        let picture = diffuser.diffuse(&view(), &buffers);
        for (inputs, says) in &cases {
            diffuser.pass().bind(&gpu.device, inputs).expect_err(says);
        }
        let output = diffuser.pass().create_output(&gpu.device).expect("bound before");
        assert!(crate::setup::run_to(gpu, diffuser.pass(), &view(), &output) == picture, "{path:?}");
    }
    let kernel = gpu.load(description.compile());
    let with_ids = SubsurfaceDescriptor { material_ids: true, ..descriptor() };
    let mut pass = SubsurfacePass::new(&gpu.device, &kernel, &with_ids).expect("every device can");
    assert_eq!(pass.bind(&gpu.device, &inputs).expect_err("no ids"), BindError::MaterialIdsMissing);
    let error = pass.bind(&gpu.device, &inputs.with_material_ids(&depth)).expect_err("floats");
    assert!(error.to_string().contains("whole numbers without a sign"), "{error}");
}

#[test]
fn outputs_that_cannot_be_written_are_refused() {
    let gpu = shared_gpu();
    let buffers = Buffers::plane([12, 8], 0);
    let uploaded = buffers.upload(gpu);
    let target = |size, format| Target::new(&gpu.device, size, format, "test output").expect("small");
    let (size, format) = (Extent::new(12, 8), wgpu::TextureFormat::Rgba32Float);
    for path in PATHS {
        let mut diffuser = Diffuser::new(&Description::pair(Estimator::default()), path);
        let pass = diffuser.pass();
        pass.bind(&gpu.device, &uploaded.inputs()).expect("they fit");
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut refused = |pass: &SubsurfacePass, target: &Target| {
            pass.encode(&mut encoder, &target.view).expect_err("it does not fit").to_string()
        };
        let says = refused(pass, &target(size, format));
        assert!(says.contains("call `prepare` after `bind`"), "{says}");
        pass.prepare(&gpu.queue, &view()).expect("bound");
        let says = refused(pass, &target(Extent::new(6, 4), format));
        assert!(says.contains("texture of 6×4 pixels, and its inputs have 12×8"), "{says}");
        let says = refused(pass, &target(size, wgpu::TextureFormat::Rgba16Float));
        assert!(says.contains("format Rgba32Float, and is given Rgba16Float"), "{says}");
        if path == Path::Compute {
            let says = refused(pass, &target(size, format));
            assert!(says.contains("needs TextureUsages(STORAGE_BINDING)"), "{says}");
        }
    }
}

#[test]
fn sizes_that_no_texture_can_have_are_refused() {
    let gpu = shared_gpu();
    let format = wgpu::TextureFormat::Rgba32Float;
    let made = |width| Target::new(&gpu.device, Extent::new(width, 4), format, "test target");
    let error = made(0).expect_err("0 pixels wide");
    assert_eq!(error.to_string(), "a frame of 0×4 pixels has no pixel: give at least 1×1");
    let error = made(1 << 20).expect_err("too wide");
    assert!(error.to_string().contains("beyond this device's limit"), "{error}");
}
