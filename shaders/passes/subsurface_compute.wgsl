// uses: gather/{classification, tile_list}, the material set

/// What the first stage of the kernel left for the second, if it has two.
@group(2) @binding(0) var intermediate_source: texture_2d<u32>;
/// The rest of it, where one texel is too small.
@group(2) @binding(1) var second_intermediate_source: texture_2d<u32>;
/// Pixels that the classification packed.
@group(2) @binding(2) var pixel_source: texture_2d<u32>;
/// Where a first stage leaves four words.
@group(2) @binding(3) var four_word_target: texture_storage_2d<rgba32uint, write>;
/// Where a first stage leaves two words.
@group(2) @binding(4) var two_word_target: texture_storage_2d<rg32uint, write>;
/// Where the classification packs pixels.
@group(2) @binding(5) var pixel_target: texture_storage_2d<rg32uint, write>;
/// Tiles that hold translucent pixels.
@group(2) @binding(6) var<storage, read_write> tiles: TileList;
/// Arguments of the indirect dispatch over the tiles.
@group(2) @binding(7) var<storage, read_write> dispatch_arguments: DispatchArguments;
/// The result.
@group(2) @binding(8) var diffused_target: DiffusedTexture;

/// Whether a pixel of the workgroup's tile is translucent.
var<workgroup> tile_is_occupied: atomic<u32>;

/// Copies the pixels of a tile that do not scatter, packs all where the kernel wants that, and lists the tile if any
/// scatters. An invocation takes 2×2 pixels.
@compute @workgroup_size(8, 8)
fn classify_compute(
    @builtin(workgroup_id) tile: vec3u,
    @builtin(global_invocation_id) invocation: vec3u,
    @builtin(local_invocation_index) index: u32,
) {
    let first = 2 * vec2i(invocation.xy);
    // All four, whatever the first one says: each is copied or packed.
    let upper_left = classify_pixel(first);
    let upper_right = classify_pixel(first + vec2i(1, 0));
    let lower_left = classify_pixel(first + vec2i(0, 1));
    let lower_right = classify_pixel(first + vec2i(1, 1));
    if upper_left || upper_right || lower_left || lower_right {
        atomicStore(&tile_is_occupied, 1u);
    }
    // A barrier, and the same answer for the whole workgroup. (Atomics came to this function in April 2025.)
    if workgroupUniformLoad(&tile_is_occupied) == 0u {
        // Later stages leave this tile out: it must not keep the light of an earlier frame.
        textureStore(four_word_target, vec2i(invocation.xy), vec4u(0u));
        return;
    }
    if index == 0u {
        let place = atomicAdd(&tiles.count, 1u);
        tiles.places[place] = TILE_LISTED | tile.x | (tile.y << 12u);
        atomicMax(&dispatch_arguments.x, min(place + 1u, LARGEST_DISPATCH));
        atomicMax(&dispatch_arguments.y, place / LARGEST_DISPATCH + 1u);
    }
}
