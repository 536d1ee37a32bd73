//! `subsurface diffuse`.

use super::kernel::KernelArguments;
use super::{material_set, number};
use crate::draw::{self, Buffers, PixelScale};
use crate::failure::Failure;
use crate::picture::exr::{self, Channels};
use crate::picture::{PictureError, file};
use crate::progress::Spinner;
use crate::say;
use crate::scene::camera::Size;
use clap::Args;
use std::path::{Path, PathBuf};
use subsurface_codegen::OutputFormat;

/// Arguments of `subsurface diffuse`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface diffuse --materials materials --material skin --input in.exr --out out.exr --mm-per-pixel 0.2
  subsurface diffuse --material marble --input in.exr --out out.exr --fov-y-degrees 24 --kernel importance-sampled:64
  subsurface diffuse --material skin --input in.exr --out out.exr --mm-per-pixel 0.2 --kernel dense
  subsurface diffuse --material skin --input in.exr --out out.exr --mm-per-pixel 0.2 \\
      --mean-free-path-scale scale.exr
  subsurface diffuse --material skin --input in.exr --out out.exr --mm-per-pixel 0.2 --albedo-mix 0.5")]
pub struct DiffuseArguments {
    /// Directory of materials: one .ron file each, profiles in DIR/profiles.
    #[arg(long, value_name = "DIR", default_value = material_set::DEFAULT_DIRECTORY)]
    pub materials: PathBuf,
    /// Material of the set.
    #[arg(long, value_name = "NAME")]
    pub material: String,
    /// The buffers.
    #[arg(long, value_name = "IN.exr")]
    pub input: PathBuf,
    /// The diffused irradiance.
    #[arg(long, value_name = "OUT.exr")]
    pub out: PathBuf,
    /// How large a pixel is.
    #[command(flatten)]
    pub scale: ScaleArguments,
    /// Factor on the mean free path per pixel: the channel Y, or R if there is none, of a file as large as the buffers.
    #[arg(long, value_name = "FILE.exr")]
    pub mean_free_path_scale: Option<PathBuf>,
    /// Power of the surface albedo that the irradiance is multiplied by first: 0 takes it as it is, 1 blurs the texture as
    /// the light. Multiply what comes out by the rest, surface albedo to the power of 1 - X. A
    /// material's own `surface_albedo_mix` is for the G-buffer, which `render --aov` writes: there it is in the irradiance.
    #[arg(long, value_name = "X", default_value_t = 0.0, value_parser = number::albedo_mix, allow_hyphen_values = true)]
    pub albedo_mix: f32,
    /// Which kernel diffuses.
    #[command(flatten)]
    pub kernel: KernelArguments,
    /// Number of the frame in a sequence that is averaged over time: another frame gives other noise. 0 is a still
    /// picture.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub frame_index: u32,
}

/// How large a pixel is: exactly one of the two.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
pub struct ScaleArguments {
    /// Orthographic view: millimetres that a pixel covers.
    #[arg(long, value_name = "X", value_parser = number::pixel_mm, allow_hyphen_values = true)]
    pub mm_per_pixel: Option<f32>,
    /// Perspective view: vertical field of view in degrees; a pixel then covers more where Z is larger.
    #[arg(long, value_name = "D", value_parser = number::fov_y_degrees, allow_hyphen_values = true)]
    pub fov_y_degrees: Option<f32>,
}

impl ScaleArguments {
    fn scale(&self) -> Result<PixelScale, Failure> {
        match (self.mm_per_pixel, self.fov_y_degrees) {
            (Some(mm), _) => Ok(PixelScale::MillimetresPerPixel(mm)),
            (None, Some(degrees)) => Ok(PixelScale::FovYDegrees(degrees)),
            // clap has refused this already.
            (None, None) => {
                Err(Failure::new("the scale is missing", "give --mm-per-pixel or --fov-y-degrees"))
            }
        }
    }
}

