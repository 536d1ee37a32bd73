// uses: lib/numeric_limits, the material set; needs: mixture_radial_cdf, mixture_radial_pdf, mixture_radius_bounds

// A mixture of profiles: R(r) = Σ wᵢ Rᵢ(r), Σ wᵢ = 1.
// From the material set come the parts (`MixtureModel`, `mixture_shape`), the sums over them (`mixture_area_pdf`,
// `mixture_radial_pdf`, `mixture_radial_cdf`) and the bounds of the quantile: which models the parts have is known there.

/// `bounds` widened to hold a radius.
fn mixture_widened(bounds: vec2f, radius_mm: f32) -> vec2f {
    return vec2f(min(bounds.x, radius_mm), max(bounds.y, radius_mm));
}

/// The middle of a bracket whose ends may be decades apart: their geometric mean.
fn mixture_middle(bracket: vec2f) -> f32 {
    return sqrt(max(bracket.x, SMALLEST_RADIUS_MM) * bracket.y);
}

/// Inverse of `mixture_radial_cdf`.
///
/// Newton's method between the least and the greatest quantile of the parts, halving the bracket where a step would
/// leave it or is not much shorter than the one before.
fn mixture_sample_radius(shape: ProfileShape, u: f32) -> f32 {
    let share = min(u, LARGEST_BELOW_ONE);
    var bracket = mixture_radius_bounds(shape, share);
    var radius = mixture_middle(bracket);
    var last_step = bracket.y - bracket.x;
    for (var step = 0; step < 40; step += 1) {
        let excess = mixture_radial_cdf(shape, radius) - share;
        if excess > 0.0 {
            bracket.y = radius;
        } else {
            bracket.x = radius;
        }
        var next = radius - excess / mixture_radial_pdf(shape, radius);
        let is_good = next >= bracket.x && next <= bracket.y && abs(next - radius) <= 0.5 * last_step;
        if !is_good {
            next = mixture_middle(bracket);
        }
        last_step = abs(next - radius);
        radius = next;
        if last_step <= 1e-6 * radius {
            break;
        }
    }
    return radius;
}
