// uses: gather/{input, packed_pixel}, the material set; needs: diffused_target, input_surface, irradiance_at, is_inside, pixel_target, texture_position

/// Copies the pixel at `position` unless it scatters, and packs it where the kernel wants that. Returns whether it
/// scatters.
fn classify_pixel(position: vec2i) -> bool {
    if !is_inside(position) {
        return false;
    }
    let surface = input_surface(position);
    let scatters = surface.material != NO_MATERIAL;
    if scatters && !PACKS_PIXELS {
        return true;
    }
    let texel = irradiance_at(position);
    if PACKS_PIXELS {
        textureStore(pixel_target, position, vec4u(pack_pixel(surface, texel.rgb), 0u, 0u));
    }
    if !scatters {
        textureStore(diffused_target, texture_position(position), texel);
    }
    return scatters;
}
