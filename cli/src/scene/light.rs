//! Where the light comes from.

use super::camera::numbers;
use glam::Vec3;
use std::str::FromStr;

/// Irradiance from everywhere alike when none is asked for, so that no shadow is black: a fortieth of a light of
/// intensity 1.
pub const DEFAULT_AMBIENT_INTENSITY: f32 = 0.025;

/// Largest intensity: beyond, light does not fit into half floats at any exposure.
const BRIGHTEST: f32 = 1e6;

/// A light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// So far away that all its rays are parallel.
    Directional(DirectionalLight),
    /// A lamp.
    Point(PointLight),
    /// A lamp that shines into a cone.
    Spot(SpotLight),
}

/// A light so far away that all its rays are parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// Unit vector in which the light travels: from the light to the scene.
    pub direction: [f32; 3],
    /// Irradiance on a surface that faces the light, ≥ 0; 1 lights white up to white.
    pub intensity: f32,
    /// Angle that it spans in the sky, in degrees, 0 to 170.
    pub angular_diameter_degrees: f32,
}

/// A lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// Where it stands (m).
    pub position: [f32; 3],
    /// Irradiance at the distance of a metre, ≥ 0; 1 lights white up to white there.
    pub intensity: f32,
    /// Its radius in mm, ≥ 0.
    pub radius_mm: f32,
}

/// A lamp that shines into a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotLight {
    /// The lamp.
    pub lamp: PointLight,
    /// Unit vector along the cone's axis, away from the lamp.
    pub direction: [f32; 3],
    /// Full angle of the cone in degrees, 0 to 180. Its outer tenth falls off.
    pub cone_degrees: f32,
}

impl SpotLight {
    /// Angles between the axis and the edges of what is lit in full and at all, in radians.
    pub fn angles_radians(&self) -> [f32; 2] {
        let outer = 0.5 * self.cone_degrees.to_radians();
        [0.9 * outer, outer]
    }
}

impl Light {
    /// Key light from the upper left of the default camera, which lays the shadow's edge over the face, and a rim light from
    /// behind that shines through the ear.
    pub const DEFAULT: [Light; 2] = [
        // Unit vectors to the last digit that f32 has; see the test.
        Self::distant([0.662_266_2, -0.529_812_93, -0.529_812_93], 1.25),
        Self::distant([-0.702_247, -0.117_041_16, 0.702_247], 1.6),
    ];

    /// Parallel rays from a point in the sky.
    pub const fn distant(direction: [f32; 3], intensity: f32) -> Self {
        Self::Directional(DirectionalLight { direction, intensity, angular_diameter_degrees: 0.0 })
    }

    /// How bright it is.
    pub fn intensity(&self) -> f32 {
        match self {
            Self::Directional(light) => light.intensity,
            Self::Point(lamp) => lamp.intensity,
            Self::Spot(spot) => spot.lamp.intensity,
        }
    }
}

impl FromStr for DirectionalLight {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (direction, intensity, degrees) = match numbers(text)?[..] {
            [x, y, z] => ([x, y, z], 1.0, 0.0),
            [x, y, z, intensity] => ([x, y, z], intensity, 0.0),
            [x, y, z, intensity, degrees] => ([x, y, z], intensity, degrees),
            ref other => return Err(expected("dx,dy,dz[,intensity[,degrees]]", other)),
        };
        if !(0.0..=170.0).contains(&degrees) {
            return Err(format!("the light spans {degrees} degrees: give 0 to 170; the sun has 0.53"));
        }
        Ok(Self {
            direction: unit(direction)?,
            intensity: bright(intensity)?,
            angular_diameter_degrees: degrees,
        })
    }
}

impl FromStr for PointLight {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (position, intensity, radius) = match numbers(text)?[..] {
            [x, y, z] => ([x, y, z], 1.0, 0.0),
            [x, y, z, intensity] => ([x, y, z], intensity, 0.0),
            [x, y, z, intensity, radius] => ([x, y, z], intensity, radius),
            ref other => return Err(expected("x,y,z[,intensity[,radius_mm]]", other)),
        };
        Ok(Self { position, intensity: bright(intensity)?, radius_mm: thick(radius)? })
    }
}

