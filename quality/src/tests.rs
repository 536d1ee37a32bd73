//! What the tests share: materials, and how far a kernel is from the exact result.

mod pictures;
mod profiles;
mod searches;
mod twins;

use crate::gather::gathered::Rgb;
use crate::gather::point::Point;
use crate::optics::Optics;
use crate::pictures::case::{Case, Deviation};
use crate::pictures::patch::Patch;
use crate::pictures::reference;
use crate::pictures::scene::Scene;
use crate::{Device, Material, Quality, QualityReport, search};
use subsurface_kernel::{Estimator, Rejection};
use subsurface_profile::Model;

/// A material with a model of its own.
#[derive(Clone, Debug)]
struct Sample {
    model: Model,
    mean_free_path_mm: [f64; 3],
    surface_albedo: [f64; 3],
}

fn published(stem: &str, mean_free_path_mm: [f64; 3], surface_albedo: [f64; 3]) -> Sample {
    Sample { model: Model::published(stem).expect("it is published"), mean_free_path_mm, surface_albedo }
}

fn sample(mean_free_path_mm: [f64; 3], surface_albedo: [f64; 3]) -> Sample {
    published("two_exponential_dipole_searchlight", mean_free_path_mm, surface_albedo)
}

fn skin() -> Sample {
    sample([1.30, 0.95, 0.67], [0.83, 0.64, 0.55])
}

fn materials(samples: &[Sample]) -> Vec<Material<'_>> {
    samples
        .iter()
        .map(|Sample { model, mean_free_path_mm, surface_albedo }| Material {
            model,
            mean_free_path_mm: *mean_free_path_mm,
            surface_albedo: *surface_albedo,
        })
        .collect()
}

fn optics_of(samples: &[Sample]) -> Vec<Optics> {
    Optics::of_all(&materials(samples)).expect("every material has a profile")
}

fn solved(samples: &[Sample], quality: Quality, kind: Option<Estimator>) -> QualityReport {
    search(&materials(samples), Rejection::default(), quality, kind, Device::default())
        .expect("a kernel within the error")
}

/// The exact result where every pixel shows a surface.
fn expected(point: &Point<'_>, scene: Scene, patches: &[Patch]) -> Vec<Rgb> {
    let pixels = reference::expected(point, scene, patches).into_iter();
    pixels.map(|pixel| pixel.expect("it shows a surface")).collect()
}

/// Over all cases.
fn deviation(cases: &mut [Case<'_>], kernel: Estimator) -> Deviation {
    let deviations = cases.iter_mut().map(|case| case.deviation(kernel).expect("it has a twin"));
    deviations.fold(Deviation::default(), Deviation::and)
}
