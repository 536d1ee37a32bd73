// uses: gather/{input, packed_pixel}, the material set; needs: diffused_target, input_surface, irradiance_texture, is_inside, pixel_target

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
    let texel = textureLoad(irradiance_texture, position, 0);
    if PACKS_PIXELS {
        textureStore(pixel_target, position, vec4u(pack_pixel(surface, texel.rgb), 0u, 0u));
    }
    if !scatters {
        textureStore(diffused_target, position, texel);
    }
    return scatters;
}
