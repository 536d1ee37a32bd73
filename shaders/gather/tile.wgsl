// needs: tiles

// Tiles of the target: the compute path lists those that hold a translucent pixel, and its stages run over the list.

/// Side of a tile, pixels.
const TILE_SIDE: u32 = 16u;

/// Largest number of workgroups along one axis that every device takes.
const LARGEST_DISPATCH: u32 = 65535u;

/// Bit that tells a tile from an entry that was not written.
const TILE_LISTED: u32 = 0x80000000u;

/// The tiles that later stages run over.
struct TileList {
    /// Number of tiles.
    count: atomic<u32>,
    /// Their places: TILE_LISTED, the row from bit 12 on, and the column. Zero behind the last.
    places: array<u32>,
}

/// Workgroups of an indirect dispatch.
struct DispatchArguments {
    /// The number of tiles, up to LARGEST_DISPATCH.
    x: atomic<u32>,
    /// Rows of that many which hold all tiles; the last may be longer than the list.
    y: atomic<u32>,
    /// 1.
    z: u32,
}

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
