// uses: gather/input, kernel/constants, the material set

// Which surfaces belong together, and which of them lies in front.

/// Whether `a` lies in front of `b`, or as near, or is all that there is.
fn hides(a: InputSurface, b: InputSurface) -> bool {
    return b.material == NO_MATERIAL || (a.material != NO_MATERIAL && a.distance_mm <= b.distance_mm);
}

/// Reciprocal of the depth difference up to which pixels belong together, mm⁻¹; 0 where distance does not reject.
fn depth_scale(span_mm: f32) -> f32 {
    return select(0.0, 1.0 / (BLOCK_DEPTH_PIXELS * span_mm), REJECT_BY_DISTANCE);
}

/// How far a surface is in front of another or behind it, in BLOCK_DEPTH_PIXELS, at most 1.
fn apart_in_depth(depth_scale: f32, a_mm: f32, b_mm: f32) -> f32 {
    return min(abs(depth_scale * (a_mm - b_mm)), 1.0);
}

/// Share of what lies `apart` in depth that counts: 1 on the surface itself, 0 from 1 on.
///
/// A parabola: as good as the Gaussian that it stands for, without an exponential.
fn depth_agreement(apart: f32) -> f32 {
    return 1.0 - apart * apart;
}

/// 1 for a surface that belongs to that of `nearest`, 0 for one of another material or `reach_mm` deeper.
fn membership(surface: InputSurface, nearest: InputSurface, reach_mm: f32) -> f32 {
    let is_remote = REJECT_BY_DISTANCE && abs(surface.distance_mm - nearest.distance_mm) >= reach_mm;
    return select(0.0, 1.0, surface.material == nearest.material && !is_remote);
}