impl FromStr for SpotLight {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let all = numbers(text)?;
        let (place, cone, intensity, radius) = match all[..] {
            [_, _, _, _, _, _, cone] => (&all[..6], cone, 1.0, 0.0),
            [_, _, _, _, _, _, cone, intensity] => (&all[..6], cone, intensity, 0.0),
            [_, _, _, _, _, _, cone, intensity, radius] => (&all[..6], cone, intensity, radius),
            ref other => return Err(expected("x,y,z,dx,dy,dz,degrees[,intensity[,radius_mm]]", other)),
        };
        if !(0.0..=180.0).contains(&cone) {
            return Err(format!(
                "the cone has {cone} degrees: give 0 (no light) to 180 (half of all directions)"
            ));
        }
        Ok(Self {
            lamp: PointLight {
                position: [place[0], place[1], place[2]],
                intensity: bright(intensity)?,
                radius_mm: thick(radius)?,
            },
            direction: unit([place[3], place[4], place[5]])?,
            cone_degrees: cone,
        })
    }
}

fn expected(form: &str, found: &[f32]) -> String {
    format!("expected `{form}`, found {} numbers", found.len())
}

fn unit(direction: [f32; 3]) -> Result<[f32; 3], String> {
    let unit = Vec3::from(direction).try_normalize();
    unit.map(|unit| unit.to_array())
        .ok_or_else(|| "the direction is zero; give the way in which the light travels".to_owned())
}

fn bright(intensity: f32) -> Result<f32, String> {
    if intensity < 0.0 {
        return Err(format!("the intensity {intensity} is negative"));
    }
    if intensity > BRIGHTEST {
        return Err(format!(
            "the intensity {intensity} is more than {BRIGHTEST}; 1 lights white up to white"
        ));
    }
    Ok(intensity)
}

fn thick(radius_mm: f32) -> Result<f32, String> {
    if radius_mm < 0.0 { Err(format!("the radius {radius_mm} mm is negative")) } else { Ok(radius_mm) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    #[test]
    fn a_light_is_a_unit_direction_an_intensity_and_an_angle() {
        let light: DirectionalLight = "0, -2, 0".parse().unwrap();
        assert_eq!(Light::Directional(light), Light::distant([0.0, -1.0, 0.0], 1.0));
        let sun: DirectionalLight = "0,0,5,0.5,0.53".parse().unwrap();
        assert_eq!((sun.intensity, sun.angular_diameter_degrees), (0.5, 0.53));
        for wrong in [
            "",
            "1,2",
            "0,0,0",
            "1,0,0,-1",
            "1,0,x",
            "inf,0,0",
            "NaN,0,0",
            "1,2,3,4,-5",
            "1,2,3,4,5,6",
            "1,2,3,1e30",
        ] {
            assert!(wrong.parse::<DirectionalLight>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_lamp_has_a_place_and_a_spot_a_cone() {
        let lamp: PointLight = "0.1,0.2,0.3,2,15".parse().unwrap();
        assert_eq!((lamp.position, lamp.intensity, lamp.radius_mm), ([0.1, 0.2, 0.3], 2.0, 15.0));
        let spot: SpotLight = "0,1,0,0,-2,0,60".parse().unwrap();
        assert_eq!((spot.direction, spot.lamp.intensity), ([0.0, -1.0, 0.0], 1.0));
        assert!((spot.angles_radians()[1].to_degrees() - 30.0).abs() < 1e-4);
        for wrong in ["0,1", "0,0,0,-1", "0,0,0,1,-5", "0,0,0,1,1,1"] {
            assert!(wrong.parse::<PointLight>().is_err(), "{wrong}");
        }
        for wrong in ["0,1,0,0,-1,0", "0,1,0,0,0,0,60", "0,1,0,0,-1,0,181", "0,1,0,0,-1,0,-1"] {
            assert!(wrong.parse::<SpotLight>().is_err(), "{wrong}");
        }
        assert!(
            "0,1,0,0,-1,0,0".parse::<SpotLight>().is_ok() && "0,1,0,0,-1,0,180".parse::<SpotLight>().is_ok()
        );
    }

    #[test]
    fn default_lights_are_unit_vectors() {
        for light in Light::DEFAULT {
            let Light::Directional(light) = light else { panic!("{light:?}") };
            // A few roundings of f32.
            assert!((Vec3::from(light.direction).length() - 1.0).abs() < 1e-6);
        }
    }
}
