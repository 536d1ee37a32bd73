// uses: gather/{footprint, input, point, tile}, kernel/constants, kernels/{importance_sampled, probe}, kernels/interleaved/near, lib/{angle, noise}; needs: input_surface, subsurface_view, taps_at

// Views are numbers of `DebugView`. Where nothing scatters alpha is 0, elsewhere 1.

/// Taps per pixel that are drawn white: black is 0, white 128 and more.
const DEBUG_LARGEST_TAPS: f32 = 128.0;

/// Filter radius, pixels, that is drawn white: black is 0, white 128 and more.
const DEBUG_LARGEST_RADIUS: f32 = 128.0;

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
            // The scale is logarithmic: a few taps and a hundred both show. The same number has the same colour
            // whatever the estimator and its budget.
            return heat(log2(1.0 + taps) / log2(1.0 + DEBUG_LARGEST_TAPS));
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
            return near.centre + near.ring;
        }
        case DEBUG_VARIANCE: {
            return heat(relative_deviation(point));
        }
        default: {
            return vec3f(0.0);
        }
    }
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

/// Colour of a tile's pixel: green where the tile is listed, brighter where the pixel scatters, black at the border.
fn tile_colour(pixel: vec2i, scatters: bool) -> vec3f {
    let listed = select(vec3f(0.05, 0.05, 0.1), vec3f(0.1, 0.4, 0.15), tile_has_surface(pixel));
    let is_border = any(pixel % i32(TILE_SIDE) == vec2i(0));
    return select(listed + select(0.0, 0.4, scatters), vec3f(0.0), is_border);
}
