// uses: lib/{dipole_source, exponential, numeric_limits}

// The inverse that profiles of exponentials and dipole sources share: 1 − cdf(r) = Σ w e^(−r/d) + Σ w D(z),
// D(z) = (z/ρ) e^(−s(ρ − z)), ρ = √(r² + z²).

/// Radius within which the fraction u of the light leaves: of two exponentials of lengths `lengths` and two sources at
/// `depths` with one attenuation, whose shares are `weights`, in this order.
///
/// Newton's method in ln r on the logarithm of the cdf or, in the far half, of the tail: both are nearly straight. A
/// mixture's quantile lies between those of its parts, and the mean of their logarithms is a good start. Three
/// evaluations in the mean and five at most over all published coefficients.
fn exponential_source_radius(weights: vec4f, lengths: vec2f, depths: vec2f, attenuation: f32, u: f32) -> f32 {
    let target_log = negative_log_complement(u);
    if target_log <= 0.0 {
        return 0.0;
    }
    let first = dipole_source_radius_bounds(depths.x, attenuation, target_log);
    let second = dipole_source_radius_bounds(depths.y, attenuation, target_log);
    let lowest = vec4f(lengths * target_log, first.x, second.x);
    // Not those of parts without a share: where the tail of the others has underflowed, no step leads back.
    let highest = select(vec4f(0.0), vec4f(lengths * target_log, first.y, second.y), weights > vec4f(0.0));
    var low = log(max(min(min(lowest.x, lowest.y), min(lowest.z, lowest.w)), SMALLEST_RADIUS_MM));
    var high = max(log(max(max(highest.x, highest.y), max(highest.z, highest.w))), low);
    var log_radius = clamp(dot(weights, log(max(highest, vec4f(SMALLEST_RADIUS_MM)))), low, high);
    for (var step = 0; step < 12; step += 1) {
        let radius = exp(log_radius);
        let ratios = radius / lengths;
        let decays = exp(-ratios);
        let of_first = dipole_source_distribution(depths.x, attenuation, radius);
        let of_second = dipole_source_distribution(depths.y, attenuation, radius);
        // r times the density per radius: the slope of the cdf over ln r.
        let slope = dot(weights, vec4f(ratios * decays, of_first.z, of_second.z));
        var newton: f32;
        if u < 0.5 {
            let near = vec2f(one_minus_exp(ratios.x), one_minus_exp(ratios.y));
            let cdf = dot(weights, vec4f(near, of_first.x, of_second.x));
            newton = log(cdf / u) * cdf / slope;
        } else {
            let tail = dot(weights, vec4f(decays, of_first.y, of_second.y));
            newton = (-log(tail) - target_log) * tail / slope;
        }
        if newton > 0.0 {
            high = log_radius;
        } else {
            low = log_radius;
        }
        var next = log_radius - newton;
        if !(next >= low && next <= high) {
            next = 0.5 * (low + high);
        }
        let change = abs(next - log_radius);
        log_radius = next;
        // The error after a step is of the order of its square.
        if change <= 5e-4 {
            break;
        }
    }
    return exp(log_radius);
}
