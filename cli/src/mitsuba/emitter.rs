//! Lights as Mitsuba 3 has them.

use crate::scene::MILLIMETRES_PER_METRE;
use crate::scene::light::{DirectionalLight, Light, PointLight};
use glam::Vec3;
use std::f64::consts::PI;
use std::fmt::Write as _;

/// How far away the disc of a directional light stands (mm): its rays are parallel to a thousandth over a head.
const DISC_DISTANCE: f32 = 1e6;

/// Adds a light. A light of some size is a shape that shines.
pub(super) fn light(text: &mut String, light: &Light) {
    match light {
        Light::Directional(light) if light.angular_diameter_degrees > 0.0 => disc(text, light),
        Light::Directional(light) => {
            let direction = vector("direction", light.direction);
            let irradiance = PI * f64::from(light.intensity);
            let _ = write!(
                text,
                "    <emitter type=\"directional\">\n        {direction}\n        \
                 <rgb name=\"irradiance\" value=\"{irradiance}\"/>\n    </emitter>\n"
            );
        }
        Light::Point(lamp) if lamp.radius_mm > 0.0 => ball(text, lamp),
        Light::Point(lamp) => {
            let _ = write!(
                text,
                "    <emitter type=\"point\">\n        {}\n        <rgb name=\"intensity\" value=\"{}\"/>\n    \
                 </emitter>\n",
                point("position", lamp.position),
                intensity(lamp)
            );
        }
        Light::Spot(spot) => {
            let [inner, outer] = spot.angles_radians().map(f32::to_degrees);
            let origin = millimetres(spot.lamp.position);
            let target = origin + Vec3::from(spot.direction);
            // Any direction across the axis: the cone is round.
            let up = Vec3::from(spot.direction).any_orthonormal_vector();
            let _ = write!(
                text,
                "    <emitter type=\"spot\">\n        <rgb name=\"intensity\" value=\"{}\"/>\n        \
                 <float name=\"cutoff_angle\" value=\"{outer}\"/>\n        \
                 <float name=\"beam_width\" value=\"{inner}\"/>\n        <transform name=\"to_world\">\n            \
                 <lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>\n        </transform>\n    </emitter>\n",
                intensity(&spot.lamp),
                list(origin),
                list(target),
                list(up)
            );
        }
    }
}

/// Adds light from all around, from an image beside the scene.
pub(super) fn environment(text: &mut String, file: &str, turn_radians: f32) {
    // Mitsuba has the image's left edge where we have its middle.
    let degrees = 180.0 - turn_radians.to_degrees();
    let _ = write!(
        text,
        "    <emitter type=\"envmap\">\n        <string name=\"filename\" value=\"{file}\"/>\n        \
         <transform name=\"to_world\">\n            \
         <rotate y=\"1\" angle=\"{degrees}\"/>\n        </transform>\n    </emitter>\n"
    );
}

/// A disc far away, as large in the sky as the light.
fn disc(text: &mut String, light: &DirectionalLight) {
    let half_angle = 0.5 * light.angular_diameter_degrees.to_radians();
    // E = π L sin² of the half angle.
    let radiance = f64::from(light.intensity) / f64::from(half_angle.sin()).powi(2);
    let direction = Vec3::from(light.direction);
    let origin = -DISC_DISTANCE * direction;
    let _ = write!(
        text,
        "    <shape type=\"disk\">\n        <transform name=\"to_world\">\n            \
         <scale value=\"{}\"/>\n            <lookat origin=\"{}\" target=\"0, 0, 0\" up=\"{}\"/>\n        \
         </transform>\n        <emitter type=\"area\">\n            \
         <rgb name=\"radiance\" value=\"{radiance}\"/>\n        </emitter>\n    </shape>\n",
        DISC_DISTANCE * half_angle.tan(),
        list(origin),
        list(direction.any_orthonormal_vector())
    );
}

/// A ball that shines.
fn ball(text: &mut String, lamp: &PointLight) {
    // A ball of radiance L and radius R has the intensity L π R².
    let radiance = intensity(lamp) / (PI * f64::from(lamp.radius_mm).powi(2));
    let _ = write!(
        text,
        "    <shape type=\"sphere\">\n        {}\n        <float name=\"radius\" value=\"{}\"/>\n        \
         <emitter type=\"area\">\n            <rgb name=\"radiance\" value=\"{radiance}\"/>\n        </emitter>\n    \
         </shape>\n",
        point("center", lamp.position),
        lamp.radius_mm
    );
}

/// Irradiance at a metre, at a millimetre: that is a lamp's intensity in a scene in mm.
fn intensity(lamp: &PointLight) -> f64 {
    PI * f64::from(lamp.intensity) * f64::from(MILLIMETRES_PER_METRE).powi(2)
}

fn millimetres(metres: [f32; 3]) -> Vec3 {
    Vec3::from(metres) * MILLIMETRES_PER_METRE
}

fn list(vector: Vec3) -> String {
    format!("{}, {}, {}", vector.x, vector.y, vector.z)
}

fn vector(name: &str, [x, y, z]: [f32; 3]) -> String {
    format!("<vector name=\"{name}\" x=\"{x}\" y=\"{y}\" z=\"{z}\"/>")
}

fn point(name: &str, metres: [f32; 3]) -> String {
    let [x, y, z] = millimetres(metres).to_array();
    format!("<point name=\"{name}\" x=\"{x}\" y=\"{y}\" z=\"{z}\"/>")
}
