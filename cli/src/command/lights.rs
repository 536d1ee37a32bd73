//! `--light`, `--point` and `--spot`.

use crate::scene::light::{DirectionalLight, Light, PointLight, SpotLight};
use clap::Args;

/// The lights of a command; none means [`Light::DEFAULT`].
#[derive(Clone, Debug, Default, PartialEq, Args)]
pub struct LightArguments {
    /// A directional light: the way in which it travels, from the light to the scene, its irradiance (default 1), and the
    /// angle that it spans in the sky (default 0; the sun has 0.53), by which its shadows are soft.
    ///
    /// Lights may be given any number of times; the four that matter most cast shadows and shine through what is thin. By
    /// default there are a key light and a rim light from behind. `--light 0,-1,0,0` alone is no light.
    #[arg(long = "light", value_name = "dx,dy,dz[,intensity[,degrees]]", allow_hyphen_values = true)]
    pub directional: Vec<DirectionalLight>,
    /// A lamp: where it stands in metres, its irradiance at the distance of a metre (default 1), and its radius in mm
    /// (default 0), by which its shadows are soft.
    #[arg(long = "point", value_name = "x,y,z[,intensity[,radius_mm]]", allow_hyphen_values = true)]
    pub points: Vec<PointLight>,
    /// A lamp that shines into a cone: where it stands, the axis away from it, the cone's full angle in degrees, of which
    /// the outer tenth falls off, and the rest as of --point.
    #[arg(
        long = "spot",
        value_name = "x,y,z,dx,dy,dz,degrees[,intensity[,radius_mm]]",
        allow_hyphen_values = true
    )]
    pub spots: Vec<SpotLight>,
}

impl LightArguments {
    /// The lights, or the default ones.
    pub fn lights(&self) -> Vec<Light> {
        let directional = self.directional.iter().copied().map(Light::Directional);
        let points = self.points.iter().copied().map(Light::Point);
        let spots = self.spots.iter().copied().map(Light::Spot);
        let given: Vec<Light> = directional.chain(points).chain(spots).collect();
        if given.is_empty() { Light::DEFAULT.to_vec() } else { given }
    }
}
