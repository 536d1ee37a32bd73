// uses: gather/input; needs: diffused_target, input_surface, irradiance_at, is_inside, texture_position

/// Copies the pixel at `position` unless it scatters. Returns whether it scatters.
fn classify_pixel(position: vec2i) -> bool {
    if !is_inside(position) {
        return false;
    }
    let scatters = input_surface(position).material != NO_MATERIAL;
    if !scatters {
        textureStore(diffused_target, texture_position(position), irradiance_at(position));
    }
    return scatters;
}
