// uses: gather/{curve, gathered, point, tap, view}, kernel/constants, kernels/interleaved/{coarse, window}, lib/angle, the material set

// The light from beyond the ring of blocks: sampled.

/// The golden ratio's fraction, turns: from one frame to the next.
const GOLDEN_FRACTION: f32 = 0.61803399;

/// Slice of the lattice that a block takes: 0…3, each once in any 2×2 blocks, and in turn around these.
fn lattice_slice(block: vec2i) -> i32 {
    return ((block.x + block.y) & 1) + 2 * (block.y & 1);
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

/// What reading squares of `side` pixels adds to the mean square distance, pixels²: along an axis side²/12 from a tap's
/// position to the middle of its square, and (side² − 1)/12 from there to its pixels; less 1/12, which reading pixels
/// adds and summing them too.
fn reading_variance(side: f32) -> f32 {
    return (side * side - 1.0) / 3.0;
}

/// Light that enters `point`, the middle of a block, from beyond the disc of 36 pixels.
///
/// A slice is turned by a quarter from the one before and differs by half a stratum in radius: those of two blocks
/// across a corner are opposite, so that what falls evenly over both comes out as it is. Frames differ by the golden
/// ratio's part of a turn.
fn gather_far_field(
    view: SubsurfaceView,
    pixels: texture_2d<u32>,
    coarse: texture_2d<u32>,
    point: SurfacePoint,
    taps: u32,
    slice: i32,
) -> Gathered {
    var gathered = Gathered(vec3f(0.0), vec3f(0.0));
    let u_inner = profile_radial_cdf(point.widest, FAR_RADIUS_PIXELS * point.pixel_mm / FAR_STRETCH);
    if taps == 0u || u_inner >= FAR_QUANTILE {
        return gathered;
    }
    let u_range = FAR_QUANTILE - u_inner;
    let reads_squares = is_sparse(point, taps);
    // What squares and windows blur, taps nearer to the point make up for: the mean square radius of what is sampled
    // stays as it is.
    let side = f32(BLOCK_SIDE) * select(1.0, 2.0, reads_squares);
    let blur = (reading_variance(side) + 2.0 * window_variance(view.taps)) * point.pixel_mm * point.pixel_mm;
    let turns = LATTICE_START + f32(slice) / f32(LATTICE_SLICES) + GOLDEN_FRACTION * f32(view.frame_index % 64u);
    let start = TAU * fract(turns);
    var direction = vec2f(cos(start), sin(start));
    for (var tap = 0u; tap < taps; tap += 1u) {
        let stratum = (f32(tap) + 0.25 + 0.5 * f32(slice & 1)) / f32(taps);
        let quantile = FAR_STRETCH * curve_quantile(point.widest.curve, u_inner + stratum * u_range);
        let radius_mm = sqrt(max(quantile.x * quantile.x - blur, 0.0));
        let position = tap_position(point, radius_mm, direction);
        let pixel = coarse_pixel_at(pixels, coarse, reads_squares, position);
        gathered = together(gathered, light_of_tap(point, quantile, position, pixel));
        direction = turned(direction, LATTICE_TURN);
    }
    let share = u_range / f32(taps);
    return Gathered(share * gathered.irradiance, share * gathered.weight);
}
