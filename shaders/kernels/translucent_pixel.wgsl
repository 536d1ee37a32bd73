/// Material number of a pixel that belongs to no material of the set.
const NO_MATERIAL: i32 = -1;

/// Material number stored in the fourth component of the surface target: NO_MATERIAL unless it is finite and names a
/// material of the set.
fn material_number(stored: f32, material_count: u32) -> i32 {
    // Numbers are written as whole floats; 0.5 splits the marker −1 from material 0.
    if is_finite(stored) && stored > -0.5 && stored < f32(material_count) - 0.5 {
        return i32(stored + 0.5);
    }
    return NO_MATERIAL;
}

/// Distance along the view axis, mm, from a depth value: (x·depth + y) / (z·depth + w).
///
/// One form for perspective and orthographic projections, reversed and infinite ones, and for depth that is a distance
/// already. Returns 0 for what is no finite positive distance: the background.
fn distance_from_depth_mm(depth: f32, coefficients: vec4f) -> f32 {
    let distance = (coefficients.x * depth + coefficients.y) / (coefficients.z * depth + coefficients.w);
    if is_finite(depth) && is_finite(distance) && distance > 0.0 {
        return distance;
    }
    return 0.0;
}
