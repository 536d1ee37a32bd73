// uses: gather/tile, kernels/separable, passes/{subsurface, subsurface_compute}

/// First pass over a tile.
@compute @workgroup_size(16, 16)
fn first_compute(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let tile = listed_tile(group);
    let pixel = tile_origin(tile) + vec2i(local.xy);
    if tile == 0u || !is_inside(pixel) {
        return;
    }
    // The first pass reads no intermediate texture; whichever is bound serves.
    textureStore(two_word_target, pixel, vec4u(blur_first(pixel, intermediate_source), 0u, 0u));
}

/// Diffused irradiance of a tile's translucent pixels.
@compute @workgroup_size(16, 16)
fn subsurface_compute(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let tile = listed_tile(group);
    let pixel = tile_origin(tile) + vec2i(local.xy);
    if tile == 0u || !is_inside(pixel) {
        return;
    }
    textureStore(diffused_target, texture_position(pixel), blur_second(pixel, intermediate_source));
}