/// Runs the command.
pub fn run(arguments: &DiffuseArguments) -> Result<(), Failure> {
    file::folder_of(&arguments.out)?;
    let scale = arguments.scale.scale()?;
    let compiler = material_set::compiler(&arguments.materials)?.output_format(OutputFormat::Rgba32Float);
    let materials = arguments.kernel.compile(&compiler)?;
    let material = material_set::number(&materials, &arguments.material)?;
    let mut buffers = read(&arguments.input, material, materials.set.materials.len())?;
    if let Some(path) = &arguments.mean_free_path_scale {
        buffers.mean_free_path_scale = Some(read_scale(path, buffers.size)?);
    }
    if arguments.albedo_mix > 0.0 {
        let of_materials = materials.set.materials.iter().map(|material| material.surface_albedo);
        buffers.mix_albedo(arguments.albedo_mix, &of_materials.collect::<Vec<_>>());
    }
    let picture = {
        let _spinner = Spinner::new("diffusing");
        draw::diffuse(&buffers, &materials, scale, arguments.kernel.route.chosen(), arguments.frame_index)?
    };
    exr::write_exr(&arguments.out, &picture)?;
    say!("{}", arguments.out.display());
    Ok(())
}

/// Reads and checks the buffers; `material` where the file does not say which, of `material_count`.
pub fn read(path: &Path, material: u32, material_count: usize) -> Result<Buffers, PictureError> {
    let _spinner = Spinner::new(format!("reading {}", path.display()));
    let channels = Channels::read(path)?;
    let size = channels.size("irradiance.R")?;
    let irradiance = channels.colours("irradiance", size)?;
    // Nothing in front of the camera: 0, infinite, or a renderer's "very far" is for the kernel's falloff to handle.
    let depth_mm: Vec<f32> =
        channels.samples("Z", size)?.into_iter().map(|z| if z == f32::INFINITY { 0.0 } else { z }).collect();
    let surface_albedo =
        if channels.has("albedo.R") { Some(channels.colours("albedo", size)?) } else { None };
    let numbers = if channels.has("material") { Some(channels.samples("material", size)?) } else { None };

    let check = Checker { path, size };
    check.every("Z", &depth_mm, |z| if z.is_finite() && *z >= 0.0 { None } else { Some(format!("{z}")) })?;
    let on_surface = |pixel: usize| depth_mm[pixel] > 0.0;
    for (pixel, colour) in irradiance.iter().enumerate().filter(|(pixel, _)| on_surface(*pixel)) {
        if !colour.iter().all(|value| value.is_finite() && *value >= 0.0) {
            return Err(check.bad("irradiance", pixel, format!("{colour:?}")));
        }
    }
    for (pixel, colour) in surface_albedo.iter().flatten().enumerate().filter(|(pixel, _)| on_surface(*pixel))
    {
        if !colour.iter().all(|value| (0.0..=1.0).contains(value)) {
            return Err(check.bad("albedo", pixel, format!("{colour:?}, outside [0, 1],")));
        }
    }
    let numbers = numbers.unwrap_or_else(|| vec![material as f32; size.pixels()]);
    let mut material = Vec::with_capacity(numbers.len());
    for (pixel, number) in numbers.into_iter().enumerate() {
        let known = number >= 0.0 && number.fract() == 0.0 && (number as usize) < material_count;
        if !known && on_surface(pixel) {
            return Err(check.bad("material", pixel, format!("{number}, not in 0..{material_count},")));
        }
        material.push(if known { number as u32 } else { 0 });
    }
    Ok(Buffers { size, irradiance, depth_mm, surface_albedo, material, mean_free_path_scale: None })
}

/// Reads and checks factors on the mean free path.
fn read_scale(path: &Path, size: Size) -> Result<Vec<f32>, PictureError> {
    let channels = Channels::read(path)?;
    let name = if channels.has("Y") { "Y" } else { "R" };
    let scale = channels.samples(name, size)?;
    let check = Checker { path, size };
    let wrong = |factor: &f32| (!(factor.is_finite() && *factor >= 0.0)).then(|| format!("{factor}"));
    check.every(name, &scale, wrong)?;
    Ok(scale)
}

/// Names the pixel that is wrong.
struct Checker<'a> {
    path: &'a Path,
    size: Size,
}

impl Checker<'_> {
    fn every<T>(
        &self,
        channel: &str,
        values: &[T],
        wrong: impl Fn(&T) -> Option<String>,
    ) -> Result<(), PictureError> {
        match values.iter().enumerate().find_map(|(pixel, value)| wrong(value).map(|what| (pixel, what))) {
            Some((pixel, what)) => Err(self.bad(channel, pixel, what)),
            None => Ok(()),
        }
    }

    fn bad(&self, channel: &str, pixel: usize, what: String) -> PictureError {
        let width = self.size.width as usize;
        PictureError::BadValue {
            file: self.path.to_owned(),
            channel: channel.to_owned(),
            what,
            x: pixel % width,
            y: pixel / width,
        }
    }
}
