// uses: gather/tile_list; needs: dispatch_arguments, tiles

/// Whether a pixel of the workgroup's tile is translucent.
var<workgroup> tile_is_occupied: atomic<u32>;

/// Begins with a tile of which nothing is known. What the workgroup's memory held before counts for nothing.
fn begin_tile(index: u32) {
    if index == 0u {
        atomicStore(&tile_is_occupied, 0u);
    }
    workgroupBarrier();
}

/// Whether a pixel of the tile is translucent: `scatters` says it of the invocation's own pixels. The same answer for
/// the whole workgroup, behind a barrier. (Atomics came to `workgroupUniformLoad` in April 2025.)
fn tile_scatters(scatters: bool) -> bool {
    if scatters {
        atomicStore(&tile_is_occupied, 1u);
    }
    return workgroupUniformLoad(&tile_is_occupied) != 0u;
}

/// Puts a tile on the list.
fn list_tile(tile: vec2u) {
    let place = atomicAdd(&tiles.count, 1u);
    tiles.places[place] = TILE_LISTED | tile.x | (tile.y << 12u);
    atomicMax(&dispatch_arguments.x, min(place + 1u, LARGEST_DISPATCH));
    atomicMax(&dispatch_arguments.y, place / LARGEST_DISPATCH + 1u);
}
