// Which light counts. The policy stands in constants that the compiler writes: REJECT_BY_MATERIAL, REJECT_BY_DISTANCE,
// REJECT_BY_NORMAL and RETURN_TO_CENTRE.

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

/// Light that was gathered, and the energy that was found for it: 1 per channel where nothing was rejected.
struct Gathered {
    /// Σ wᵢ Eᵢ
    irradiance: vec3f,
    /// Σ wᵢ
    weight: vec3f,
}

/// Sum of two lights.
fn together(a: Gathered, b: Gathered) -> Gathered {
    return Gathered(a.irradiance + b.irradiance, a.weight + b.weight);
}

/// Least energy that stands for all of it. Where taps found less than this share, the centre's own light fills it up:
/// what little comes from a surface far behind must not be raised to a whole.
const SMALLEST_ENERGY: f32 = 1e-3;

/// A weight below this divides nothing.
const SMALLEST_WEIGHT: f32 = 1e-12;

/// Diffused irradiance from what was gathered. Missing energy is renormalized or, if the policy says so, returned to
/// the centre.
fn diffused_irradiance(gathered: Gathered, own: vec3f) -> vec3f {
    let least = select(SMALLEST_ENERGY, 1.0, RETURN_TO_CENTRE);
    let returned = max(vec3f(least) - gathered.weight, vec3f(0.0));
    return (gathered.irradiance + returned * own) / (gathered.weight + returned);
}
