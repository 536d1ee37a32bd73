// The list of the tiles that hold a translucent pixel, and the dispatch over it.

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
