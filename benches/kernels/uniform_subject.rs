//! Stages for methods that know one profile per object.

use subsurface_cli::kernel_bench::Stage;
use subsurface_profile::{Channel, RadialProfile};

/// The profile of each channel, or why a method for one profile per object does not suit the stage.
pub(crate) fn profiles(stage: &Stage<'_>) -> Result<[Box<dyn RadialProfile>; 3], String> {
    check(stage)?;
    let [Some(red), Some(green), Some(blue)] = Channel::ALL.map(|channel| stage.subject.profile(channel))
    else {
        return Err("there is no profile at this surface albedo".to_owned());
    };
    Ok([red, green, blue])
}

/// Says so where a stage has more than one surface albedo.
pub(crate) fn check(stage: &Stage<'_>) -> Result<(), String> {
    if stage.case.is_uniform(stage.subject) {
        return Ok(());
    }
    Err("knows one surface albedo per object: see --uniform-albedo".to_owned())
}

/// Radius that holds `quantile` of the widest profile's energy, mm.
pub(crate) fn widest_radius_mm(profiles: &[Box<dyn RadialProfile>; 3], quantile: f64) -> f64 {
    profiles.iter().map(|profile| profile.sample_radius(quantile)).fold(0.0, f64::max)
}
