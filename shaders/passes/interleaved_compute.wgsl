// uses: gather/tile, kernel/constants, kernels/interleaved/{block_light, far_fields, rows}, lib/shared_exponent, passes/subsurface_compute

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
