// uses: gather/{footprint, input, packed_pixel, point, view}, kernel/constants, kernels/interleaved, kernels/interleaved/{block_light, far_fields, receiver, ring}, lib/shared_exponent, passes/{subsurface, subsurface_fragment}

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
    let home = pixel / BLOCK_SIDE;
    let fields = load_far_fields(intermediate_texture, home);
    let ring = Ring(
        unpack_pixel(load_packed_pixel(pixel_texture, pixel + vec2i(-1, 0))),
        unpack_pixel(load_packed_pixel(pixel_texture, pixel + vec2i(1, 0))),
        unpack_pixel(load_packed_pixel(pixel_texture, pixel + vec2i(0, -1))),
        unpack_pixel(load_packed_pixel(pixel_texture, pixel + vec2i(0, 1))),
        unpack_pixel(load_packed_pixel(pixel_texture, pixel + vec2i(-1, -1))),
        unpack_pixel(load_packed_pixel(pixel_texture, pixel + vec2i(1, -1))),
        unpack_pixel(load_packed_pixel(pixel_texture, pixel + vec2i(-1, 1))),
        unpack_pixel(load_packed_pixel(pixel_texture, pixel + vec2i(1, 1))),
    );
    let shares = textureLoad(second_intermediate_texture, home, 0);
    let diffused = diffuse_interleaved(
        receiver_at(pixel, surface, own),
        (pixel % BLOCK_SIDE) * 2 - 1,
        subsurface_view.taps,
        fields,
        ring,
        unpack_shared_exponent(shares.x),
        unpack_shared_exponent(shares.y),
    );
    return vec4f(diffused, own.a);
}
