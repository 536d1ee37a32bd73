// uses: lib/numeric_limits

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
