//! Materials of a glTF file that are clear: `KHR_materials_transmission`, `_volume` and `_ior`.

use super::Place;
use super::warning::GltfWarning;
use crate::scene::{ClearSurface, MILLIMETRES_PER_METRE};

/// Refractive index where a file gives none.
const DEFAULT_INDEX: f32 = 1.5;

/// Thickness of a wall whose colour stands for what it absorbs, mm: any will do.
const WALL_MM: f32 = 1.0;

/// Least colour that has a finite absorption, as of `Clear(…)`.
const LEAST_COLOUR: f32 = 1e-6;

/// What is clear of a material whose transmission is more than half; a volume's lengths grow by `scale`. What is
/// approximated is a warning.
pub(super) fn clear_surface(
    material: &gltf::Material<'_>,
    scale: f32,
    place: &Place,
    warnings: &mut Vec<GltfWarning>,
) -> Option<ClearSurface> {
    let transmission = material.transmission()?;
    let factor = transmission.transmission_factor();
    if factor == 0.0 {
        return None;
    }
    if factor <= 0.5 {
        warnings.push(GltfWarning::LittleTransmission { place: place.clone() });
        return None;
    }
    if factor < 1.0 || transmission.transmission_texture().is_some() {
        warnings.push(GltfWarning::PartlyClear { place: place.clone() });
    }
    let colour = material.pbr_metallic_roughness();
    let [red, green, blue, alpha] = colour.base_color_factor();
    let tint = [red, green, blue];
    let volume = material.volume().filter(|volume| volume.thickness_factor() > 0.0);
    let absorption_of = |colour: f32, at_mm: f32| -colour.clamp(LEAST_COLOUR, 1.0).ln() / at_mm;
    // A volume absorbs by its own colour; a wall is coloured by the base colour.
    let (absorption_per_mm, shell_thickness_mm) = match &volume {
        Some(volume) => {
            if tint != [1.0; 3] || colour.base_color_texture().is_some() {
                warnings.push(GltfWarning::TintedVolume { place: place.clone() });
            }
            let distance_mm = volume.attenuation_distance() * scale * MILLIMETRES_PER_METRE;
            (volume.attenuation_color().map(|colour| absorption_of(colour, distance_mm)), None)
        }
        None => {
            if colour.base_color_texture().is_some() {
                warnings.push(GltfWarning::TintedVolume { place: place.clone() });
            }
            (tint.map(|colour| absorption_of(colour, WALL_MM)), Some(WALL_MM))
        }
    };
    Some(ClearSurface {
        absorption_per_mm,
        refractive_index: material.ior().unwrap_or(DEFAULT_INDEX).clamp(1.0, 2.0),
        roughness: colour.roughness_factor(),
        shell_thickness_mm,
        coverage: if material.alpha_mode() == gltf::material::AlphaMode::Blend { alpha } else { 1.0 },
    })
}
