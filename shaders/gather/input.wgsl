// uses: lib/numeric_limits

// What the estimators see of the inputs; the pass that links them says where it comes from.

/// Material number of a pixel that belongs to no material of the set.
const NO_MATERIAL: i32 = -1;

/// A pixel as a tap sees it.
struct InputPixel {
    /// Diffuse irradiance, finite and not negative.
    irradiance: vec3f,
    /// Distance along the view axis, mm.
    distance_mm: f32,
    /// Material number; NO_MATERIAL for a pixel that gives no light: background, or an irradiance that is not finite.
    material: i32,
}

/// The surface that a pixel shows.
struct InputSurface {
    /// Distance along the view axis, mm; 0 where there is none.
    distance_mm: f32,
    /// Material number, or NO_MATERIAL for a pixel that does not scatter.
    material: i32,
}

/// Irradiance above this counts as this: 4096 taps at the largest weight still add up to a finite f32.
const LARGEST_IRRADIANCE: f32 = 1e30;

/// A distance above this counts as this: squares stay finite, and every profile is 0 there.
const LARGEST_DISTANCE_MM: f32 = 1e15;

/// Irradiance without what is not finite or below 0.
fn finite_irradiance(irradiance: vec3f) -> vec3f {
    return select(vec3f(0.0), clamp(irradiance, vec3f(0.0), vec3f(LARGEST_IRRADIANCE)), is_finite_rgb(irradiance));
}

/// Material number stored in the fourth component of the surface target: NO_MATERIAL unless it is finite and names a
/// material of the set.
fn material_number(stored: f32, material_count: u32) -> i32 {
    // Numbers are written as whole floats; 0.5 splits the marker −1 from material 0.
    if is_finite(stored) && stored > -0.5 && stored < f32(material_count) - 0.5 {
        return i32(stored + 0.5);
    }
    return NO_MATERIAL;
}

/// Material number of an id: NO_MATERIAL unless it names a material of the set.
fn material_of_id(id: u32, material_count: u32) -> i32 {
    return select(NO_MATERIAL, i32(id), id < material_count);
}

/// The surface of a material at `distance_mm`.
fn surface_of_material(material: i32, distance_mm: f32) -> InputSurface {
    if material == NO_MATERIAL || distance_mm == 0.0 {
        return InputSurface(0.0, NO_MATERIAL);
    }
    return InputSurface(min(distance_mm, LARGEST_DISTANCE_MM), material);
}
