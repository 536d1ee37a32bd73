// uses: gather/{gathered, input, packed_pixel, tile}, kernel/constants, kernels/interleaved/{coarse, far_fields, near}

// What the pixels of a tile share, in workgroup memory: each is loaded once for all of them.

/// Side of a tile and a pixel around it.
const PIXELS_WIDE: u32 = TILE_SIDE + 2u;

/// Side of a tile and a block around it, in blocks.
const BLOCKS_WIDE: u32 = TILE_SIDE / u32(BLOCK_SIDE) + 2u;

/// Side of a tile in blocks.
const BLOCKS_OF_TILE: u32 = TILE_SIDE / u32(BLOCK_SIDE);

/// Irradiance and distance of the pixels of the tile and of a pixel around it, in rows: unpacked once for all rings.
var<workgroup> tile_light: array<vec4f, PIXELS_WIDE * PIXELS_WIDE>;

/// Their material numbers; one that gives no light has UNLIT less its number.
var<workgroup> tile_material: array<i32, PIXELS_WIDE * PIXELS_WIDE>;

/// Below NO_MATERIAL.
const UNLIT: i32 = -2;

/// A far field in workgroup memory, in the order that leaves a gap at the end alone.
struct TileField {
    irradiance: vec3f,
    distance_mm: f32,
    weight: vec3f,
    depth_factor: f32,
    material: i32,
}

/// Shares of the pixels in the tile's blocks, in rows.
var<workgroup> tile_shares: array<PixelShares, BLOCKS_OF_TILE * BLOCKS_OF_TILE>;

/// Far fields of the tile's blocks and of a block around them, in rows.
var<workgroup> tile_fields: array<TileField, BLOCKS_WIDE * BLOCKS_WIDE>;

/// Keeps a far field for the workgroup, decoded once for all pixels that mix it.
fn keep_far_field(place: u32, field: FarField) {
    tile_fields[place] = TileField(
        field.light.irradiance,
        field.surface.distance_mm,
        field.light.weight,
        field.depth_factor,
        field.surface.material,
    );
}

/// Keeps a pixel for the workgroup.
fn keep_pixel(place: u32, words: vec2u) {
    let surface = unpack_surface(words.y);
    let pixel = unpack_pixel(words);
    let is_unlit = pixel.material == NO_MATERIAL && surface.material != NO_MATERIAL;
    tile_light[place] = vec4f(pixel.irradiance, surface.distance_mm);
    tile_material[place] = select(pixel.material, UNLIT - surface.material, is_unlit);
}

/// Loads the tile that begins at `origin`, and what lies around it. The workgroup's invocations, one for each pixel of
/// the tile, share the work; `index` tells them apart. A barrier must follow.
fn load_tile(
    pixels: texture_2d<u32>,
    coarse: texture_2d<u32>,
    blocks: texture_2d<u32>,
    origin: vec2i,
    index: u32,
) {
    for (var place = index; place < PIXELS_WIDE * PIXELS_WIDE; place += TILE_SIDE * TILE_SIDE) {
        let apart = vec2i(vec2u(place % PIXELS_WIDE, place / PIXELS_WIDE)) - 1;
        keep_pixel(place, load_packed_pixel(pixels, origin + apart));
    }
    if index < BLOCKS_WIDE * BLOCKS_WIDE {
        let apart = vec2i(vec2u(index % BLOCKS_WIDE, index / BLOCKS_WIDE)) - 1;
        let block = origin / BLOCK_SIDE + apart;
        let words = far_field_words(blocks, block);
        keep_far_field(index, unpack_far_field(block_surface(coarse, block), words));
        if all(vec2u(apart) < vec2u(BLOCKS_OF_TILE)) {
            let place = vec2u(apart);
            tile_shares[place.y * BLOCKS_OF_TILE + place.x] = pixel_shares(unpack_near_field(words));
        }
    }
}

/// Place of the pixel that lies `apart` from the tile's pixel `local`, at most one along each axis.
fn place_of_pixel(local: vec2u, apart: vec2i) -> u32 {
    let place = vec2u(vec2i(local) + 1 + apart);
    return place.y * PIXELS_WIDE + place.x;
}

/// The surface of the tile's pixel `local`.
fn kept_surface(local: vec2u) -> InputSurface {
    let place = place_of_pixel(local, vec2i(0));
    let material = tile_material[place];
    return InputSurface(tile_light[place].w, select(material, UNLIT - material, material <= UNLIT));
}

/// The pixel that lies `apart` from the tile's pixel `local`, at most one along each axis.
fn kept_pixel(local: vec2u, apart: vec2i) -> InputPixel {
    let place = place_of_pixel(local, apart);
    let light = tile_light[place];
    return InputPixel(light.xyz, light.w, max(tile_material[place], NO_MATERIAL));
}

/// The far field of the block that lies `apart` from that of the tile's pixel `local`, at most one along each axis.
fn kept_far_field(local: vec2u, apart: vec2i) -> FarField {
    let place = vec2u(vec2i(local) / BLOCK_SIDE + 1 + apart);
    let field = tile_fields[place.y * BLOCKS_WIDE + place.x];
    return FarField(
        InputSurface(field.distance_mm, field.material),
        Gathered(field.irradiance, field.weight),
        field.depth_factor,
    );
}

/// Shares of the tile's pixel `local` and of those around it.
fn kept_shares(local: vec2u) -> PixelShares {
    let block = local / u32(BLOCK_SIDE);
    return tile_shares[block.y * BLOCKS_OF_TILE + block.x];
}
