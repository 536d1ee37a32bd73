//! What a picture does not have of its lights.

use super::Bounds;
use super::light::Light;
use crate::failure::Explain;
use glam::Vec3;
use std::fmt;
use subsurface_runtime::SHADOW_MAPS;

/// What a picture does not have of its lights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LightWarning {
    /// More lights shine than have a shadow map.
    NoShadow {
        /// How many have none.
        lights: usize,
    },
    /// A lamp stands among what it lights, and its map sees a part of that.
    Within {
        /// Which lamp, as it was given.
        position: String,
    },
}

impl fmt::Display for LightWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoShadow { lights } => write!(
                f,
                "{SHADOW_MAPS} lights cast shadows and shine through what is thin; {lights} of these do neither"
            ),
            Self::Within { position } => write!(
                f,
                "the lamp at {position} stands within the scene: what is more than 75° off the way to the scene's middle is \
                 lit as if nothing were before it"
            ),
        }
    }
}

impl Explain for LightWarning {
    fn help(&self) -> Option<String> {
        Some(
            match self {
                Self::NoShadow { .. } => "the most important ones do; give fewer lights, or weaker ones",
                Self::Within { .. } => "move it out of the scene, or give a --spot",
            }
            .into(),
        )
    }
}

/// What to say of lights in a scene.
pub fn warnings(lights: &[Light], bounds: &Bounds) -> Vec<LightWarning> {
    let shining = lights.iter().filter(|light| light.intensity() > 0.0);
    let count = shining.clone().count();
    let mut warnings = Vec::new();
    if count > SHADOW_MAPS {
        warnings.push(LightWarning::NoShadow { lights: count - SHADOW_MAPS });
    }
    for light in shining {
        if let Light::Point(lamp) = light
            && Vec3::from(lamp.position).distance(Vec3::from(bounds.centre())) < bounds.radius()
        {
            let [x, y, z] = lamp.position;
            warnings.push(LightWarning::Within { position: format!("({x}, {y}, {z})") });
        }
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::super::light::PointLight;
    use super::*;

    #[test]
    fn what_casts_no_shadow_is_said() {
        let bounds = Bounds { minimum: [-0.1; 3], maximum: [0.1; 3] };
        let lamp =
            |x: f32| Light::Point(PointLight { position: [x, 0.0, 0.0], intensity: 1.0, radius_mm: 0.0 });
        assert_eq!(warnings(&[lamp(1.0)], &bounds), []);
        assert_eq!(warnings(&[lamp(0.05)], &bounds).len(), 1);
        let five = [Light::distant([0.0, -1.0, 0.0], 1.0); 5];
        assert_eq!(warnings(&five, &bounds), [LightWarning::NoShadow { lights: 1 }]);
        let dark = [Light::distant([0.0, -1.0, 0.0], 0.0); 5];
        assert_eq!(warnings(&dark, &bounds), []);
    }
}
