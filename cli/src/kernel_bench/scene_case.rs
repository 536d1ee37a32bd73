//! Cases drawn from a scene, at chosen footprints.

use super::case::Case;
use super::subject::Subject;
use crate::draw::{Buffers, Drawn, Frame, Needs, PixelScale, Route, Shown, Studio};
use crate::failure::Failure;
use crate::picture::LinearPicture;
use crate::scene::Scene;
use crate::scene::camera::{Camera, DEFAULT_FOV_Y_DEGREES, Size};
use crate::scene::light::{DEFAULT_AMBIENT_INTENSITY, Light};
use glam::Vec3;
use subsurface_codegen::Compilation;

/// A scene to be seen from several distances.
#[derive(Clone, Copy, Debug)]
pub struct SceneCases<'a> {
    /// Its name in tables.
    pub name: &'a str,
    /// What is drawn.
    pub scene: &'a Scene,
    /// Size of the pictures.
    pub size: Size,
    /// The point in the middle of the pictures (m); the middle of the scene if `None`.
    pub target: Option<[f32; 3]>,
}

/// Pictures it takes to find the camera: the first measures the distance of the surface, the second that of the part
/// that is then in view.
const ATTEMPTS: usize = 3;

impl SceneCases<'_> {
    /// The case in which the mean radius of the subject's widest channel spans `footprint_pixels`.
    ///
    /// The camera zooms in where that takes a narrower field of view than the default, and steps back where it takes a
    /// wider one.
    pub fn at_footprint(
        &self,
        materials: &Compilation,
        subject: &Subject,
        footprint_pixels: f64,
    ) -> Result<Case, Failure> {
        let mut studio = Studio::open(materials, Route::default(), Needs::default())?;
        let height = f64::from(self.size.height);
        let framing = Camera::framing(self.scene, self.size.aspect(), DEFAULT_FOV_Y_DEGREES);
        let offset = Vec3::from(framing.position) - Vec3::from(framing.target);
        let target = Vec3::from(self.target.unwrap_or(framing.target));
        // Half of what the picture spans upwards at the surface, mm.
        let half_span_mm = 0.5 * height * subject.mean_radius_mm() / footprint_pixels;
        let widest = f64::from(0.5 * DEFAULT_FOV_Y_DEGREES).to_radians().tan();
        // How far the surface is in front of the target, mm: known once there is a picture.
        let mut lead_mm = 0.0;
        let mut drawn = None;
        for _ in 0..ATTEMPTS {
            let near_mm = 1e3 * f64::from(offset.length());
            let tangent = (half_span_mm / (near_mm - lead_mm)).min(widest);
            let camera_mm = if tangent < widest { near_mm } else { half_span_mm / widest + lead_mm };
            let position = target + offset.normalize_or(Vec3::Z) * (1e-3 * camera_mm) as f32;
            let fov_y_degrees = (2.0 * tangent.atan()).to_degrees() as f32;
            let camera = Camera { position: position.to_array(), target: target.to_array(), fov_y_degrees };
            let case = self.draw(&mut studio, subject, camera, footprint_pixels)?;
            let Some(surface_mm) = case.median_distance_mm() else {
                return Err(Failure::new(
                    format!("nothing of {} is in the picture at {footprint_pixels} pixels", self.name),
                    "choose another --target, or larger --footprints",
                ));
            };
            lead_mm = camera_mm - f64::from(surface_mm);
            drawn = Some(case);
        }
        drawn.ok_or_else(|| Failure::new("nothing was drawn", "please report this as a defect"))
    }

    fn draw(
        &self,
        studio: &mut Studio,
        subject: &Subject,
        camera: Camera,
        footprint_pixels: f64,
    ) -> Result<Case, Failure> {
        let drawn = studio.draw(&Frame {
            scene: self.scene,
            material_of_object: &vec![subject.number(); self.scene.objects.len()],
            camera,
            lights: &Light::DEFAULT,
            ambient_intensity: DEFAULT_AMBIENT_INTENSITY,
            environment: None,
            size: self.size,
            supersampling: 1,
            shown: Shown::Surface,
            wants_aovs: true,
            wants_timings: false,
        })?;
        Ok(Case {
            name: format!("{} {footprint_pixels} px", self.name),
            buffers: buffers(&drawn, self.size, subject.number())?,
            scale: PixelScale::FovYDegrees(camera.fov_y_degrees),
        })
    }
}

/// What the subsurface pass would read; pixels of no material count as background.
fn buffers(drawn: &Drawn, size: Size, number: u32) -> Result<Buffers, Failure> {
    let target = |name: &str| -> Result<&LinearPicture, Failure> {
        let found = drawn.aovs.iter().find(|(known, _)| known == name).map(|(_, picture)| picture);
        found
            .ok_or_else(|| Failure::new(format!("the frame has no {name}"), "please report this as a defect"))
    };
    let (distance, material) = (target("distance_mm")?, target("material")?);
    let depth_mm = distance.pixels.iter().zip(&material.pixels);
    Ok(Buffers {
        size,
        irradiance: target("irradiance")?.pixels.clone(),
        depth_mm: depth_mm.map(|([mm, ..], [stored, ..])| if *stored < 0.0 { 0.0 } else { *mm }).collect(),
        surface_albedo: Some(target("surface_albedo")?.pixels.clone()),
        material: vec![number; size.pixels()],
        mean_free_path_scale: None,
    })
}
