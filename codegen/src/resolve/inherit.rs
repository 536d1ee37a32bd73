//! What a material takes from its bases.

use std::collections::{BTreeMap, BTreeSet};

use super::Resolution;
use crate::material::{Coupling, SecondLobe, Transmittance};
use crate::schema::{DiffuseGiven, Given, LengthGiven, MaterialFile, OrMedium, ProfileExpression, Triple};
use crate::source::{Span, Spanned};

/// The fields of a material, its own or those of its nearest base that gives them.
#[derive(Clone, Copy)]
pub(super) struct Inherited<'a> {
    pub(super) profile: &'a Given<(ProfileExpression, Span)>,
    pub(super) length: &'a Given<OrMedium<LengthGiven>>,
    pub(super) surface_albedo: &'a Given<OrMedium<Triple>>,
    pub(super) surface_albedo_mix: &'a Given<Spanned<f64>>,
    pub(super) refractive_index: &'a Given<Spanned<f64>>,
    pub(super) reflectance_at_normal: &'a Given<Spanned<f64>>,
    pub(super) roughness: &'a Given<Spanned<f64>>,
    pub(super) coupling: &'a Given<Coupling>,
    pub(super) second_lobe: &'a Given<Option<SecondLobe>>,
    pub(super) diffuse: &'a Given<Spanned<DiffuseGiven>>,
    pub(super) transmission_strength: &'a Given<Spanned<f64>>,
    pub(super) transmission_diffused: &'a Given<bool>,
    pub(super) transmittance: &'a Given<Spanned<Transmittance>>,
    pub(super) thin_thickness_mm: &'a Given<Spanned<f64>>,
    /// Whether every base exists.
    pub(super) complete: bool,
}

impl Resolution {
    /// The fields of a material and of its bases.
    pub(super) fn inherit<'a>(
        &mut self,
        by_name: &BTreeMap<&str, &'a MaterialFile>,
        material: &'a MaterialFile,
    ) -> Inherited<'a> {
        fn first<'a, T>(own: &'a Given<T>, base: &'a Given<T>) -> &'a Given<T> {
            if own.is_absent() { base } else { own }
        }
        let mut inherited = Inherited {
            profile: &material.profile,
            length: &material.length,
            surface_albedo: &material.surface_albedo,
            surface_albedo_mix: &material.surface_albedo_mix,
            refractive_index: &material.refractive_index,
            reflectance_at_normal: &material.reflectance_at_normal,
            roughness: &material.roughness,
            coupling: &material.coupling,
            second_lobe: &material.second_lobe,
            diffuse: &material.diffuse,
            transmission_strength: &material.transmission_strength,
            transmission_diffused: &material.transmission_diffused,
            transmittance: &material.transmittance,
            thin_thickness_mm: &material.thin_thickness_mm,
            complete: true,
        };
        let mut seen = BTreeSet::from([material.file]);
        let mut current = material;
        loop {
            let base = match &current.base {
                Given::Absent => return inherited,
                Given::Bad => break,
                Given::Value(base) => base,
            };
            let Some(next) = by_name.get(base.value.as_str()) else { break };
            if !seen.insert(next.file) {
                break;
            }
            self.depends(material.file, next.file);
            inherited = Inherited {
                profile: first(inherited.profile, &next.profile),
                length: first(inherited.length, &next.length),
                surface_albedo: first(inherited.surface_albedo, &next.surface_albedo),
                surface_albedo_mix: first(inherited.surface_albedo_mix, &next.surface_albedo_mix),
                refractive_index: first(inherited.refractive_index, &next.refractive_index),
                reflectance_at_normal: first(inherited.reflectance_at_normal, &next.reflectance_at_normal),
                roughness: first(inherited.roughness, &next.roughness),
                coupling: first(inherited.coupling, &next.coupling),
                second_lobe: first(inherited.second_lobe, &next.second_lobe),
                diffuse: first(inherited.diffuse, &next.diffuse),
                transmission_strength: first(inherited.transmission_strength, &next.transmission_strength),
                transmission_diffused: first(inherited.transmission_diffused, &next.transmission_diffused),
                transmittance: first(inherited.transmittance, &next.transmittance),
                thin_thickness_mm: first(inherited.thin_thickness_mm, &next.thin_thickness_mm),
                complete: true,
            };
            current = next;
        }
        inherited.complete = false;
        inherited
    }
}
