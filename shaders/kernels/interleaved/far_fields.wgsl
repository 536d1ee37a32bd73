// uses: gather/{gathered, input, packed_pixel}, lib/shared_exponent

/// A block as its pixels read it.
struct FarField {
    /// Where it lies; no material where the block has no surface.
    surface: InputSurface,
    /// Light from beyond the ring.
    light: Gathered,
    /// Share of the light that leaves the centre.
    leaving: vec3f,
}

/// The words that the first stage left of `block`: zero outside of the target.
fn far_field_words(blocks: texture_2d<u32>, block: vec2i) -> vec4u {
    if any(block < vec2i(0)) || any(block >= vec2i(textureDimensions(blocks))) {
        return vec4u(0u);
    }
    return textureLoad(blocks, block, 0);
}

/// The far field that `words` hold; of no material where they are zero.
fn unpack_far_field(words: vec4u) -> FarField {
    let weight = unpack_shared_exponent(words.y);
    let light = Gathered(weight * unpack_irradiance(words.xw), weight);
    return FarField(unpack_surface(words.w), light, vec3f(1.0) - unpack_shared_exponent(words.z));
}

/// The far field of `block`.
fn load_far_field(blocks: texture_2d<u32>, block: vec2i) -> FarField {
    return unpack_far_field(far_field_words(blocks, block));
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

/// The far fields around a pixel of block `home`.
fn load_far_fields(blocks: texture_2d<u32>, home: vec2i) -> FarFields {
    return FarFields(
        load_far_field(blocks, home + vec2i(-1, -1)),
        load_far_field(blocks, home + vec2i(0, -1)),
        load_far_field(blocks, home + vec2i(1, -1)),
        load_far_field(blocks, home + vec2i(-1, 0)),
        load_far_field(blocks, home),
        load_far_field(blocks, home + vec2i(1, 0)),
        load_far_field(blocks, home + vec2i(-1, 1)),
        load_far_field(blocks, home + vec2i(0, 1)),
        load_far_field(blocks, home + vec2i(1, 1)),
    );
}
