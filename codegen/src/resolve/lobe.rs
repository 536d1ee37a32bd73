//! The diffuse lobe of a material, and what follows from it.

use subsurface_profile::single_scattering_albedo::Entry;

use super::Resolution;
use crate::diagnostics::Diagnostic;
use crate::material::{Coupling, DiffuseLobe, ResolvedProfile};
use crate::schema::{DiffuseGiven, no_entry, other_coupling};
use crate::source::{Span, Spanned};

impl Resolution {
    /// The lobe that a material has; `None` where its profile has none of this kind.
    pub(super) fn diffuse(
        &mut self,
        profile: &ResolvedProfile,
        given: Option<&Spanned<DiffuseGiven>>,
    ) -> Option<DiffuseLobe> {
        let Some(given) = given else { return Some(DiffuseLobe::of_model(&profile.model)) };
        let entry = match given.value {
            DiffuseGiven::Lobe(lobe) => return Some(lobe),
            DiffuseGiven::Coupled => return Some(DiffuseLobe::Lambert),
            DiffuseGiven::Chandrasekhar(entry) => entry.or_else(|| profile.model.entry()),
        };
        if entry.is_none() {
            self.diagnostics.push(no_entry(given));
        }
        entry.map(DiffuseLobe::Chandrasekhar)
    }

    /// The coupling that a material has; some lobes are what they are under one alone.
    pub(super) fn coupling(
        &mut self,
        lobe: Option<&Spanned<DiffuseGiven>>,
        given: Option<Coupling>,
    ) -> Option<Coupling> {
        let Some(lobe) = lobe else { return Some(given.unwrap_or_default()) };
        let (needed, remedy) = match lobe.value {
            DiffuseGiven::Coupled => (Coupling::Full, "write `diffuse: Lambert`, or leave `coupling` out"),
            DiffuseGiven::Lobe(DiffuseLobe::Shirley) => {
                (Coupling::None, "leave `coupling` out: the lobe knows of the mirror above it")
            }
            _ => return Some(given.unwrap_or_default()),
        };
        if given.is_some_and(|given| given != needed) {
            self.diagnostics.push(other_coupling(lobe, needed.name(), remedy));
            return None;
        }
        Some(needed)
    }

    /// How the light enters that the surface albedo of a medium is for; a guess is a warning.
    pub(super) fn entry(&mut self, profile: &ResolvedProfile, diffuse: DiffuseLobe, medium: &Span) -> Entry {
        let of_lobe = match diffuse {
            DiffuseLobe::Chandrasekhar(entry) => Some(entry),
            _ => None,
        };
        let known = of_lobe.or_else(|| profile.model.entry());
        if known.is_none() {
            self.diagnostics.push(
                Diagnostic::warning("the surface albedo of this medium is taken for perpendicular entry")
                    .label(medium.clone(), "the profile does not say how light enters")
                    .help("write `diffuse: Chandrasekhar(entry: Searchlight)`, or `entry: Diffuse` if it is for light from everywhere"),
            );
        }
        known.unwrap_or(Entry::Searchlight)
    }
}
