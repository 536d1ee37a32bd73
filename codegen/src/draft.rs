//! A material on its way from its file: names are resolved, and nothing is converted yet.

use crate::material::{Coupling, DiffuseLobe, ResolvedProfile, Transmittance};
use crate::schema::{LengthGiven, Triple};
use crate::source::{Span, Spanned};

/// A material with the values of its bases filled in.
#[derive(Debug)]
pub(crate) struct Draft<'a> {
    pub(crate) name: &'a str,
    pub(crate) profile: ResolvedProfile,
    /// Where the material names its profile, when the model is written in another file.
    pub(crate) profile_name: Option<&'a Span>,
    pub(crate) length: &'a LengthGiven,
    pub(crate) surface_albedo: &'a Triple,
    pub(crate) reflectance_at_normal: Option<&'a Spanned<f64>>,
    pub(crate) roughness: Option<&'a Spanned<f64>>,
    pub(crate) coupling: Option<Coupling>,
    pub(crate) diffuse: DiffuseLobe,
    pub(crate) transmission_strength: Option<&'a Spanned<f64>>,
    pub(crate) transmittance: Option<&'a Spanned<Transmittance>>,
    pub(crate) thin_thickness_mm: Option<&'a Spanned<f64>>,
}
