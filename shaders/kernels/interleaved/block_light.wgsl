// uses: gather/{footprint, gathered, input, packed_pixel, point, view}, kernel/constants, kernels/interleaved/{block, far, near}, lib/shared_exponent, the material set; needs: subsurface_view

/// What a block keeps for its pixels: its far field, and their near field.
struct BlockLight {
    far: Gathered,
    near: NearField,
}

/// Far and near field of a block whose middle is `point`, among packed `pixels`.
///
/// A filter of less than a pixel leaves all light at the centre; up to two pixels it comes in by and by.
fn block_light(
    view: SubsurfaceView,
    pixels: texture_2d<u32>,
    point: SurfacePoint,
    block: vec2i,
) -> BlockLight {
    let taps = footprint_taps(point, u32(BLOCK_SIDE * BLOCK_SIDE) * min(view.taps, LARGEST_TAP_COUNT));
    if taps == 0u {
        return BlockLight(Gathered(vec3f(0.0), vec3f(0.0)), NearField(vec3f(1.0), vec3f(0.0), vec3f(0.0)));
    }
    let far = gather_far_field(pixels, point, taps, lattice_slice(block), view.frame_index);
    let near = near_field(point);
    let blend = footprint_blend(point);
    return BlockLight(
        Gathered(blend * far.irradiance, blend * far.weight),
        NearField(mix(vec3f(1.0), near.centre, blend), blend * near.beside, blend * near.across),
    );
}

/// What a block keeps, as two texels: irradiance and weight of its far field, share of the centre, and its surface; and
/// the shares of the ring.
struct BlockTexels {
    @location(0) light: vec4u,
    @location(1) ring: vec2u,
}

/// The texels of a block. Nine bits per number do, since a pixel mixes several blocks.
fn block_texels(light: BlockLight, block: Block) -> BlockTexels {
    // The mean, not the sum: then what rounding does to the weight changes no constant irradiance.
    let mean = light.far.irradiance / max(light.far.weight, vec3f(SMALLEST_WEIGHT));
    let lit = pack_lit_surface(InputSurface(block.distance_mm, block.material), mean);
    return BlockTexels(
        vec4u(lit.x, pack_shared_exponent(light.far.weight), pack_shared_exponent(light.near.centre), lit.y),
        vec2u(pack_shared_exponent(light.near.beside), pack_shared_exponent(light.near.across)),
    );
}

/// What a block keeps for its pixels, among packed `pixels`.
fn texels_of_block(pixels: texture_2d<u32>, block: vec2i) -> BlockTexels {
    let surface = block_of(block, pixels_of_block(pixels, block));
    if surface.material == NO_MATERIAL {
        return BlockTexels(vec4u(0u), vec2u(0u));
    }
    let point = surface_point(
        subsurface_view,
        surface.first_pixel,
        surface.position,
        surface.material,
        material_table[surface.material],
        surface.distance_mm,
        surface.surface_albedo,
        surface.mean_free_path_scale,
    );
    return block_texels(block_light(subsurface_view, pixels, point, block), surface);
}
