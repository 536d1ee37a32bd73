// uses: gather/tile_list, the material set

/// What the first stage of the kernel left for the second, if it has two.
@group(2) @binding(0) var intermediate_source: texture_2d<u32>;
/// Squares of pixels that the classification packed.
@group(2) @binding(1) var coarse_source: texture_2d<u32>;
/// Pixels that the classification packed.
@group(2) @binding(2) var pixel_source: texture_2d<u32>;
/// Where a first stage leaves four words.
@group(2) @binding(3) var four_word_target: texture_storage_2d<rgba32uint, write>;
/// Where a first stage leaves two words, and the classification packs squares.
@group(2) @binding(4) var two_word_target: texture_storage_2d<rg32uint, write>;
/// Where the classification packs pixels.
@group(2) @binding(5) var pixel_target: texture_storage_2d<rg32uint, write>;
/// Tiles that hold translucent pixels.
@group(2) @binding(6) var<storage, read_write> tiles: TileList;
/// Arguments of the indirect dispatch over the tiles.
@group(2) @binding(7) var<storage, read_write> dispatch_arguments: DispatchArguments;
/// The result.
@group(2) @binding(8) var diffused_target: DiffusedTexture;
