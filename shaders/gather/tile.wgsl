// uses: gather/tile_list; needs: tiles

// Tiles of the target: the stages of the compute path run over those that are listed.

/// Side of a tile, pixels.
const TILE_SIDE: u32 = 16u;

/// The listed tile of a workgroup; 0 where there is none.
fn listed_tile(group: vec3u) -> u32 {
    let place = group.y * LARGEST_DISPATCH + group.x;
    if place >= arrayLength(&tiles.places) {
        return 0u;
    }
    return tiles.places[place];
}

/// First pixel of a listed tile.
fn tile_origin(listed: u32) -> vec2i {
    return vec2i(vec2u(listed & 0xfffu, (listed >> 12u) & 0xfffu) * TILE_SIDE);
}
