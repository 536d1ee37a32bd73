// uses: gather/{footprint, gathered, input, packed_pixel, point, view}, kernel/constants, kernels/interleaved, kernels/interleaved/{block_light, coarse, coarse_square, far, far_fields, mixture, near, receiver, ring, window}, passes/{subsurface, subsurface_fragment}

/// Taps per pixel of the far field, with those that the blocks around stand for.
fn taps_at(point: SurfacePoint) -> f32 {
    let budget = min(subsurface_view.taps, LARGEST_TAP_COUNT);
    let taps = footprint_taps(point, far_taps(budget)) + min(budget, RING_TAPS);
    return f32(taps) / f32(BLOCK_SIDE * BLOCK_SIDE);
}

/// The pixels packed.
@fragment
fn pack_fragment(@builtin(position) position: vec4f) -> @location(0) vec2u {
    let pixel = vec2i(position.xy);
    return pack_pixel(input_surface(pixel), irradiance_at(pixel).rgb);
}

/// The blocks packed.
@fragment
fn block_fragment(@builtin(position) position: vec4f) -> @location(0) vec2u {
    return packed_block(pixel_texture, vec2i(position.xy));
}

/// The squares of 4×4 pixels packed, below the blocks.
@fragment
fn square_fragment(@builtin(position) position: vec4f) -> @location(0) vec2u {
    return packed_square(pixel_texture, vec2i(position.xy));
}

/// What the first stage keeps of a block.
@fragment
fn first_fragment(@builtin(position) position: vec4f) -> @location(0) vec4u {
    return texel_of_block(pixel_texture, coarse_texture, vec2i(position.xy));
}

/// Diffused irradiance of translucent pixels; every other pixel keeps its irradiance.
@fragment
fn subsurface_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = viewport_position(subsurface_view, position);
    let own = irradiance_at(pixel);
    let surface = unpack_surface(load_packed_pixel(pixel_texture, pixel).y);
    if surface.material == NO_MATERIAL {
        return own;
    }
    let at = receiver_at(pixel, surface, own);
    let home = pixel / BLOCK_SIDE;
    let side = (pixel % BLOCK_SIDE) * 2 - 1;
    let columns = window_shares(side.x, subsurface_view.taps);
    let rows = window_shares(side.y, subsurface_view.taps);
    var mixture = Gathered(vec3f(0.0), vec3f(0.0));
    for (var row = 0; row < 3; row += 1) {
        for (var column = 0; column < 3; column += 1) {
            let field = load_far_field(intermediate_texture, coarse_texture, home + vec2i(column, row) - 1);
            mixture = with_field(mixture, at, field, rows[row] * columns[column]);
        }
    }
    let shares = pixel_shares(unpack_near_field(far_field_words(intermediate_texture, home)));
    var ring = Gathered(vec3f(0.0), vec3f(0.0));
    for (var neighbour = 0; neighbour < 8; neighbour += 1) {
        let apart = ring_place(neighbour);
        let neighbour_pixel = unpack_pixel(load_packed_pixel(pixel_texture, pixel + apart));
        ring = together(ring, pixel_light(at, neighbour_pixel, apart, ring_share(apart, shares.beside, shares.across)));
    }
    let is_home = accepts_far_field(at, block_surface(coarse_texture, home));
    return vec4f(mixed_light(at, mixture, shares.centre, ring, is_home), own.a);
}
