// uses: gather/input, the material set; needs: input_surface

/// Normal of the surface at `position`, towards the viewer, in a frame of pixel columns, pixel rows and the view axis;
/// zero unless normals reject.
///
/// From the depths beside it; the side with the smaller step counts, so that a silhouette does not bend it.
fn surface_normal(position: vec2i, span_mm: f32) -> vec3f {
    if !REJECT_BY_NORMAL {
        return vec3f(0.0);
    }
    // Of the inputs, all three: packed distances and those of blocks are rounded, and steps are small.
    let distance_mm = input_surface(position).distance_mm;
    let steps = vec2f(
        depth_step_mm(position, vec2i(1, 0), distance_mm),
        depth_step_mm(position, vec2i(0, 1), distance_mm),
    );
    return normalize(vec3f(steps, span_mm));
}

/// Smaller of the depth steps to both neighbours along `axis`, mm per pixel.
fn depth_step_mm(position: vec2i, axis: vec2i, distance_mm: f32) -> f32 {
    let after = input_surface(position + axis);
    let before = input_surface(position - axis);
    let step_after = select(after.distance_mm - distance_mm, LARGEST_DISTANCE_MM, after.material == NO_MATERIAL);
    let step_before = select(distance_mm - before.distance_mm, LARGEST_DISTANCE_MM, before.material == NO_MATERIAL);
    let step = select(step_before, step_after, abs(step_after) < abs(step_before));
    return select(step, 0.0, abs(step) >= LARGEST_DISTANCE_MM);
}
