//! What is refused, and in which words.

use crate::buffers::Buffers;
use crate::gpu::Gpu;
use crate::setup::{Description, Diffuser, KERNELS, shared_gpu};
use subsurface_codegen::{Compilation, Estimator, OutputFormat};
use subsurface_runtime::{Extent, Path, PathError, SubsurfaceInputs, SubsurfacePass, SubsurfaceView, wgpu};

fn compilation(kernel: Estimator) -> Compilation {
    Description::pair(kernel).compiler().compile().unwrap_or_else(|report| panic!("{report}"))
}

#[test]
fn a_compute_path_to_another_format_is_refused() {
    let gpu = shared_gpu();
    for chosen in KERNELS {
        let kernel = compilation(chosen).parts;
        assert_eq!(kernel.module().output_format(), OutputFormat::Rgba32Float);
        let format = wgpu::TextureFormat::Rgba16Float;
        let error = SubsurfacePass::with_path(&gpu.device, &kernel, format, None, Path::Compute)
            .expect_err("another format");
        assert_eq!(
            error.to_string(),
            "the kernel's compute path writes Some(Rgba32Float), and the output is Rgba16Float: compile the kernel \
             for that format, or use Path::Fragment"
        );
        // Left to itself the pass takes the path that works.
        assert_eq!(SubsurfacePass::new(&gpu.device, &kernel, format, None).path(), Path::Fragment);
        let own = wgpu::TextureFormat::Rgba32Float;
        assert_eq!(SubsurfacePass::new(&gpu.device, &kernel, own, None).path(), Path::Compute);
    }
    let half = Description::pair(Estimator::default()).compiler().output_format(OutputFormat::Rgba16Float);
    let half = half.compile().unwrap_or_else(|report| panic!("{report}")).parts;
    assert_eq!(half.module().output_format(), OutputFormat::Rgba16Float);
}

#[test]
fn a_device_without_compute_takes_the_fragment_path() {
    let gpu: &'static Gpu = Box::leak(Box::new(Gpu::with_limits(wgpu::Limits::downlevel_webgl2_defaults())));
    for chosen in KERNELS {
        let description = Description::pair(chosen);
        let format = wgpu::TextureFormat::Rgba32Float;
        let error =
            SubsurfacePass::with_path(&gpu.device, description.compile(), format, None, Path::Compute)
                .expect_err("no compute");
        assert_eq!(error, PathError::NoCompute);
        assert!(error.to_string().ends_with("use Path::Fragment"), "{error}");
        // Every kernel runs within the limits of WebGL 2.
        let pass = gpu.validated(|| SubsurfacePass::new(&gpu.device, description.compile(), format, None));
        assert_eq!(pass.path(), Path::Fragment);
        let mut diffuser = Diffuser::of_pass(gpu, pass);
        let buffers = Buffers::plane([20, 12], 0).lit(|x, _| [(x % 2) as f32; 3]);
        let picture = diffuser.diffuse(&SubsurfaceView::orthographic_distances(0.3), &buffers);
        assert!(picture != buffers.irradiance, "{chosen}: nothing is diffused");
    }
}

#[test]
fn sizes_that_no_texture_can_have_are_refused() {
    let gpu = shared_gpu();
    for kernel in KERNELS {
        let mut diffuser = Diffuser::unused(&Description::pair(kernel), Path::Compute);
        let uploaded = Buffers::plane([4, 4], 0).upload(gpu);
        let inputs = SubsurfaceInputs {
            irradiance: &uploaded.irradiance,
            surface: &uploaded.surface,
            depth: &uploaded.depth,
            depth_stencil: None,
            mean_free_path_scale: None,
        };
        let mut resize = |width| diffuser.pass().resize(&gpu.device, Extent::new(width, 4), &inputs);
        let error = resize(0).expect_err("0 pixels wide");
        assert_eq!(error.to_string(), "a frame of 0×4 pixels has no pixel: give at least 1×1");
        let error = resize(1 << 20).expect_err("too wide");
        assert!(error.to_string().contains("beyond this device's limit"), "{error}");
        assert!(diffuser.pass().output().is_none());
    }
}
