//! Pictures against a path tracer's: every profile model, and every cause of error that can be taken away.

mod truths;
mod variant;

pub use truths::{TruthCase, read};
pub use variant::Variant;

use crate::draw::{Frame, Needs, Route, Shown, Studio};
use crate::failure::Failure;
use crate::picture::LinearPicture;
use crate::picture::comparison::{Comparison, compare};
use crate::scene::Scene;
use std::path::{Path, PathBuf};
use subsurface_codegen::{Compilation, Compiler, Estimator};

/// Pixels drawn per pixel of a truth, along each side.
const SUPERSAMPLING: u32 = 4;

/// Texels per side of finer shadow maps.
const FINE_SHADOWS: u32 = 4096;

/// A kernel, and whether shadow maps are finer.
type Kind = (Option<Estimator>, bool);

/// Draws variants of the materials of a folder.
#[derive(Debug)]
pub struct Bench {
    files: Vec<(PathBuf, Vec<u8>)>,
    /// A studio of each kind, opened when first needed.
    studios: Vec<(Kind, Studio, Compilation)>,
    variants: Vec<(String, Variant)>,
}

impl Bench {
    /// Takes the materials of `folder`, and all variants of those named `materials`.
    pub fn new(folder: &Path, materials: &[String], variants: &[Variant]) -> Result<Self, Failure> {
        let read = |path: &Path| {
            std::fs::read(path).map_err(|reason| {
                Failure::new(format!("cannot read {}: {reason}", path.display()), "name another --materials")
            })
        };
        let compiled = Compiler::new(folder).compile();
        let compiled = compiled.map_err(|report| Failure::reported(report.render(false)))?;
        let mut files = Vec::new();
        for path in &compiled.files_read {
            files.push((path.strip_prefix(folder).unwrap_or(path).to_owned(), read(path)?));
        }
        let mut all = Vec::new();
        for material in materials {
            for variant in variants {
                let name = name(material, all.len());
                let text = format!("Material(base: \"{material}\", {})\n", variant.fields);
                files.push((Path::new(&name).with_extension("ron"), text.into_bytes()));
                all.push((material.clone(), variant.clone()));
            }
        }
        Ok(Self { files, studios: Vec::new(), variants: all })
    }

    /// Draws a truth's scene with a variant of its material.
    pub fn draw(
        &mut self,
        case: &TruthCase,
        scene: &Scene,
        variant: &Variant,
    ) -> Result<LinearPicture, Failure> {
        let place = self.variants.iter().position(|(name, own)| *name == case.material && own == variant);
        let Some(place) = place else {
            return Err(Failure::new("no such variant", "please report this as a defect"));
        };
        let (_, studio, materials) = self.studio((variant.estimator, variant.has_fine_shadows))?;
        let number = materials.set.index_of(&name(&case.material, place)).unwrap_or_default() as u32;
        let lights = case.scene.view.lights();
        let environment = case.scene.view.environment()?;
        let drawn = studio.draw(&Frame {
            scene,
            material_of_object: &vec![number; scene.objects.len()],
            camera: case.scene.view.camera(scene, case.scene.size)?,
            lights: &lights,
            ambient_intensity: case.scene.view.ambient,
            environment: environment.as_ref(),
            size: case.scene.size,
            supersampling: SUPERSAMPLING,
            shown: if variant.scatters { Shown::Subsurface } else { Shown::Surface },
            wants_aovs: false,
            wants_timings: false,
        })?;
        Ok(drawn.linear)
    }

    /// How far a variant's picture is from the truth.
    pub fn measure(
        &mut self,
        case: &TruthCase,
        scene: &Scene,
        variant: &Variant,
    ) -> Result<Comparison, Failure> {
        let picture = self.draw(case, scene, variant)?;
        compare(&picture, &case.truth, 1.0).ok_or_else(|| {
            Failure::new(format!("{}: no pixel counts", case.name), "the truth is black: render it again")
        })
    }

    fn studio(&mut self, kind: Kind) -> Result<&mut (Kind, Studio, Compilation), Failure> {
        let place = match self.studios.iter().position(|(own, ..)| *own == kind) {
            Some(place) => place,
            None => {
                let compiler = Compiler::from_memory(self.files.clone());
                let (estimator, has_fine_shadows) = kind;
                let compiler = estimator.map_or(compiler.clone(), |estimator| compiler.estimator(estimator));
                let compiled = compiler.compile();
                let compiled = compiled.map_err(|report| Failure::reported(report.render(false)))?;
                let shadow_map_size = has_fine_shadows.then_some(FINE_SHADOWS);
                let needs = Needs { shadow_map_size, ..Needs::default() };
                let studio = Studio::open(&compiled, Route::default(), needs)?;
                self.studios.push((kind, studio, compiled));
                self.studios.len() - 1
            }
        };
        Ok(&mut self.studios[place])
    }
}

/// Name of a variant; unlikely to be taken.
fn name(material: &str, place: usize) -> String {
    format!("{material}_variant_{place}")
}
