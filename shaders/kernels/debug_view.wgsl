// uses: gather/{footprint, input, point, tile}, kernels/{importance_sampled, probe}, kernels/interleaved/near, lib/{angle, noise}; needs: input_surface, most_taps, subsurface_view, taps_at

const DEBUG_TAPS: u32 = 1u;
const DEBUG_FILTER_RADIUS: u32 = 2u;
const DEBUG_REJECTED_ENERGY: u32 = 3u;
const DEBUG_NEAR_SHARE: u32 = 4u;
const DEBUG_VARIANCE: u32 = 5u;
const DEBUG_TILES: u32 = 6u;

/// Filter radius, pixels, that is drawn white.
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
