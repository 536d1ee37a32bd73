// uses: gather/tile, kernels/single_stage, passes/{subsurface, subsurface_compute}

/// Diffused irradiance of a tile's translucent pixels.
@compute @workgroup_size(16, 16)
fn subsurface_compute(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let tile = listed_tile(group);
    let pixel = tile_origin(tile) + vec2i(local.xy);
    if tile == 0u || !is_inside(pixel) {
        return;
    }
    textureStore(diffused_target, texture_position(pixel), diffuse_single_stage(pixel));
}
