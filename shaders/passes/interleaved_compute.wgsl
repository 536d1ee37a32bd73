/// Far fields and near shares of a tile's blocks, and their pixels packed for the second stage.
@compute @workgroup_size(8, 8)
fn first_compute(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let tile = listed_tile(group);
    if tile == 0u {
        return;
    }
    let block = tile_origin(tile) / BLOCK_SIDE + vec2i(local.xy);
    let pixels = pixels_of_block(block);
    let first = BLOCK_SIDE * block;
    store_packed_pixel(first, pixels.a.surface);
    store_packed_pixel(first + vec2i(1, 0), pixels.b.surface);
    store_packed_pixel(first + vec2i(0, 1), pixels.c.surface);
    store_packed_pixel(first + vec2i(1, 1), pixels.d.surface);
    let texels = texels_of_block(block, pixels);
    textureStore(four_word_target, block, texels.light);
    textureStore(two_word_target, block, vec4u(texels.ring, 0u, 0u));
}

/// Packs the pixel at `position`, which shows `surface`.
fn store_packed_pixel(position: vec2i, surface: InputSurface) {
    let irradiance = textureLoad(irradiance_texture, position, 0).rgb;
    textureStore(pixel_target, position, vec4u(pack_pixel(surface, irradiance), 0u, 0u));
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
        load_packed_pixel(start),
        load_packed_pixel(start + vec2i(1, 0)),
        load_packed_pixel(start + vec2i(2, 0)),
        load_packed_pixel(start + vec2i(3, 0)),
    );
}

/// The words of the pixel at `position`; zero outside of the target.
fn load_packed_pixel(position: vec2i) -> vec2u {
    if !is_inside(position) {
        return vec2u(0u);
    }
    return textureLoad(pixel_source, position, 0).rg;
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

/// Diffuses the light of the pixel of words `own` and stores it, if it is translucent.
fn store_diffused(
    pixel: vec2i,
    own: vec2u,
    fields: NearestFarFields,
    ring: Ring,
    beside: vec3f,
    across: vec3f,
) {
    if own.y == 0u {
        return;
    }
    let texel = textureLoad(irradiance_texture, pixel, 0);
    let at = receiver_at(pixel, unpack_surface(own.y), texel);
    let diffused = diffuse_interleaved(at, fields, ring, beside, across);
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
    let middle = load_far_field(intermediate_source, home);
    let left = load_far_field(intermediate_source, home + vec2i(-1, 0));
    let right = load_far_field(intermediate_source, home + vec2i(1, 0));
    let above = load_far_field(intermediate_source, home + vec2i(0, -1));
    let below = load_far_field(intermediate_source, home + vec2i(0, 1));
    let above_left = load_far_field(intermediate_source, home + vec2i(-1, -1));
    let above_right = load_far_field(intermediate_source, home + vec2i(1, -1));
    let below_left = load_far_field(intermediate_source, home + vec2i(-1, 1));
    let below_right = load_far_field(intermediate_source, home + vec2i(1, 1));
    let shares = textureLoad(second_intermediate_source, home, 0);
    let beside = unpack_shared_exponent(shares.x);
    let across = unpack_shared_exponent(shares.y);
    store_diffused(
        pixel,
        row_1.b,
        NearestFarFields(middle, left, above, above_left),
        ring_of_second(row_0, row_1, row_2),
        beside,
        across,
    );
    store_diffused(
        pixel + vec2i(1, 0),
        row_1.c,
        NearestFarFields(middle, right, above, above_right),
        ring_of_third(row_0, row_1, row_2),
        beside,
        across,
    );
    store_diffused(
        pixel + vec2i(0, 1),
        row_2.b,
        NearestFarFields(middle, left, below, below_left),
        ring_of_second(row_1, row_2, row_3),
        beside,
        across,
    );
    store_diffused(
        pixel + vec2i(1, 1),
        row_2.c,
        NearestFarFields(middle, right, below, below_right),
        ring_of_third(row_1, row_2, row_3),
        beside,
        across,
    );
}
