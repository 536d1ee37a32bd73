//! Kernels under test, and the pass that runs them.

use std::sync::{LazyLock, Mutex};

use crate::buffers::Buffers;
use crate::gpu::{Gpu, example_files, model, stems, table_files};
use subsurface_codegen::{Compiler, Estimator, OutputFormat, Rejection};
use subsurface_kernel::constants::FILTER_QUANTILE;
use subsurface_profile::{Channel, Length, Medium, ModelKind, RadialProfile};
use subsurface_runtime::{
    ComputeShape, DebugView, GBuffer, KernelParts, Path, SubsurfaceDescriptor, SubsurfaceInputs,
    SubsurfacePass, SubsurfaceView, Target, wgpu,
};

pub(crate) const MEAN_FREE_PATH_MM: [f64; 3] = [1.3, 0.95, 0.67];
pub(crate) const SURFACE_ALBEDO: [f64; 3] = [0.8, 0.6, 0.4];

/// The profile of materials that name none: what stands for all where kernels, not profiles, are tested.
pub(crate) const DEFAULT_STEM: &str = "two_exponential_dipole_searchlight";

/// Every kernel with its usual taps, but for rotated axes.
pub(crate) const KERNELS: [Estimator; Estimator::ALL.len() - 1] = {
    let mut kernels = [Estimator::Dense; Estimator::ALL.len() - 1];
    let (mut from, mut to) = (0, 0);
    while from < Estimator::ALL.len() {
        if !Estimator::ALL[from].is_rotated() {
            kernels[to] = Estimator::ALL[from];
            to += 1;
        }
        from += 1;
    }
    kernels
};

/// Both paths.
pub(crate) const PATHS: [Path; 2] = [Path::Compute, Path::Fragment];

/// What the sets differ by.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Description {
    pub(crate) kernel: Estimator,
    pub(crate) rejection: Rejection,
    /// Profiles of the materials, whose numbers are their places here; sorted.
    pub(crate) stems: Vec<&'static str>,
    /// Factor on the mean free path of the second material and of all after it.
    pub(crate) length_factor: f64,
}

impl Description {
    /// A material of every profile.
    pub(crate) fn all_profiles(kernel: Estimator) -> Self {
        let mut stems = stems();
        stems.sort_unstable();
        Self { kernel, rejection: Rejection::default(), stems, length_factor: 1.0 }
    }

    /// The same, or fewer where a software driver would take minutes: a material of every model for sums over all
    /// pixels, whose cost does not depend on a model's coefficients.
    pub(crate) fn affordable(kernel: Estimator) -> Self {
        let all = Self::all_profiles(kernel);
        if kernel != Estimator::Dense {
            return all;
        }
        let of_model = |kind: &ModelKind| {
            kind.published().first().map_or(kind.description().stem, |published| published.stem)
        };
        let mut stems: Vec<&'static str> =
            ModelKind::ALL.iter().map(of_model).filter(|stem| all.stems.contains(stem)).collect();
        stems.sort_unstable();
        Self { stems, ..all }
    }

    /// All profiles, or a pair where software drivers compile for half a minute what the other path and the comparison of
    /// both cover.
    pub(crate) fn on_path(kernel: Estimator, path: Path) -> Self {
        if (kernel, path) == (Estimator::Dense, Path::Fragment) {
            Self::pair(kernel)
        } else {
            Self::all_profiles(kernel)
        }
    }

    /// Two materials of the default profile.
    pub(crate) fn pair(kernel: Estimator) -> Self {
        let stems = vec![DEFAULT_STEM; 2];
        Self { kernel, rejection: Rejection::default(), stems, length_factor: 1.0 }
    }

    /// The compiler of the set.
    pub(crate) fn compiler(&self) -> Compiler {
        let materials = self.stems.iter().enumerate().map(|(number, stem)| {
            let factor = if number == 0 { 1.0 } else { self.length_factor };
            // Materials are numbered by name.
            (format!("material_{number:02}.ron"), material(stem, factor))
        });
        Compiler::from_memory(materials.chain(table_files()).chain(example_files()))
            .with_debug_views()
            .estimator(self.kernel)
            .rejection(self.rejection)
            .output_format(OutputFormat::Rgba32Float)
    }

    /// The kernel of the set; each is compiled once in the test program.
    pub(crate) fn compile(&self) -> &'static KernelParts {
        static COMPILED: LazyLock<Mutex<Vec<(Description, &'static KernelParts)>>> =
            LazyLock::new(Mutex::default);
        // A test that failed while it compiled leaves a list that still holds.
        let mut compiled = COMPILED.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if let Some((_, known)) = compiled.iter().find(|(description, _)| description == self) {
            return known;
        }
        let compilation = self.compiler().compile().unwrap_or_else(|report| panic!("{report}"));
        let made: &'static KernelParts = Box::leak(Box::new(compilation.parts));
        compiled.push((self.clone(), made));
        made
    }
}

