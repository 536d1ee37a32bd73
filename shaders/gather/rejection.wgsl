// uses: gather/{input, normal, point}, the material set

// Which light counts. The policy stands in constants that the compiler writes: REJECT_BY_MATERIAL, REJECT_BY_DISTANCE
// and REJECT_BY_NORMAL.

/// Whether light of `material` may enter at all: background never does.
fn accepts_material(point: SurfacePoint, material: i32) -> bool {
    return material != NO_MATERIAL && (!REJECT_BY_MATERIAL || material == point.material);
}

/// Depth difference between a point and a tap in the lengths of its profile, mm; 0 where distance does not reject.
fn depth_difference_mm(point: SurfacePoint, distance_mm: f32) -> f32 {
    return select(0.0, (distance_mm - point.distance_mm) * point.per_mm, REJECT_BY_DISTANCE);
}

/// Share of a tap's light that its normal lets through, beside a surface of `normal`: the cosine between the two.
fn accepted_by_normal(normal: vec3f, position: vec2i, span_mm: f32) -> f32 {
    if !REJECT_BY_NORMAL {
        return 1.0;
    }
    return max(dot(normal, surface_normal(position, span_mm)), 0.0);
}
