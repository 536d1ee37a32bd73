// uses: lib/{angle, exponential}; needs: gaussian_sum_area_pdf, gaussian_sum_term

// Sum of Gaussians: R(r) / A = Σ wᵢ G(vᵢ, r), G(v, r) = e^(−r²/2v) / (2πv), Σ wᵢ = 1 per channel.
// [GG3] d'Eon and Luebke 2007, GPU Gems 3, chapter 14.
// From the material set come `gaussian_sum_term(i)`, (weight red, green, blue; variance in mm²), and the functions that
// add the terms up: `gaussian_sum_area_pdf(profile, radius_mm)` and `gaussian_sum_radial_cdf(profile, radius_mm)`.

/// Where this model's terms stand among all Gaussian terms of the set.
struct GaussianSumModel {
    first_term: u32,
    term_count: u32,
}

/// (first term, one past the last term, channel, 0). Variances are absolute, so neither the surface albedo nor a
/// length enters.
fn gaussian_sum_profile(model: GaussianSumModel, channel: u32) -> vec4f {
    return vec4f(f32(model.first_term), f32(model.first_term + model.term_count), f32(channel), 0.0);
}

/// Term `place` of the sum: its weight in the channel, and its variance in mm². No weight beyond the last term.
fn gaussian_term(profile: vec4f, place: u32) -> vec2f {
    let index = u32(profile.x) + place;
    let last = u32(profile.y) - 1u;
    let term = gaussian_sum_term(min(index, last));
    return vec2f(select(0.0, term[u32(profile.z)], index <= last), term.w);
}

/// A term's share of R(r) / A per unit area, mm⁻².
fn gaussian_term_area_pdf(profile: vec4f, place: u32, radius_mm: f32) -> f32 {
    let term = gaussian_term(profile, place);
    return term.x * exp(-radius_mm * radius_mm / (2.0 * term.y)) / (TAU * term.y);
}

/// A term's share of the fraction of the energy within `radius_mm`: w (1 − e^(−r²/2v)).
fn gaussian_term_radial_cdf(profile: vec4f, place: u32, radius_mm: f32) -> f32 {
    let term = gaussian_term(profile, place);
    return term.x * one_minus_exp(radius_mm * radius_mm / (2.0 * term.y));
}

/// 2πr R(r) / A per unit radius, mm⁻¹.
fn gaussian_sum_radial_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    return TAU * radius_mm * gaussian_sum_area_pdf(profile, radius_mm);
}

/// Inverse of `gaussian_sum_radial_cdf`.
///
/// In x = r² the logarithm of the energy outside, ln Σ wᵢ e^(−x/2vᵢ), is convex and falls, so Newton's method rises
/// monotonically from any start left of the root. Two such starts: Jensen's bound x ≥ −ln(1 − u) / Σ wᵢ/2vᵢ and the
/// tail of each term alone, x ≥ 2vᵢ (ln wᵢ − ln(1 − u)).
fn gaussian_sum_sample_radius(profile: vec4f, u: f32) -> f32 {
    let target_log = negative_log_complement(u); // −ln(1 − u)
    let channel = u32(profile.z);
    var mean_rate = 0.0;
    var x = 0.0;
    for (var i = u32(profile.x); i < u32(profile.y); i += 1u) {
        let term = gaussian_sum_term(i);
        let weight = term[channel];
        if weight > 0.0 {
            mean_rate += weight / (2.0 * term.w);
            x = max(x, 2.0 * term.w * (target_log + log(weight)));
        }
    }
    x = max(x, target_log / mean_rate);
    for (var step = 0; step < 10; step += 1) {
        var inside = 0.0; // Σ wᵢ (1 − e^(−x/2vᵢ))
        var outside = 0.0; // Σ wᵢ e^(−x/2vᵢ)
        var rate = 0.0; // −d(outside)/dx
        for (var i = u32(profile.x); i < u32(profile.y); i += 1u) {
            let term = gaussian_sum_term(i);
            let decay = exp(-x / (2.0 * term.w));
            inside += term[channel] * one_minus_exp(x / (2.0 * term.w));
            outside += term[channel] * decay;
            rate += term[channel] * decay / (2.0 * term.w);
        }
        // ln(outside) through whichever of the two sums still holds its digits.
        let outside_log = select(-log(outside), negative_log_complement(inside), inside < 0.5);
        let advance = (target_log - outside_log) * outside / rate;
        x = max(x + advance, 0.0);
        if advance <= 1e-7 * x {
            break;
        }
    }
    return sqrt(x);
}
