// uses: gather/{classification, tile_listing}

/// Copies the pixels of a tile that do not scatter, and lists the tile if any scatters. An invocation takes 2×2 pixels.
@compute @workgroup_size(8, 8)
fn classify_compute(
    @builtin(workgroup_id) tile: vec3u,
    @builtin(global_invocation_id) invocation: vec3u,
    @builtin(local_invocation_index) index: u32,
) {
    begin_tile(index);
    let first = 2 * vec2i(invocation.xy);
    // All four, whatever the first one says: each is copied.
    let upper_left = classify_pixel(first);
    let upper_right = classify_pixel(first + vec2i(1, 0));
    let lower_left = classify_pixel(first + vec2i(0, 1));
    let lower_right = classify_pixel(first + vec2i(1, 1));
    if tile_scatters(upper_left || upper_right || lower_left || lower_right) && index == 0u {
        list_tile(tile.xy);
    }
}
