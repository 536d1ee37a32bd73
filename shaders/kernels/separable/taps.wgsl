// uses: lib/{angle, noise}, the material set; needs: subsurface_view

/// Axis along which the first of the two passes blurs at `pixel`: the rows of the target, or another direction for each
/// pixel where the compiler says so. The second pass is perpendicular.
fn first_axis(pixel: vec2i, frame: u32) -> vec2f {
    if !SEPARABLE_ROTATED {
        return vec2f(1.0, 0.0);
    }
    let angle = 0.25 * TAU * interleaved_gradient_noise(pixel, frame);
    return vec2f(cos(angle), sin(angle));
}

/// Taps on each side of the centre, of `beside_centre` on both; an odd one is rounded up.
fn taps_per_side(beside_centre: u32) -> u32 {
    return (beside_centre + 1u) / 2u;
}

/// Taps of a pass beside the one at the centre, at most.
fn budget_beside_centre() -> u32 {
    return max(subsurface_view.taps, 1u) - 1u;
}

/// Taps of both passes, of which `beside_centre` lie beside each one's centre.
fn taps_of_passes(beside_centre: u32) -> f32 {
    return 2.0 * f32(2u * taps_per_side(beside_centre) + 1u);
}
