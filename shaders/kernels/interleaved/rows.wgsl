// uses: gather/{input, packed_pixel}, kernel/constants, kernels/interleaved, kernels/interleaved/{far_fields, near, receiver, ring}; needs: diffused_target, irradiance_at, pixel_source, subsurface_view, texture_position

// Rows of four pixels: what an invocation of the compute path loads once for the rings of a block's four pixels.

/// The words of four pixels of a row.
struct PixelRow {
    a: vec2u,
    b: vec2u,
    c: vec2u,
    d: vec2u,
}

/// Four pixels from `start` on to the right.
fn load_pixel_row(start: vec2i) -> PixelRow {
    return PixelRow(
        load_packed_pixel(pixel_source, start),
        load_packed_pixel(pixel_source, start + vec2i(1, 0)),
        load_packed_pixel(pixel_source, start + vec2i(2, 0)),
        load_packed_pixel(pixel_source, start + vec2i(3, 0)),
    );
}

/// The ring around the second pixel of the second of three rows.
fn ring_of_second(above: PixelRow, row: PixelRow, below: PixelRow) -> Ring {
    return Ring(
        unpack_pixel(row.a),
        unpack_pixel(row.c),
        unpack_pixel(above.b),
        unpack_pixel(below.b),
        unpack_pixel(above.a),
        unpack_pixel(above.c),
        unpack_pixel(below.a),
        unpack_pixel(below.c),
    );
}

/// The ring around the third pixel of the second of three rows.
fn ring_of_third(above: PixelRow, row: PixelRow, below: PixelRow) -> Ring {
    return Ring(
        unpack_pixel(row.b),
        unpack_pixel(row.d),
        unpack_pixel(above.c),
        unpack_pixel(below.c),
        unpack_pixel(above.b),
        unpack_pixel(above.d),
        unpack_pixel(below.b),
        unpack_pixel(below.d),
    );
}

/// Diffuses the light of the pixel on `side` of block `home`, whose words are `own`, and stores it, if it is
/// translucent.
fn store_diffused(
    home: vec2i,
    side: vec2i,
    own: vec2u,
    fields: FarFields,
    ring: Ring,
    shares: PixelShares,
) {
    let surface = unpack_surface(own.y);
    if surface.material == NO_MATERIAL {
        return;
    }
    let pixel = BLOCK_SIDE * home + (side + 1) / 2;
    let texel = irradiance_at(pixel);
    let at = receiver_at(pixel, surface, texel);
    let diffused = diffuse_interleaved(at, side, subsurface_view.taps, fields, ring, shares);
    textureStore(diffused_target, texture_position(pixel), vec4f(diffused, texel.a));
}
