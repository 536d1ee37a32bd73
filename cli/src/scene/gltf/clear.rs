//! Materials of a glTF file that are clear: `KHR_materials_transmission`, `_volume` and `_ior`.

use super::Place;
use super::warning::GltfWarning;
use crate::scene::MILLIMETRES_PER_METRE;
use subsurface_codegen::ClearMaterial as Absorbing;
use subsurface_runtime::ClearMaterial;

/// Refractive index where a file gives none.
const DEFAULT_INDEX: f32 = 1.5;

/// Thickness of a wall whose colour stands for what it absorbs, mm: any will do.
const WALL_MM: f32 = 1.0;

/// What is clear of a material whose transmission is more than half, and how much of each pixel it covers. What is
/// approximated is a warning.
pub(super) fn clear_material(
    material: &gltf::Material<'_>,
    place: &Place,
    warnings: &mut Vec<GltfWarning>,
) -> Option<(ClearMaterial, f32)> {
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
    let mut within = |what: &'static str, value: f32, least: f32, most: f32| {
        // Not a number is out of range too.
        if !(least..=most).contains(&value) {
            warnings.push(GltfWarning::ClearOutOfRange { place: place.clone(), what });
        }
        if value.is_nan() { least } else { value.clamp(least, most) }
    };
    let absorption_of =
        |colour: f32, at_mm: f32| Absorbing::absorption_of(f64::from(colour), f64::from(at_mm)) as f32;
    // A volume absorbs by its own colour; a wall is coloured by the base colour.
    let (absorption_per_mm, shell_thickness_mm) = match &volume {
        Some(volume) => {
            // In the world's units, unlike the thickness: the node's scale is no part of it. Without one nothing is absorbed.
            let distance = volume.attenuation_distance();
            let is_finite = distance.is_finite();
            let distance = if is_finite { within("attenuationDistance", distance, 1e-9, 1e9) } else { 1.0 };
            let colour =
                volume.attenuation_color().map(|colour| within("attenuationColor", colour, 0.0, 1.0));
            let absorption = colour.map(|colour| absorption_of(colour, distance * MILLIMETRES_PER_METRE));
            (if is_finite { absorption } else { [0.0; 3] }, None)
        }
        None => {
            let tint = tint.map(|colour| within("baseColorFactor", colour, 0.0, 1.0));
            (tint.map(|colour| absorption_of(colour, WALL_MM)), Some(WALL_MM))
        }
    };
    let refractive_index = within("ior", material.ior().unwrap_or(DEFAULT_INDEX), 1.0, 2.0);
    let roughness = within("roughnessFactor", colour.roughness_factor(), 0.0, 1.0);
    let has_tint = volume.is_some() && tint != [1.0; 3];
    if has_tint || colour.base_color_texture().is_some() {
        warnings.push(GltfWarning::TintedVolume { place: place.clone() });
    }
    let coverage = if material.alpha_mode() == gltf::material::AlphaMode::Blend { alpha } else { 1.0 };
    Some((ClearMaterial { absorption_per_mm, refractive_index, roughness, shell_thickness_mm }, coverage))
}
