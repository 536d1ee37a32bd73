// uses: gather/{input, packed_pixel}, kernel/constants, kernels/interleaved/{coarse, square}, lib/numeric_limits; needs: diffused_target, input_surface, irradiance_at, is_inside, pixel_target, texture_position, two_word_target

/// What was packed.
struct PackedInput {
    surface: InputSurface,
    /// What it gives to others.
    light: InputPixel,
}

/// Packs the pixel at `position`, and copies it unless it scatters.
fn pack_input(position: vec2i) -> PackedInput {
    if !is_inside(position) {
        return PackedInput(InputSurface(0.0, NO_MATERIAL), InputPixel(vec3f(0.0), 0.0, NO_MATERIAL));
    }
    let surface = input_surface(position);
    let texel = irradiance_at(position);
    textureStore(pixel_target, position, vec4u(pack_pixel(surface, texel.rgb), 0u, 0u));
    if surface.material == NO_MATERIAL {
        textureStore(diffused_target, texture_position(position), texel);
    }
    let material = select(NO_MATERIAL, surface.material, is_finite_rgb(texel.rgb));
    // The limit of packed pixels: a square is the mean of what these hold.
    let light = min(finite_irradiance(texel.rgb), vec3f(LARGEST_PACKED_IRRADIANCE));
    return PackedInput(surface, InputPixel(light, surface.distance_mm, material));
}

/// Packs a block and its pixels: its surface, and the light of all.
fn pack_inputs_of_block(block: vec2i) -> PackedInput {
    let first = BLOCK_SIDE * block;
    let a = pack_input(first);
    let b = pack_input(first + vec2i(1, 0));
    let c = pack_input(first + vec2i(0, 1));
    let d = pack_input(first + vec2i(1, 1));
    let surface = surface_of_block(a.surface, b.surface, c.surface, d.surface);
    let light = mean_pixel(a.light, b.light, c.light, d.light, 1.0);
    // Below the last row lie the squares of 4×4 pixels.
    if block.y < block_rows() {
        textureStore(two_word_target, block, vec4u(pack_block(surface, light), 0u, 0u));
    }
    return PackedInput(surface, light);
}
