const DEBUG_TAPS: u32 = 1u;
const DEBUG_FILTER_RADIUS: u32 = 2u;
const DEBUG_REJECTED_ENERGY: u32 = 3u;
const DEBUG_NEAR_SHARE: u32 = 4u;
const DEBUG_VARIANCE: u32 = 5u;
const DEBUG_TILES: u32 = 6u;

/// Filter radius, pixels, that is drawn white.
const DEBUG_LARGEST_RADIUS: f32 = 128.0;

/// Taps that estimate rejection and variance.
const DEBUG_PROBES: u32 = 64u;

/// From black over red and yellow to white as `value` goes from 0 to 1.
fn heat(value: f32) -> vec3f {
    return clamp(vec3f(3.0 * value) - vec3f(0.0, 1.0, 2.0), vec3f(0.0), vec3f(1.0));
}

/// What a debug view shows of the gather at a translucent pixel, as a colour.
fn debug_colour(pixel: vec2i, point: SurfacePoint) -> vec3f {
    switch subsurface_view.debug_view {
        case DEBUG_TAPS: {
            // A filter of less than a pixel takes none.
            let taps = select(taps_at(point), 0.0, footprint_taps(point, subsurface_view.taps) == 0u);
            // The scale is logarithmic: a few taps and a thousand both show. White is the largest number.
            return heat(log2(1.0 + taps) / log2(1.0 + max(most_taps(), 1.0)));
        }
        case DEBUG_FILTER_RADIUS: {
            return heat(log2(1.0 + point.filter_radius_pixels) / log2(1.0 + DEBUG_LARGEST_RADIUS));
        }
        case DEBUG_REJECTED_ENERGY: {
            let turn = TAU * interleaved_gradient_noise(pixel, subsurface_view.frame_index);
            let found = gather_importance_sampled(point, DEBUG_PROBES, turn).weight;
            return heat(1.0 - min(found[point.widest_channel], 1.0));
        }
        case DEBUG_NEAR_SHARE: {
            let near = near_field(point);
            return near.centre + 4.0 * (near.beside + near.across);
        }
        case DEBUG_VARIANCE: {
            return heat(relative_deviation(point));
        }
        default: {
            return vec3f(0.0);
        }
    }
}

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

/// Whether a pixel of the tile that holds `pixel` is translucent.
fn tile_has_surface(pixel: vec2i) -> bool {
    let side = i32(TILE_SIDE);
    let origin = pixel / side * side;
    for (var place = 0; place < side * side; place += 1) {
        let position = origin + vec2i(place % side, place / side);
        if input_surface(position).material != NO_MATERIAL {
            return true;
        }
    }
    return false;
}

/// The debug view in place of the diffused irradiance.
@fragment
fn debug_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let surface = input_surface(pixel);
    if subsurface_view.debug_view == DEBUG_TILES {
        let listed = select(vec3f(0.05, 0.05, 0.1), vec3f(0.1, 0.4, 0.15), tile_has_surface(pixel));
        let is_border = any(pixel % i32(TILE_SIDE) == vec2i(0));
        let covered = select(0.0, 0.4, surface.material != NO_MATERIAL);
        return vec4f(select(listed + covered, vec3f(0.0), is_border), 1.0);
    }
    if surface.material == NO_MATERIAL {
        return vec4f(0.0, 0.0, 0.0, 1.0);
    }
    return vec4f(debug_colour(pixel, surface_point_at(pixel, surface)), 1.0);
}
