// uses: gather/{footprint, gathered, input, packed_pixel, point, view}, kernel/constants, kernels/interleaved, kernels/interleaved/{block_light, far_fields, mixture, receiver, ring, window}, lib/shared_exponent, passes/{subsurface, subsurface_fragment}

/// Taps per pixel of the far field.
fn taps_at(point: SurfacePoint) -> f32 {
    let pixels = u32(BLOCK_SIDE * BLOCK_SIDE);
    return f32(footprint_taps(point, pixels * min(subsurface_view.taps, LARGEST_TAP_COUNT))) / f32(pixels);
}

/// The pixels packed.
@fragment
fn pack_fragment(@builtin(position) position: vec4f) -> @location(0) vec2u {
    let pixel = vec2i(position.xy);
    return pack_pixel(input_surface(pixel), irradiance_at(pixel).rgb);
}

/// What the first stage keeps of a block.
@fragment
fn first_fragment(@builtin(position) position: vec4f) -> BlockTexels {
    return texels_of_block(pixel_texture, vec2i(position.xy));
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
    var mixture = empty_mixture();
    for (var row = 0; row < 3; row += 1) {
        for (var column = 0; column < 3; column += 1) {
            let field = load_far_field(intermediate_texture, home + vec2i(column, row) - 1);
            mixture = with_field(mixture, at, field, rows[row] * columns[column]);
        }
    }
    let counts = ring_counts(at, load_far_field(intermediate_texture, home));
    let shares = textureLoad(second_intermediate_texture, home, 0);
    let beside = counts * unpack_shared_exponent(shares.x);
    let across = counts * unpack_shared_exponent(shares.y);
    var middle = Gathered(vec3f(0.0), vec3f(0.0));
    for (var neighbour = 0; neighbour < 8; neighbour += 1) {
        let apart = ring_place(neighbour);
        let beside_it = unpack_pixel(load_packed_pixel(pixel_texture, pixel + apart));
        middle = together(middle, pixel_light(at, beside_it, apart, ring_share(apart, beside, across)));
    }
    return vec4f(mixed_light(at, mixture, middle), own.a);
}
