// uses: gather/{curve, point, tap}, kernel/constants, lib/angle

// Taps that only look: what the debug views estimate.

/// Taps that estimate rejection and variance.
const DEBUG_PROBES: u32 = 64u;

/// Standard deviation of single taps over their mean, in the widest channel: 0 where all light is alike.
fn relative_deviation(point: SurfacePoint) -> f32 {
    var direction = vec2f(1.0, 0.0);
    // Sums are in units of the brightest tap so far: squares of irradiance itself need not be finite.
    var brightest = 0.0;
    var sum = 0.0;
    var squares = 0.0;
    var weights = 0.0;
    for (var tap = 0u; tap < DEBUG_PROBES; tap += 1u) {
        let quantile = curve_quantile(point.widest.curve, (f32(tap) + 0.5) / f32(DEBUG_PROBES));
        let light = tap_light(point, quantile, direction);
        let weight = light.weight[point.widest_channel];
        let irradiance = light.irradiance[point.widest_channel] / max(weight, SMALLEST_WEIGHT);
        if irradiance > brightest {
            let ratio = brightest / irradiance;
            sum *= ratio;
            squares *= ratio * ratio;
            brightest = irradiance;
        }
        if brightest > 0.0 {
            let relative = irradiance / brightest;
            sum += weight * relative;
            squares += weight * relative * relative;
        }
        weights += weight;
        direction = turned(direction, GOLDEN_TURN);
    }
    let total = max(weights, SMALLEST_WEIGHT);
    let mean = sum / total;
    let variance = max(squares / total - mean * mean, 0.0);
    return select(0.0, sqrt(variance) / mean, mean > SMALLEST_WEIGHT);
}
