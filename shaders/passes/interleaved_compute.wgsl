/// Far fields and near shares of a tile's blocks.
@compute @workgroup_size(8, 8)
fn first_compute(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let tile = listed_tile(group);
    if tile == 0u {
        return;
    }
    let block = tile_origin(tile) / BLOCK_SIDE + vec2i(local.xy);
    let texels = texels_of_block(pixel_source, block);
    textureStore(four_word_target, block, texels.light);
    textureStore(two_word_target, block, vec4u(texels.ring, 0u, 0u));
}

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
    beside: vec3f,
    across: vec3f,
) {
    let surface = unpack_surface(own.y);
    if surface.material == NO_MATERIAL {
        return;
    }
    let pixel = BLOCK_SIDE * home + (side + 1) / 2;
    let texel = textureLoad(irradiance_texture, pixel, 0);
    let at = receiver_at(pixel, surface, texel);
    let diffused = diffuse_interleaved(at, side, subsurface_view.taps, fields, ring, beside, across);
    textureStore(diffused_target, pixel, vec4f(diffused, texel.a));
}

/// Diffused irradiance of a tile's translucent pixels. An invocation takes a block: its four pixels share twelve of
/// the sixteen pixels in their rings, and their far fields.
@compute @workgroup_size(8, 8)
fn subsurface_compute(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let tile = listed_tile(group);
    if tile == 0u {
        return;
    }
    let home = tile_origin(tile) / BLOCK_SIDE + vec2i(local.xy);
    let pixel = home * BLOCK_SIDE;
    let row_0 = load_pixel_row(pixel - vec2i(1, 1));
    let row_1 = load_pixel_row(pixel - vec2i(1, 0));
    let row_2 = load_pixel_row(pixel + vec2i(-1, 1));
    let row_3 = load_pixel_row(pixel + vec2i(-1, 2));
    let fields = load_far_fields(intermediate_source, home);
    let shares = textureLoad(second_intermediate_source, home, 0);
    let beside = unpack_shared_exponent(shares.x);
    let across = unpack_shared_exponent(shares.y);
    let upper_left = ring_of_second(row_0, row_1, row_2);
    let upper_right = ring_of_third(row_0, row_1, row_2);
    let lower_left = ring_of_second(row_1, row_2, row_3);
    let lower_right = ring_of_third(row_1, row_2, row_3);
    store_diffused(home, vec2i(-1, -1), row_1.b, fields, upper_left, beside, across);
    store_diffused(home, vec2i(1, -1), row_1.c, fields, upper_right, beside, across);
    store_diffused(home, vec2i(-1, 1), row_2.b, fields, lower_left, beside, across);
    store_diffused(home, vec2i(1, 1), row_2.c, fields, lower_right, beside, across);
}
