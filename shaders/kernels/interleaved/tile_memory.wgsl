// uses: gather/{gathered, input, packed_pixel, tile}, kernel/constants, kernels/interleaved/far_fields

// What the pixels of a tile share, in workgroup memory: each is loaded once for all of them.

/// Side of a tile and a pixel around it.
const PIXELS_ACROSS: u32 = TILE_SIDE + 2u;

/// Side of a tile and a block around it, in blocks.
const BLOCKS_ACROSS: u32 = TILE_SIDE / u32(BLOCK_SIDE) + 2u;

/// Packed pixels of the tile and of a pixel around it, in rows.
var<workgroup> tile_pixels: array<vec2u, PIXELS_ACROSS * PIXELS_ACROSS>;

/// A far field in workgroup memory: twelve numbers, where a `FarField` takes sixteen.
struct TileField {
    /// Irradiance of its light, and its distance.
    irradiance: vec4f,
    /// Weight of its light, and its material.
    weight: vec4f,
    /// Share of the light that leaves the centre.
    leaving: vec4f,
}

/// Far fields of the tile's blocks and of a block around them, in rows.
var<workgroup> tile_fields: array<TileField, BLOCKS_ACROSS * BLOCKS_ACROSS>;

/// Keeps a far field for the workgroup, decoded once for all pixels that mix it.
fn keep_far_field(place: u32, field: FarField) {
    tile_fields[place] = TileField(
        vec4f(field.light.irradiance, field.surface.distance_mm),
        vec4f(field.light.weight, f32(field.surface.material)),
        vec4f(field.leaving, 0.0),
    );
}

/// Loads the tile that begins at `origin`, and what lies around it. The workgroup's invocations, one for each pixel of
/// the tile, share the work; `index` tells them apart. A barrier must follow.
fn load_tile(pixels: texture_2d<u32>, blocks: texture_2d<u32>, origin: vec2i, index: u32) {
    for (var place = index; place < PIXELS_ACROSS * PIXELS_ACROSS; place += TILE_SIDE * TILE_SIDE) {
        let apart = vec2i(vec2u(place % PIXELS_ACROSS, place / PIXELS_ACROSS)) - 1;
        tile_pixels[place] = load_packed_pixel(pixels, origin + apart);
    }
    if index < BLOCKS_ACROSS * BLOCKS_ACROSS {
        let apart = vec2i(vec2u(index % BLOCKS_ACROSS, index / BLOCKS_ACROSS)) - 1;
        keep_far_field(index, load_far_field(blocks, origin / BLOCK_SIDE + apart));
    }
}

/// The words of the pixel that lies `apart` from the tile's pixel `local`, at most one along each axis.
fn kept_pixel(local: vec2u, apart: vec2i) -> vec2u {
    let place = vec2u(vec2i(local) + 1 + apart);
    return tile_pixels[place.y * PIXELS_ACROSS + place.x];
}

/// The far field of the block that lies `apart` from that of the tile's pixel `local`, at most one along each axis.
fn kept_far_field(local: vec2u, apart: vec2i) -> FarField {
    let place = vec2u(vec2i(local) / BLOCK_SIDE + 1 + apart);
    let field = tile_fields[place.y * BLOCKS_ACROSS + place.x];
    return FarField(
        InputSurface(field.irradiance.w, i32(field.weight.w)),
        Gathered(field.irradiance.xyz, field.weight.xyz),
        field.leaving.xyz,
    );
}
