// uses: gather/{channel, gathered, point, rejection}, kernel/constants, kernels/interleaved/{agreement, coarse, far_fields, ring}

// The light of the eight blocks around a block.

/// Shares of a profile's light on a flat surface, in the blocks around.
struct BlockRing {
    /// Of each block beside.
    beside: vec3f,
    /// Of each block across a corner.
    across: vec3f,
    /// How the density R falls with the distance ρ in space: about as (1 + falloff · (ρ²/r² − 1))⁻² from its value at
    /// the radius r on a flat surface.
    falloff: vec3f,
}

/// The shares of the blocks around `point`.
///
/// Blocks beside lie nearer than those across, and both take what shells of their area hold. A shell's light is its
/// area times the density R at its middle; as r·R falls as an exponential, with x half its logarithm from the one
/// shell to the other, sinh x / x times as much.
fn block_ring(point: SurfacePoint) -> BlockRing {
    let area = 0.25 * point.pixel_mm * point.pixel_mm;
    let beside = channel_area_pdf(point.profiles, BESIDE_RADIUS_PIXELS * point.pixel_mm);
    let across = channel_area_pdf(point.profiles, ACROSS_RADIUS_PIXELS * point.pixel_mm);
    let least = vec3f(SMALLEST_WEIGHT);
    let ratio = max(across, least) / max(beside, least);
    let x = 0.5 * log(ratio * (ACROSS_RADIUS_PIXELS / BESIDE_RADIUS_PIXELS));
    let squared = min(x * x, vec3f(4.0));
    let sinh_over_x = 1.0 + squared / 6.0 * (1.0 + squared / 20.0);
    let share = area * sinh_over_x;
    // The radii are as 1 : √2: there ρ²/r² − 1 is 1.
    return BlockRing(PIXELS_BESIDE * share * beside, PIXELS_ACROSS * share * across, inverseSqrt(ratio) - 1.0);
}

/// `sampled` light and that of the blocks around `block`, whose middle is `point`.
fn with_block_ring(
    sampled: Gathered,
    pixels: texture_2d<u32>,
    coarse: texture_2d<u32>,
    point: SurfacePoint,
    block: vec2i,
) -> Gathered {
    let ring = block_ring(point);
    // Zero at twice the depth at which a far field still serves.
    let per_step = 0.5 / (BLOCK_DEPTH_PIXELS * exp2(f32(depth_doublings(point))));
    var gathered = sampled;
    for (var neighbour = 0; neighbour < 8; neighbour += 1) {
        let apart = ring_place(neighbour);
        // Where the block is no square, one of its pixels: each as often as the others, and opposite ones in opposite
        // blocks.
        let which = (vec2i(neighbour, neighbour >> 1u) + block) & vec2i(1);
        let position = BLOCK_SIDE * (block + apart) + which;
        let pixel = coarse_pixel_at(pixels, coarse, false, position);
        if accepts_material(point, pixel.material) {
            let steps = depth_difference_mm(point, pixel.distance_mm) / point.pixel_mm;
            let squared_radius = f32(BLOCK_SIDE * BLOCK_SIDE * dot(apart, apart));
            let farther = vec3f(1.0) + ring.falloff * (steps * steps / squared_radius);
            let left = depth_agreement(min(abs(steps * per_step), 1.0)) / (farther * farther);
            let normal_share = accepted_by_normal(point.normal, position, point.span_mm);
            let weight = ring_share(apart, ring.beside, ring.across) * left * normal_share;
            gathered = together(gathered, Gathered(weight * pixel.irradiance, weight));
        }
    }
    return gathered;
}
