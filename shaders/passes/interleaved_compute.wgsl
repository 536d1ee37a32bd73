// uses: gather/{gathered, input, packed_pixel, tile}, kernel/constants, kernels/interleaved, kernels/interleaved/{block_light, far_fields, mixture, receiver, ring, rows, tile_memory, window}, lib/shared_exponent, passes/{subsurface, subsurface_compute}

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

/// The tile of the workgroup; see `listed_tile`.
var<workgroup> tile_of_group: u32;

/// Diffused irradiance of a tile's translucent pixels, for devices whose workgroup memory is fast. An invocation takes
/// a pixel; the workgroup loads what its pixels share.
@compute @workgroup_size(16, 16)
fn subsurface_compute(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_id) invocation: vec3u,
    @builtin(local_invocation_index) index: u32,
) {
    if index == 0u {
        tile_of_group = listed_tile(group);
    }
    let tile = workgroupUniformLoad(&tile_of_group);
    if tile == 0u {
        return;
    }
    let origin = tile_origin(tile);
    load_tile(pixel_source, intermediate_source, origin, index);
    workgroupBarrier();

    let local = invocation.xy;
    let surface = unpack_surface(kept_pixel(local, vec2i(0)).y);
    if surface.material == NO_MATERIAL {
        return;
    }
    let pixel = origin + vec2i(local);
    let texel = irradiance_at(pixel);
    let at = receiver_at(pixel, surface, texel);
    let side = vec2i(local & vec2u(1u)) * 2 - 1;
    let columns = window_shares(side.x, subsurface_view.taps);
    let rows = window_shares(side.y, subsurface_view.taps);
    var mixture = empty_mixture();
    for (var row = 0; row < 3; row += 1) {
        for (var column = 0; column < 3; column += 1) {
            let field = kept_far_field(local, vec2i(column, row) - 1);
            mixture = with_field(mixture, at, field, rows[row] * columns[column]);
        }
    }

    let counts = ring_counts(at, kept_far_field(local, vec2i(0)));
    let shares = textureLoad(second_intermediate_source, pixel / BLOCK_SIDE, 0);
    let beside = counts * unpack_shared_exponent(shares.x);
    let across = counts * unpack_shared_exponent(shares.y);
    var middle = Gathered(vec3f(0.0), vec3f(0.0));
    for (var neighbour = 0; neighbour < 8; neighbour += 1) {
        let apart = ring_place(neighbour);
        let beside_it = unpack_pixel(kept_pixel(local, apart));
        middle = together(middle, pixel_light(at, beside_it, apart, ring_share(apart, beside, across)));
    }
    textureStore(diffused_target, texture_position(pixel), vec4f(mixed_light(at, mixture, middle), texel.a));
}

/// The same for software drivers, whose workgroup memory is slow. An invocation takes a block: its four pixels share
/// twelve of the sixteen pixels in their rings, and their far fields.
@compute @workgroup_size(8, 8)
fn subsurface_software_compute(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
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
