// uses: gather/{gathered, input, tile, tile_listing}, kernel/constants, kernels/interleaved, kernels/interleaved/{block_light, coarse, far_fields, mixture, near, packing, receiver, ring, rows, square, tile_memory, window}, passes/{subsurface, subsurface_compute}

/// The squares of a tile's blocks, in rows.
var<workgroup> tile_squares: array<InputPixel, BLOCKS_OF_TILE * BLOCKS_OF_TILE>;

/// Copies the pixels of a tile that do not scatter, packs all and their squares, and lists the tile if any scatters. An
/// invocation takes a block.
@compute @workgroup_size(8, 8)
fn classify_compute(
    @builtin(workgroup_id) tile: vec3u,
    @builtin(global_invocation_id) invocation: vec3u,
    @builtin(local_invocation_index) index: u32,
) {
    begin_tile(index);
    let packed = pack_inputs_of_block(vec2i(invocation.xy));
    tile_squares[index] = packed.light;
    if tile_scatters(packed.surface.material != NO_MATERIAL) && index == 0u {
        list_tile(tile.xy);
    }
    // Four blocks are a square.
    let side = BLOCKS_OF_TILE / 2u;
    if index < side * side {
        let within = vec2u(index % side, index / side);
        let first = 2u * (within.y * BLOCKS_OF_TILE + within.x);
        let square = mean_pixel(
            tile_squares[first],
            tile_squares[first + 1u],
            tile_squares[first + BLOCKS_OF_TILE],
            tile_squares[first + BLOCKS_OF_TILE + 1u],
            f32(BLOCK_SIDE),
        );
        let place = coarse_texel(vec2i(tile.xy * side + within));
        textureStore(two_word_target, place, vec4u(pack_square(square), 0u, 0u));
    }
}

/// Far fields and near shares of a tile's blocks.
@compute @workgroup_size(8, 8)
fn first_compute(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let tile = listed_tile(group);
    if tile == 0u {
        return;
    }
    let block = tile_origin(tile) / BLOCK_SIDE + vec2i(local.xy);
    textureStore(four_word_target, block, texel_of_block(pixel_source, coarse_source, block));
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
    load_tile(pixel_source, coarse_source, intermediate_source, origin, index);
    workgroupBarrier();

    let local = invocation.xy;
    let surface = kept_surface(local);
    if surface.material == NO_MATERIAL {
        return;
    }
    let pixel = origin + vec2i(local);
    let texel = irradiance_at(pixel);
    let at = receiver_at(pixel, surface, texel);
    let side = vec2i(local & vec2u(1u)) * 2 - 1;
    let columns = window_shares(side.x, subsurface_view.taps);
    let rows = window_shares(side.y, subsurface_view.taps);
    var mixture = Gathered(vec3f(0.0), vec3f(0.0));
    for (var row = 0; row < 3; row += 1) {
        for (var column = 0; column < 3; column += 1) {
            let field = kept_far_field(local, vec2i(column, row) - 1);
            mixture = with_field(mixture, at, field, rows[row] * columns[column]);
        }
    }

    let shares = kept_shares(local);
    var ring = Gathered(vec3f(0.0), vec3f(0.0));
    for (var neighbour = 0; neighbour < 8; neighbour += 1) {
        let apart = ring_place(neighbour);
        let neighbour_pixel = kept_pixel(local, apart);
        ring = together(ring, pixel_light(at, neighbour_pixel, apart, ring_share(apart, shares.beside, shares.across)));
    }
    let is_home = accepts_far_field(at, kept_far_field(local, vec2i(0)).surface);
    let diffused = mixed_light(at, mixture, shares.centre, ring, is_home);
    textureStore(diffused_target, texture_position(pixel), vec4f(diffused, texel.a));
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
    let words = far_field_words(intermediate_source, home);
    let fields = load_far_fields(intermediate_source, coarse_source, home, words);
    let shares = pixel_shares(unpack_near_field(words));
    let upper_left = ring_of_second(row_0, row_1, row_2);
    let upper_right = ring_of_third(row_0, row_1, row_2);
    let lower_left = ring_of_second(row_1, row_2, row_3);
    let lower_right = ring_of_third(row_1, row_2, row_3);
    store_diffused(home, vec2i(-1, -1), row_1.b, fields, upper_left, shares);
    store_diffused(home, vec2i(1, -1), row_1.c, fields, upper_right, shares);
    store_diffused(home, vec2i(-1, 1), row_2.b, fields, lower_left, shares);
    store_diffused(home, vec2i(1, 1), row_2.c, fields, lower_right, shares);
}