/// The file of a material.
fn material(stem: &str, length_factor: f64) -> String {
    let length = match model(stem).length() {
        Length::DiffuseMeanFreePath => "diffuse_mean_free_path_mm",
        Length::MeanFreePath => "mean_free_path_mm",
    };
    let [lr, lg, lb] = MEAN_FREE_PATH_MM.map(|length| length * length_factor);
    let [ar, ag, ab] = SURFACE_ALBEDO;
    format!(
        "Material(profile: \"{stem}\", {length}: ({lr:?}, {lg:?}, {lb:?}), surface_albedo: ({ar}, {ag}, {ab}))"
    )
}

/// The profiles of the three channels of a material, in f64.
pub(crate) fn profiles(stem: &str) -> [Box<dyn RadialProfile>; 3] {
    let model = model(stem);
    Channel::ALL.map(|channel| {
        let medium = Medium::new(SURFACE_ALBEDO[channel.index()], MEAN_FREE_PATH_MM[channel.index()]);
        model.profile(medium.expect("in the domain"), channel).expect("a published model")
    })
}

/// How many taps of radii that are drawn from the widest channel stand for one of a channel's own: the mean square of
/// their weights, Σ w² / n for n taps with a mean weight of 1 (Kish 1965, "effective sample size"). The largest of the
/// channels; 1 where all are alike.
pub(crate) fn taps_for_one(stem: &str) -> f64 {
    // The middles of even strata.
    const STRATA: u32 = 2000;
    let profiles = profiles(stem);
    let reach = |profile: &dyn RadialProfile| profile.filter_radius(FILTER_QUANTILE);
    let widest =
        profiles.iter().max_by(|a, b| reach(&***a).total_cmp(&reach(&***b))).expect("three channels");
    let radii: Vec<f64> = (0..STRATA)
        .map(|i| widest.sample_radius((f64::from(i) + 0.5) / f64::from(STRATA)))
        .filter(|radius| widest.area_pdf(*radius) > 0.0)
        .collect();
    let of = |profile: &dyn RadialProfile| {
        let weights = radii.iter().map(|radius| profile.area_pdf(*radius) / widest.area_pdf(*radius));
        weights.map(|weight| weight * weight).sum::<f64>() / radii.len() as f64
    };
    profiles.iter().map(|profile| of(&**profile)).fold(1.0, f64::max)
}

/// Radius in mm that holds `quantile` of the widest channel's light.
pub(crate) fn widest_radius_mm(stem: &str, quantile: f64) -> f64 {
    profiles(stem).iter().map(|profile| profile.filter_radius(quantile)).fold(0.0, f64::max)
}

/// The device of this test program: pipelines are compiled for it once.
pub(crate) fn shared_gpu() -> &'static Gpu {
    static SHARED: LazyLock<Gpu> = LazyLock::new(Gpu::open);
    &SHARED
}

/// A pass that no test uses at the moment, with what it was made for.
type IdlePass = (Description, Path, SubsurfacePass);

/// Passes of the shared device: software drivers take seconds to compile a kernel of all profiles.
fn idle_passes() -> std::sync::MutexGuard<'static, Vec<IdlePass>> {
    static IDLE: Mutex<Vec<IdlePass>> = Mutex::new(Vec::new());
    // A test that failed meanwhile leaves a list that still holds.
    IDLE.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// A pass, and the device it runs on.
pub(crate) struct Diffuser {
    gpu: &'static Gpu,
    /// Always there until it is dropped.
    pass: Option<SubsurfacePass>,
    /// What the pass was made for, if others may use it later.
    made_for: Option<(Description, Path)>,
}

impl Drop for Diffuser {
    fn drop(&mut self) {
        // What a failed test leaves may be in any state.
        if let (Some((description, path)), Some(pass), false) =
            (self.made_for.take(), self.pass.take(), std::thread::panicking())
        {
            idle_passes().push((description, path, pass));
        }
    }
}

impl Diffuser {
    /// A pass to `Rgba32Float` without a stencil, on the shared device.
    pub(crate) fn new(description: &Description, path: Path) -> Self {
        let made_for = Some((description.clone(), path));
        let mut idle = idle_passes();
        let known = idle.iter().position(|(of, on, _)| of == description && *on == path);
        let known = known.map(|index| idle.swap_remove(index).2);
        drop(idle);
        let pass = known.unwrap_or_else(|| Self::make(description, None, path));
        Self { gpu: shared_gpu(), pass: Some(pass), made_for }
    }

    /// A pass that no test has used.
    pub(crate) fn unused(description: &Description, path: Path) -> Self {
        Self::of_pass(shared_gpu(), Self::make(description, None, path))
    }

