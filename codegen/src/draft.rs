//! A material on its way from its file: names are resolved, and nothing is converted yet.

use crate::material::{Coupling, DiffuseLobe, ResolvedProfile, SecondLobe, Transmittance};
use crate::schema::{DiffuseGiven, LengthGiven, Triple};
use crate::source::{Span, Spanned};

/// A material with the values of its bases filled in.
#[derive(Debug)]
pub(crate) struct Draft<'a> {
    pub(crate) name: &'a str,
    pub(crate) profile: ResolvedProfile,
    /// Where the material names its profile, when the model is written in another file.
    pub(crate) profile_name: Option<&'a Span>,
    pub(crate) length: LengthGiven,
    pub(crate) surface_albedo: Triple,
    pub(crate) surface_albedo_mix: Option<&'a Spanned<f64>>,
    /// Where the medium is given by its coefficients.
    pub(crate) refractive_index: Option<&'a Spanned<f64>>,
    pub(crate) reflectance_at_normal: Option<&'a Spanned<f64>>,
    pub(crate) roughness: Option<&'a Spanned<f64>>,
    pub(crate) coupling: Coupling,
    pub(crate) second_lobe: Option<SecondLobe>,
    pub(crate) diffuse: DiffuseLobe,
    /// Where the file chooses it.
    pub(crate) diffuse_given: Option<&'a Spanned<DiffuseGiven>>,
    pub(crate) transmission_strength: Option<&'a Spanned<f64>>,
    pub(crate) transmission_diffused: bool,
    pub(crate) transmittance: Option<&'a Spanned<Transmittance>>,
    pub(crate) thin_thickness_mm: Option<&'a Spanned<f64>>,
}
