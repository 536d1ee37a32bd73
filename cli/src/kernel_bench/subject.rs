//! The material that the contenders diffuse with.

use crate::failure::Failure;
use std::path::{Path, PathBuf};
use subsurface_codegen::{Compilation, Compiler, Estimator, Material, OutputFormat, Report};
use subsurface_kernel::constants::FILTER_QUANTILE;
use subsurface_profile::{Channel, Medium, RadialProfile};

/// A material, its profile, and how to compile it with any kernel.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The profile's name in tables and files.
    pub name: String,
    compiler: Compiler,
    number: u32,
    /// Whether the set holds nothing else.
    is_alone: bool,
    material: Material,
}

/// Radii that stand for a profile: the mean of so many quantiles is the mean radius to four digits.
const QUANTILES: u32 = 4096;

impl Subject {
    /// Material `number` of a set as its files have it.
    ///
    /// # Errors
    /// A number that the set does not have.
    pub fn of_set(compiler: Compiler, materials: &Compilation, number: u32) -> Result<Self, Failure> {
        let Some(material) = materials.set.materials.get(number as usize).cloned() else {
            return Err(Failure::new(
                format!("the set has no material {number}"),
                "choose another --material",
            ));
        };
        let name = material.profile.stem.clone().unwrap_or_else(|| material.name.clone());
        Ok(Self { name, compiler, number, is_alone: false, material })
    }

    /// The same material with the profile `stem` of the set's files, alone in a set: its kernel knows no other model.
    ///
    /// # Errors
    /// A file that cannot be read, or a profile that does not suit the material.
    pub fn with_profile(
        &self,
        materials: &Compilation,
        directory: &Path,
        stem: &str,
    ) -> Result<Self, Failure> {
        let mut files = Vec::new();
        for path in &materials.files_read {
            let inside = path.strip_prefix(directory).unwrap_or(path);
            // The set's own file, if it has one, and the profiles.
            let is_material = inside.components().count() == 1 && is_material(path)?;
            if !is_material {
                files.push((inside.to_owned(), read(path)?));
            }
        }
        let own = Path::new("profiles").join(stem).with_extension("ron");
        if !files.iter().any(|(path, _)| *path == own) && directory.join(&own).is_file() {
            files.push((own.clone(), read(&directory.join(&own))?));
        }
        let triple = |[r, g, b]: [f64; 3]| format!("({r:?}, {g:?}, {b:?})");
        let text = format!(
            "Material(profile: \"{stem}\", mean_free_path_mm: {}, surface_albedo: {})\n",
            triple(self.material.mean_free_path_mm),
            triple(self.material.surface_albedo)
        );
        let path = PathBuf::from(&self.material.name).with_extension("ron");
        files.push((path, text.into_bytes()));
        let compiler = Compiler::from_memory(files);
        let compiled = compiler.compile().map_err(|report| failure(&report))?;
        let subject = Self::of_set(compiler, &compiled, 0)?;
        Ok(Self { name: stem.to_owned(), is_alone: true, ..subject })
    }

    /// The material set with a kernel and an output of `format`.
    pub fn compile(&self, kernel: Estimator, format: OutputFormat) -> Result<Compilation, Failure> {
        let compiler = self.compiler.clone().without_gbuffer().estimator(kernel).output_format(format);
        compiler.compile().map_err(|report| failure(&report))
    }

    /// The material.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Number of the material in its set.
    pub fn number(&self) -> u32 {
        self.number
    }

    /// The number if the set has no other.
    pub(super) fn only_number(&self) -> Option<u32> {
        self.is_alone.then_some(self.number)
    }

    /// The profile of a channel at the material's own surface albedo; `None` for numbers that make none, which the
    /// compiler refuses before.
    pub fn profile(&self, channel: Channel) -> Option<Box<dyn RadialProfile>> {
        let index = channel.index();
        let medium =
            Medium::new(self.material.surface_albedo[index], self.material.mean_free_path_mm[index]).ok()?;
        self.material.profile.model.profile(medium, channel).ok()
    }

    /// Taps of a budget that a kernel takes where a pixel spans `millimetres`: a quarter of the pixels within the filter
    /// radius, as the shaders have it.
    pub(super) fn taps_within(&self, millimetres: f64, budget: u32) -> u32 {
        let radius = |profile: Box<dyn RadialProfile>| profile.sample_radius(FILTER_QUANTILE);
        let widest_mm = Channel::ALL
            .into_iter()
            .filter_map(|channel| self.profile(channel))
            .map(radius)
            .fold(0.0, f64::max);
        let taps = std::f64::consts::FRAC_PI_4 * (widest_mm / millimetres).powi(2);
        // A cast saturates, and makes 0 of NaN: no translucent pixel.
        (taps.ceil() as u32).min(budget)
    }

    /// Mean radius ∫ r 2πr R dr / A of the widest channel, mm.
    pub fn mean_radius_mm(&self) -> f64 {
        let mean = |profile: Box<dyn RadialProfile>| {
            let radius = |index| profile.sample_radius((f64::from(index) + 0.5) / f64::from(QUANTILES));
            (0..QUANTILES).map(radius).sum::<f64>() / f64::from(QUANTILES)
        };
        Channel::ALL.into_iter().filter_map(|channel| self.profile(channel)).map(mean).fold(0.0, f64::max)
    }
}

/// Whether a file declares a material, by its first word that is no comment.
fn is_material(path: &Path) -> Result<bool, Failure> {
    let text = read(path)?;
    let text = String::from_utf8_lossy(&text);
    let code = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with("//"));
    Ok(code.is_some_and(|code| code.trim_end_matches('(') == "Material" || code.starts_with("Material(")))
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|reason| {
        let message = format!("cannot read {}: {reason}", path.display());
        Failure::new(message, "the file changed meanwhile: try again")
    })
}

fn failure(report: &Report) -> Failure {
    Failure::reported(report.render(false))
}
