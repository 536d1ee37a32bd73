//! `--light`, as often as a frame holds lights.

use crate::scene::camera::Light;
use clap::error::ErrorKind;
use clap::{ArgMatches, Args, Command, FromArgMatches};
use subsurface_runtime::LIGHT_CAPACITY;

/// The lights of a command: at most [`LIGHT_CAPACITY`]; none means [`Light::DEFAULT`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lights(pub Vec<Light>);

#[derive(Debug, Args)]
struct LightArguments {
    /// A directional light: the way in which it travels, from the light to the scene, and its irradiance (default 1).
    /// May be given up to four times; by default a key light and a rim light from behind.
    #[arg(long = "light", value_name = "dx,dy,dz[,intensity]", allow_hyphen_values = true)]
    given: Vec<Light>,
}

// The help text says it in words.
const _: () = assert!(LIGHT_CAPACITY == 4);

/// clap counts the values of one occurrence, not the occurrences, so that is done here.
impl FromArgMatches for Lights {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let LightArguments { given } = LightArguments::from_arg_matches(matches)?;
        if given.len() > LIGHT_CAPACITY {
            let message =
                format!("--light is given {} times, and a frame holds {LIGHT_CAPACITY} lights", given.len());
            return Err(clap::Error::raw(ErrorKind::TooManyValues, message));
        }
        Ok(Self(given))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Args for Lights {
    fn augment_args(command: Command) -> Command {
        LightArguments::augment_args(command)
    }

    fn augment_args_for_update(command: Command) -> Command {
        LightArguments::augment_args_for_update(command)
    }
}
