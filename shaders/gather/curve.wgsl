// uses: gather/material, kernel/constants, the material set

// Quantile curves of the profiles, which the compiler bakes: radii are read, not found by iteration.
//
// A curve holds the quantile radius Q at 64 steps of t, u = 1 − (1 − t)², in lengths of its material. It belongs to one
// surface albedo; texels hold the curve of their row and of the next, so that one load gives both neighbours: (lower
// curve, its rise to the next step, upper curve, its rise).

/// A place between two curves.
struct Curve {
    /// Row of the lower one.
    row: i32,
    /// Fraction of the upper one, 0 to 1.
    upper: f32,
    /// Mean free path that its radii are counted in, mm; 1 where they are in mm themselves.
    mean_free_path_mm: f32,
}

/// The curve of a material at a surface albedo.
fn albedo_curve(surface: MaterialSurface, surface_albedo: f32, mean_free_path_mm: f32) -> Curve {
    // Nodes are even in v: profiles widen ever faster as the surface albedo nears 1.
    let v = 1.0 - sqrt(1.0 - clamp(surface_albedo, 0.0, 1.0));
    let node = v * f32(surface.curve_count - 1u);
    let lower = min(floor(node), f32(surface.curve_count) - 2.0);
    return Curve(i32(surface.first_curve) + i32(lower), node - lower, mean_free_path_mm);
}

/// The same for a model whose channels have a curve each, in mm, whatever the surface albedo.
fn channel_curve(surface: MaterialSurface, channel: u32) -> Curve {
    return Curve(i32(surface.first_curve + channel), 0.0, 1.0);
}

/// The same for a model whose channels have a curve each for every node of the surface albedo, in mm.
fn channel_albedo_curve(surface: MaterialSurface, channel: u32, surface_albedo: f32) -> Curve {
    var own = surface;
    own.curve_count = surface.curve_count / 3u;
    own.first_curve = surface.first_curve + channel * own.curve_count;
    return albedo_curve(own, surface_albedo, 1.0);
}

/// Place of texel `step` of row `row`.
fn curve_place(row: i32, step: i32) -> vec2i {
    return vec2i(row / i32(CURVE_ROWS) * i32(CURVE_STEPS) + step, row % i32(CURVE_ROWS));
}

/// Texel `step` of a row of the curves.
fn curve_texel(row: i32, step: i32) -> vec4f {
    return textureLoad(profile_curves, curve_place(row, step), 0);
}

/// (radius in mm, its derivative by u) at the quantile `u` in [0, 1).
///
/// The curve is straight between its steps, so the derivative is the exact reciprocal of the density with which radii
/// come: what is weighted by it is not biased by the steps.
fn curve_quantile(curve: Curve, u: f32) -> vec2f {
    let root = sqrt(max(1.0 - u, 0.0));
    let place = (1.0 - root) * f32(CURVE_STEPS);
    let step = min(floor(place), f32(CURVE_STEPS) - 1.0);
    let texel = curve_texel(curve.row, i32(step));
    let start_and_rise = mix(texel.xy, texel.zw, curve.upper);
    let radius = start_and_rise.x + start_and_rise.y * (place - step);
    // dr/du = dr/dt · dt/du, dt/du = 1 / (2 √(1 − u)).
    let slope = start_and_rise.y * f32(CURVE_STEPS) * 0.5 / max(root, SMALLEST_ROOT);
    return curve.mean_free_path_mm * vec2f(radius, slope);
}
