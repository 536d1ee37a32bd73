// uses: gather/{input, packed_pixel}, kernel/constants, kernels/interleaved/{coarse, square}

// The fragment path packs squares from packed pixels; the compute path does as it packs these.

/// The packed pixels of a block, from left to right and from the top.
struct PackedBlock {
    a: vec2u,
    b: vec2u,
    c: vec2u,
    d: vec2u,
}

/// Those of `block`.
fn load_packed_block(pixels: texture_2d<u32>, block: vec2i) -> PackedBlock {
    let first = BLOCK_SIDE * block;
    return PackedBlock(
        load_packed_pixel(pixels, first),
        load_packed_pixel(pixels, first + vec2i(1, 0)),
        load_packed_pixel(pixels, first + vec2i(0, 1)),
        load_packed_pixel(pixels, first + vec2i(1, 1)),
    );
}

/// The square of a block's pixels.
fn square_of_block(packed: PackedBlock) -> InputPixel {
    return mean_pixel(
        unpack_pixel(packed.a),
        unpack_pixel(packed.b),
        unpack_pixel(packed.c),
        unpack_pixel(packed.d),
        1.0,
    );
}

/// The words of `block`.
fn packed_block(pixels: texture_2d<u32>, block: vec2i) -> vec2u {
    let packed = load_packed_block(pixels, block);
    let surface = surface_of_block(
        unpack_surface(packed.a.y),
        unpack_surface(packed.b.y),
        unpack_surface(packed.c.y),
        unpack_surface(packed.d.y),
    );
    return pack_block(surface, square_of_block(packed));
}

/// The words of the square of 4×4 pixels whose texel is `texel`.
fn packed_square(pixels: texture_2d<u32>, texel: vec2i) -> vec2u {
    let first = 2 * vec2i(texel.x, texel.y - block_rows());
    return pack_square(mean_pixel(
        square_of_block(load_packed_block(pixels, first)),
        square_of_block(load_packed_block(pixels, first + vec2i(1, 0))),
        square_of_block(load_packed_block(pixels, first + vec2i(0, 1))),
        square_of_block(load_packed_block(pixels, first + vec2i(1, 1))),
        f32(BLOCK_SIDE),
    ));
}
