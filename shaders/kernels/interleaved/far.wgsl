// uses: gather/{curve, gathered, packed_pixel, point, tap}, kernel/constants, lib/angle, the material set

// The light from beyond the ring of a pixel's neighbours: sampled.

/// The golden ratio's fraction, turns: from one frame to the next.
const GOLDEN_FRACTION: f32 = 0.61803399;

/// Slice of the lattice that a block takes: 0…3, each once in any 2×2 blocks.
fn lattice_slice(block: vec2i) -> f32 {
    return f32((block.x & 1) + 2 * ((block.x + block.y) & 1));
}

/// Light that enters `point`, the middle of a block, from beyond the disc of nine pixels, as packed `pixels` have it.
///
/// Slices differ by a quarter of a stratum in radius and by a quarter turn; frames by the golden ratio's part of a
/// turn.
fn gather_far_field(
    pixels: texture_2d<u32>,
    point: SurfacePoint,
    taps: u32,
    slice: f32,
    frame: u32,
) -> Gathered {
    var gathered = Gathered(vec3f(0.0), vec3f(0.0));
    let u_inner = profile_radial_cdf(point.widest, FAR_RADIUS_PIXELS * point.pixel_mm / FAR_STRETCH);
    if taps == 0u || u_inner >= FAR_QUANTILE {
        return gathered;
    }
    let u_range = FAR_QUANTILE - u_inner;
    let start = TAU * fract(slice / f32(LATTICE_SLICES) + GOLDEN_FRACTION * f32(frame % 64u));
    var direction = vec2f(cos(start), sin(start));
    for (var tap = 0u; tap < taps; tap += 1u) {
        let stratum = (f32(tap) + (slice + 0.5) / f32(LATTICE_SLICES)) / f32(taps);
        let quantile = FAR_STRETCH * curve_quantile(point.widest.curve, u_inner + stratum * u_range);
        let position = tap_position(point, quantile.x, direction);
        let pixel = unpack_pixel(load_packed_pixel(pixels, position));
        gathered = together(gathered, light_of_tap(point, quantile, position, pixel));
        direction = turned(direction, GOLDEN_TURN);
    }
    let share = u_range / f32(taps);
    return Gathered(share * gathered.irradiance, share * gathered.weight);
}
