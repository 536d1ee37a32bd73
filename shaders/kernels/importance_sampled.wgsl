// uses: gather/{curve, gathered, point, tap}, kernel/constants, lib/angle

// Importance-sampled gather in screen space, Liang et al. 2023 ([L23]) eq. (22):
//
//     L = Σ wᵢ Eᵢ / Σ wᵢ,   wᵢ = R(√(rᵢ² + dᵢ²)) / p(rᵢ)
//
// with rᵢ drawn from the profile of the widest channel, p its density per area, dᵢ the difference in depth and one
// weight per channel. Radii take the centres of equal strata of the CDF (the quantile diverges at u = 1, so strata are
// centred); directions follow the golden angle from a start that each pixel takes from a fixed pattern.

/// Light gathered for `point` by `taps` taps.
fn gather_importance_sampled(point: SurfacePoint, taps: u32, turn: f32) -> Gathered {
    var direction = vec2f(cos(turn), sin(turn));
    var gathered = Gathered(vec3f(0.0), vec3f(0.0));
    for (var tap = 0u; tap < taps; tap += 1u) {
        let u = (f32(tap) + 0.5) / f32(taps);
        let quantile = curve_quantile(point.widest.curve, u);
        gathered = together(gathered, tap_light(point, quantile, direction));
        direction = turned(direction, GOLDEN_TURN);
    }
    let share = 1.0 / f32(max(taps, 1u));
    return Gathered(share * gathered.irradiance, share * gathered.weight);
}
