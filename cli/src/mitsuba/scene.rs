//! The scene file of one channel.

use super::emitter;
use super::{Boundary, Medium};
use crate::scene::MILLIMETRES_PER_METRE;
use crate::scene::camera::{Camera, Size};
use crate::scene::light::Light;
use glam::Vec3;
use std::fmt::Write as _;

/// Names of the channels, which are those of the files.
pub const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// Scatterings after which a path is given up. None ends by chance before: Mitsuba ends one in twenty at each scattering,
/// and where a hundred scatterings are common what is left of them is noise.
const LONGEST_PATH: u32 = 4000;

/// An object of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Exported {
    /// Name of its PLY file.
    pub file: String,
    /// What is in it; `None` for a black object.
    pub medium: Option<(Medium, Boundary)>,
}

/// The scene of a channel (0 to 2) as XML for Mitsuba 3; lengths in mm. The
/// environment is the name of its image, which holds the ambient light too, and its turn in radians.
pub fn xml(
    channel: usize,
    objects: &[Exported],
    camera: &Camera,
    lights: &[Light],
    ambient_intensity: f32,
    environment: Option<(String, f32)>,
    size: Size,
) -> String {
    let mut text = format!(
        "<scene version=\"3.0.0\">\n\
         \x20   <!-- Channel {name}. Millimetres. Irradiance and radiance are those of `subsurface render`. -->\n\
         \x20   <default name=\"samples\" value=\"64\"/>\n\
         \x20   <integrator type=\"volpath\">\n\
         \x20       <integer name=\"max_depth\" value=\"{LONGEST_PATH}\"/>\n\
         \x20       <integer name=\"rr_depth\" value=\"{LONGEST_PATH}\"/>\n\
         \x20       <boolean name=\"hide_emitters\" value=\"true\"/>\n\
         \x20   </integrator>\n",
        name = CHANNELS[channel],
    );
    sensor(&mut text, camera, size);
    for light in lights {
        emitter::light(&mut text, light);
    }
    if let Some((file, turn_radians)) = &environment {
        emitter::environment(&mut text, file, *turn_radians);
    } else if ambient_intensity > 0.0 {
        // Irradiance π I from everywhere alike is radiance I.
        let _ = write!(
            text,
            "    <emitter type=\"constant\">\n        <rgb name=\"radiance\" value=\"{ambient_intensity}\"/>\n    \
             </emitter>\n"
        );
    }
    for object in objects {
        shape(&mut text, channel, object);
    }
    text.push_str("</scene>\n");
    text
}

fn sensor(text: &mut String, camera: &Camera, size: Size) {
    let millimetres = |point: [f32; 3]| {
        let [x, y, z] = (Vec3::from(point) * MILLIMETRES_PER_METRE).to_array();
        format!("{x}, {y}, {z}")
    };
    let _ = write!(
        text,
        "    <sensor type=\"perspective\">\n\
         \x20       <float name=\"fov\" value=\"{}\"/>\n\
         \x20       <string name=\"fov_axis\" value=\"y\"/>\n\
         \x20       <float name=\"near_clip\" value=\"0.01\"/>\n\
         \x20       <float name=\"far_clip\" value=\"1e7\"/>\n\
         \x20       <transform name=\"to_world\">\n\
         \x20           <lookat origin=\"{}\" target=\"{}\" up=\"0, 1, 0\"/>\n\
         \x20       </transform>\n\
         \x20       <sampler type=\"independent\">\n\
         \x20           <integer name=\"sample_count\" value=\"$samples\"/>\n\
         \x20       </sampler>\n\
         \x20       <film type=\"hdrfilm\">\n\
         \x20           <integer name=\"width\" value=\"{}\"/>\n\
         \x20           <integer name=\"height\" value=\"{}\"/>\n\
         \x20           <string name=\"pixel_format\" value=\"luminance\"/>\n\
         \x20           <string name=\"component_format\" value=\"float32\"/>\n\
         \x20           <rfilter type=\"box\"/>\n\
         \x20       </film>\n\
         \x20   </sensor>\n",
        camera.fov_y_degrees,
        millimetres(camera.position),
        millimetres(camera.target),
        size.width,
        size.height,
    );
}

fn shape(text: &mut String, channel: usize, object: &Exported) {
    let _ = writeln!(
        text,
        "    <shape type=\"ply\">\n        <string name=\"filename\" value=\"{}\"/>",
        object.file
    );
    match &object.medium {
        None => text.push_str(
            "        <bsdf type=\"twosided\">\n            <bsdf type=\"diffuse\">\n                \
             <rgb name=\"reflectance\" value=\"0\"/>\n            </bsdf>\n        </bsdf>\n",
        ),
        Some((medium, boundary)) => {
            match boundary {
                Boundary::Matched => text.push_str("        <bsdf type=\"null\"/>\n"),
                Boundary::Smooth { refractive_index } => {
                    let _ = write!(
                        text,
                        "        <bsdf type=\"dielectric\">\n\
                         \x20           <float name=\"int_ior\" value=\"{refractive_index}\"/>\n\
                         \x20           <float name=\"ext_ior\" value=\"1\"/>\n\
                         \x20       </bsdf>\n"
                    );
                }
                Boundary::Rough { refractive_index, alpha } => {
                    let _ = write!(
                        text,
                        "        <bsdf type=\"roughdielectric\">\n\
                         \x20           <string name=\"distribution\" value=\"ggx\"/>\n\
                         \x20           <float name=\"alpha\" value=\"{alpha}\"/>\n\
                         \x20           <float name=\"int_ior\" value=\"{refractive_index}\"/>\n\
                         \x20           <float name=\"ext_ior\" value=\"1\"/>\n\
                         \x20       </bsdf>\n"
                    );
                }
            }
            let _ = write!(
                text,
                "        <medium name=\"interior\" type=\"homogeneous\">\n\
                 \x20           <rgb name=\"albedo\" value=\"{}\"/>\n\
                 \x20           <rgb name=\"sigma_t\" value=\"1\"/>\n\
                 \x20           <float name=\"scale\" value=\"{}\"/>\n\
                 \x20           <phase type=\"isotropic\"/>\n\
                 \x20       </medium>\n",
                medium.single_scattering_albedo[channel],
                1.0 / medium.mean_free_path_mm[channel],
            );
        }
    }
    text.push_str("    </shape>\n");
}
