//! Burley's coefficients of a subject.

use crate::uniform_subject;
use subsurface_cli::kernel_bench::{Stage, Subject};
use subsurface_profile::{Medium, Model};

/// Burley's d per channel, mm, or why a method for one Burley profile per object does not suit the stage.
pub(crate) fn scattering_distance_mm(stage: &Stage<'_>) -> Result<[f64; 3], String> {
    let d = own(stage.subject).ok_or("knows Burley's profile alone")?;
    uniform_subject::check(stage)?;
    Ok(d)
}

fn own(subject: &Subject) -> Option<[f64; 3]> {
    let material = subject.material();
    let Model::Burley(model) = &material.profile.model else { return None };
    let mut d = [0.0; 3];
    for (channel, d) in d.iter_mut().enumerate() {
        let medium =
            Medium::new(material.surface_albedo[channel], material.mean_free_path_mm[channel]).ok()?;
        *d = model.profile(medium).ok()?.scattering_distance_mm();
    }
    Some(d)
}
