// uses: lib/numeric_limits

/// 1 − e^(−x) for x ≥ 0, without the cancellation of the direct form.
///
/// Below 1/8 the alternating series to x⁵ is exact to f32 rounding: its first dropped term is x⁵/720 of the value.
fn one_minus_exp(x: f32) -> f32 {
    if x < 0.125 {
        return x * (1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0))));
    }
    return 1.0 - exp(-x);
}

/// ln(1 + x) for x ≥ 0, accurate for small x.
///
/// ln(1 + x) = 2 artanh(t) with t = x / (2 + x); for x < 1/8 the series to t⁵ is exact to f32 rounding.
fn log_one_plus(x: f32) -> f32 {
    if x < 0.125 {
        let t = x / (2.0 + x);
        let t2 = t * t;
        return 2.0 * t * (1.0 + t2 * (1.0 / 3.0 + t2 * (1.0 / 5.0)));
    }
    return log(1.0 + x);
}

/// −ln(1 − u) for u in [0, 1), accurate for small u; u = 1 is taken for the largest f32 below 1.
fn negative_log_complement(u: f32) -> f32 {
    let below_one = min(u, LARGEST_BELOW_ONE);
    // −ln(1 − u) = ln(1 + u / (1 − u)), which keeps the digits of a small u.
    return log_one_plus(below_one / (1.0 - below_one));
}
