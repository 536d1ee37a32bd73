// uses: gather/{gathered, input, packed_pixel, point}, kernel/constants, kernels/interleaved/{coarse, near}, lib/shared_exponent; needs: is_inside

/// A block as its pixels read it.
struct FarField {
    /// Where it lies; no material where the block has no surface.
    surface: InputSurface,
    /// Light from beyond the ring.
    light: Gathered,
    /// What the depth from it to a pixel is multiplied by: 2^−`depth_doublings`.
    depth_factor: f32,
}

/// How often BLOCK_DEPTH_PIXELS doubles and stays within a third of the filter radius, which is about two mean radii: a
/// surface as near as that sees the same far field.
fn depth_doublings(point: SurfacePoint) -> u32 {
    let reach = min(point.filter_radius_pixels, LARGEST_FILTER_RADIUS) / (3.0 * BLOCK_DEPTH_PIXELS);
    return u32(clamp(log2(max(reach, 1.0)), 0.0, 7.0));
}

/// Lowest bits of the three mantissas: those of a weight hold a number of doublings in their place.
const LOW_BITS: u32 = 1u | (1u << 9u) | (1u << 18u);

/// A weight in mantissas of eight bits, and a number of doublings up to 7.
fn pack_weight(weight: vec3f, doublings: u32) -> u32 {
    let bits = vec3u(doublings, doublings >> 1u, doublings >> 2u) & vec3u(1u);
    return (pack_shared_exponent(weight) & ~LOW_BITS) | bits.x | (bits.y << 9u) | (bits.z << 18u);
}

/// The weight that `pack_weight` packed.
fn unpack_weight(stored: u32) -> vec3f {
    return unpack_shared_exponent(stored & ~LOW_BITS);
}

/// 2 to the power of minus the doublings that `pack_weight` packed.
fn unpack_depth_factor(stored: u32) -> f32 {
    let doublings = (stored & 1u) + 2u * ((stored >> 9u) & 1u) + 4u * ((stored >> 18u) & 1u);
    return bitcast<f32>((127u - doublings) << 23u);
}

/// The words that the first stage left of `block`: zero outside of the target.
fn far_field_words(blocks: texture_2d<u32>, block: vec2i) -> vec4u {
    if !is_inside(BLOCK_SIDE * block) {
        return vec4u(0u);
    }
    return textureLoad(blocks, block, 0);
}

/// The far field that `words` hold, of a block at `surface`.
fn unpack_far_field(surface: InputSurface, words: vec4u) -> FarField {
    let weight = unpack_weight(words.y);
    let light = Gathered(weight * unpack_irradiance(words.xw), weight);
    return FarField(surface, light, unpack_depth_factor(words.y));
}

/// The near field that `words` hold.
fn unpack_near_field(words: vec4u) -> NearField {
    return NearField(unpack_shared_exponent(words.z), unpack_shared_exponent(words.w & 0x7fffffffu));
}

/// The far field of `block`.
fn load_far_field(blocks: texture_2d<u32>, coarse: texture_2d<u32>, block: vec2i) -> FarField {
    return unpack_far_field(block_surface(coarse, block), far_field_words(blocks, block));
}

/// The far fields around a pixel: of its own block and of the eight blocks around that.
///
/// Nine members, not an array: software drivers copy an array to memory when a loop indexes it, and keep members in
/// registers.
struct FarFields {
    above_left: FarField,
    above: FarField,
    above_right: FarField,
    left: FarField,
    home: FarField,
    right: FarField,
    below_left: FarField,
    below: FarField,
    below_right: FarField,
}

/// The far fields around a pixel of block `home`, which left `words`.
fn load_far_fields(blocks: texture_2d<u32>, coarse: texture_2d<u32>, home: vec2i, words: vec4u) -> FarFields {
    return FarFields(
        load_far_field(blocks, coarse, home + vec2i(-1, -1)),
        load_far_field(blocks, coarse, home + vec2i(0, -1)),
        load_far_field(blocks, coarse, home + vec2i(1, -1)),
        load_far_field(blocks, coarse, home + vec2i(-1, 0)),
        unpack_far_field(block_surface(coarse, home), words),
        load_far_field(blocks, coarse, home + vec2i(1, 0)),
        load_far_field(blocks, coarse, home + vec2i(-1, 1)),
        load_far_field(blocks, coarse, home + vec2i(0, 1)),
        load_far_field(blocks, coarse, home + vec2i(1, 1)),
    );
}
