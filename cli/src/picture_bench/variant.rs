//! What a picture is drawn with.

use subsurface_codegen::Estimator;
use subsurface_profile::{Length, ModelKind, PublishedSet};

/// A material that has all but some fields of the truth's, and a kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// What it is called in tables.
    pub label: String,
    /// The fields that it has instead.
    pub fields: String,
    /// The kernel; `None` for the set's own.
    pub estimator: Option<Estimator>,
    /// Whether shadow maps have four times as many texels.
    pub has_fine_shadows: bool,
    /// Whether light goes below the surface.
    pub scatters: bool,
}

impl Variant {
    fn new(label: &str, fields: &str) -> Self {
        Self {
            label: label.to_owned(),
            fields: fields.to_owned(),
            estimator: None,
            has_fine_shadows: false,
            scatters: true,
        }
    }

    /// The truth's own material.
    pub fn own() -> Self {
        Self::new("as is", "")
    }

    /// Light that stays where it arrives.
    pub fn surface() -> Self {
        Self { scatters: false, ..Self::new("no subsurface", "") }
    }

    /// Each published profile of an index-matched medium that is scaled by the mean free path.
    pub fn models() -> Vec<Self> {
        let sets = ModelKind::ALL.iter().flat_map(|kind| kind.published());
        // The truths' materials give the mean free path.
        let is_alike = |set: &PublishedSet| set.entry.is_some() && set.model.length() == Length::MeanFreePath;
        let matched = sets.filter(is_alike);
        matched.map(|set| Self::new(set.stem, &format!("profile: \"{}\"", set.stem))).collect()
    }

    /// One cause of error replaced by another at a time.
    pub fn causes() -> Vec<Self> {
        vec![
            Self::own(),
            Self { estimator: Some(Estimator::Dense), ..Self::new("every pixel summed", "") },
            Self { has_fine_shadows: true, ..Self::new("finer shadow maps", "") },
            Self::new("Lambert's angles", "diffuse: Lambert"),
            Self::new("diffused through", "transmission: (diffused: true)"),
            Self::new("profile's transmittance", "transmittance: Profile"),
            Self::new("nothing through", "transmission_strength: 0.0"),
            Self::surface(),
        ]
    }
}