    /// A pass of the fragment path with a stencil.
    pub(crate) fn with_stencil(description: &Description) -> Self {
        let pass = Self::make(description, Some(GBuffer::DEPTH_STENCIL_FORMAT), Path::Fragment);
        Self::of_pass(shared_gpu(), pass)
    }

    /// A pass that was made by a test.
    pub(crate) fn of_pass(gpu: &'static Gpu, pass: SubsurfacePass) -> Self {
        Self { gpu, pass: Some(pass), made_for: None }
    }

    /// A pass on the compute path that shares its work as asked.
    pub(crate) fn shaped(description: &Description, shape: ComputeShape) -> Self {
        let gpu = shared_gpu();
        let descriptor =
            SubsurfaceDescriptor { path: Some(Path::Compute), shape: Some(shape), ..descriptor() };
        let pass = SubsurfacePass::new(&gpu.device, &gpu.load(description.compile()), &descriptor);
        Self::of_pass(gpu, pass.unwrap_or_else(|error| panic!("{error}")))
    }

    fn make(description: &Description, stencil: Option<wgpu::TextureFormat>, path: Path) -> SubsurfacePass {
        let gpu = shared_gpu();
        let descriptor = SubsurfaceDescriptor { stencil, path: Some(path), ..descriptor() };
        gpu.validated(|| SubsurfacePass::new(&gpu.device, &gpu.load(description.compile()), &descriptor))
            .unwrap_or_else(|error| panic!("{error}"))
    }

    /// The pass.
    pub(crate) fn pass(&mut self) -> &mut SubsurfacePass {
        self.pass.as_mut().expect("dropped last")
    }

    /// The picture of a frame.
    pub(crate) fn diffuse(&mut self, view: &SubsurfaceView, buffers: &Buffers) -> Vec<[f32; 4]> {
        self.diffuse_with_stencil(view, buffers, None)
    }

    /// A debug view of a frame.
    pub(crate) fn show(
        &mut self,
        debug_view: DebugView,
        view: &SubsurfaceView,
        buffers: &Buffers,
    ) -> Vec<[f32; 4]> {
        let mut set = |view| self.pass().set_debug_view(view).expect("the kernel holds debug views");
        set(Some(debug_view));
        let picture = self.diffuse(view, buffers);
        self.pass().set_debug_view(None).expect("no view is always there");
        picture
    }

    /// The picture of a frame; `depth_stencil` as the pass was made.
    pub(crate) fn diffuse_with_stencil(
        &mut self,
        view: &SubsurfaceView,
        buffers: &Buffers,
        depth_stencil: Option<&wgpu::TextureView>,
    ) -> Vec<[f32; 4]> {
        let gpu = self.gpu;
        let pass = self.pass();
        gpu.validated(|| {
            let uploaded = buffers.upload(gpu);
            let mut inputs = uploaded.inputs();
            inputs.depth_stencil = depth_stencil;
            run(gpu, pass, view, &inputs)
        })
    }
}

/// What all passes of these tests write.
pub(crate) fn descriptor() -> SubsurfaceDescriptor<'static> {
    SubsurfaceDescriptor::new(wgpu::TextureFormat::Rgba32Float)
}

/// A pass over `inputs`: its output.
pub(crate) fn run(
    gpu: &Gpu,
    pass: &mut SubsurfacePass,
    view: &SubsurfaceView,
    inputs: &SubsurfaceInputs<'_>,
) -> Vec<[f32; 4]> {
    pass.bind(&gpu.device, inputs).unwrap_or_else(|error| panic!("{error}"));
    let output = pass.create_output(&gpu.device).expect("bound above");
    run_to(gpu, pass, view, &output)
}

/// A pass that is bound, to `output`: what that holds then.
pub(crate) fn run_to(
    gpu: &Gpu,
    pass: &mut SubsurfacePass,
    view: &SubsurfaceView,
    output: &Target,
) -> Vec<[f32; 4]> {
    pass.prepare(&gpu.queue, view).expect("bound before");
    gpu.submit(|encoder| pass.encode(encoder, &output.view));
    bytemuck::pod_collect_to_vec(&gpu.read_texture(&output.texture))
}

/// Peak signal-to-noise ratio of two pictures in dB, over red, green and blue; the peak is the reference's largest value.
pub(crate) fn psnr(picture: &[[f32; 4]], reference: &[[f32; 4]]) -> f64 {
    let colours = |pixel: &[f32; 4]| [pixel[0], pixel[1], pixel[2]].map(f64::from);
    let peak = reference.iter().flat_map(colours).fold(0.0, f64::max);
    let pairs = picture.iter().flat_map(colours).zip(reference.iter().flat_map(colours));
    let squares: f64 = pairs.map(|(a, b)| (a - b).powi(2)).sum();
    10.0 * (peak * peak * 3.0 * reference.len() as f64 / squares).log10()
}
