// uses: gather/{curve, gathered, point, tap}, kernel/constants, kernels/interleaved/coarse, lib/angle, the material set

// The light from beyond the ring of blocks: sampled.

/// The golden ratio's fraction, turns: from one frame to the next.
const GOLDEN_FRACTION: f32 = 0.61803399;

/// Slice of the lattice that a block takes: 0…3, each once in any 2×2 blocks.
fn lattice_slice(block: vec2i) -> i32 {
    return (block.x & 1) + 2 * ((block.x + block.y) & 1);
}

/// Taps of a block for its far field, where a pixel has a budget of `taps`: the blocks around cost as much as
/// RING_TAPS do, and stand for as many.
fn far_taps(taps: u32) -> u32 {
    return u32(BLOCK_SIDE * BLOCK_SIDE) * taps - min(taps, RING_TAPS);
}

/// Whether taps lie so far apart that they read squares of 4×4 pixels. These are as wide as the lattice's period, so
/// that a small light counts the same wherever it lies.
fn is_sparse(point: SurfacePoint, taps: u32) -> bool {
    let radius = min(point.filter_radius_pixels, LARGEST_FILTER_RADIUS);
    return radius * radius >= SPARSE_TAP_AREA * f32(LATTICE_SLICES * taps);
}

/// Light that enters `point`, the middle of a block, from beyond the disc of 36 pixels.
///
/// Slices differ by a quarter of a stratum in radius and by a quarter turn; frames by the golden ratio's part of a
/// turn.
fn gather_far_field(
    coarse: texture_2d<u32>,
    point: SurfacePoint,
    taps: u32,
    slice: i32,
    frame: u32,
) -> Gathered {
    var gathered = Gathered(vec3f(0.0), vec3f(0.0));
    let u_inner = profile_radial_cdf(point.widest, FAR_RADIUS_PIXELS * point.pixel_mm / FAR_STRETCH);
    if taps == 0u || u_inner >= FAR_QUANTILE {
        return gathered;
    }
    let u_range = FAR_QUANTILE - u_inner;
    let reads_squares = is_sparse(point, taps);
    let start = TAU * fract(f32(slice) / f32(LATTICE_SLICES) + GOLDEN_FRACTION * f32(frame % 64u));
    var direction = vec2f(cos(start), sin(start));
    for (var tap = 0u; tap < taps; tap += 1u) {
        let stratum = (f32(tap) + (f32(slice) + 0.5) / f32(LATTICE_SLICES)) / f32(taps);
        let quantile = FAR_STRETCH * curve_quantile(point.widest.curve, u_inner + stratum * u_range);
        let position = tap_position(point, quantile.x, direction);
        let pixel = coarse_pixel_at(coarse, reads_squares, position);
        gathered = together(gathered, light_of_tap(point, quantile, position, pixel));
        direction = turned(direction, LATTICE_TURN);
    }
    let share = u_range / f32(taps);
    return Gathered(share * gathered.irradiance, share * gathered.weight);
}
