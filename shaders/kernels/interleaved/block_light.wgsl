// uses: gather/{footprint, gathered, input, packed_pixel, point, view}, kernel/constants, kernels/interleaved/{block, block_ring, far, far_fields, near}, lib/shared_exponent, the material set; needs: subsurface_view

/// What a block keeps for its pixels: its far field, and their near field.
struct BlockLight {
    /// From beyond the disc of nine pixels.
    far: Gathered,
    near: NearField,
    /// See `FarField`.
    doublings: u32,
}

/// Far and near field of a block whose middle is `point`.
///
/// A filter of less than a pixel leaves all light at the centre; up to two pixels it comes in by and by.
fn block_light(
    view: SubsurfaceView,
    pixels: texture_2d<u32>,
    coarse: texture_2d<u32>,
    point: SurfacePoint,
    block: vec2i,
) -> BlockLight {
    let taps = footprint_taps(point, far_taps(min(view.taps, LARGEST_TAP_COUNT)));
    if taps == 0u {
        return BlockLight(Gathered(vec3f(0.0), vec3f(0.0)), NearField(vec3f(1.0), vec3f(0.0)), 0u);
    }
    let sampled = gather_far_field(view, pixels, coarse, point, taps, lattice_slice(block));
    let near = near_field(point);
    let far = with_block_ring(sampled, pixels, coarse, point, block);
    let blend = footprint_blend(point);
    return BlockLight(
        Gathered(blend * far.irradiance, blend * far.weight),
        NearField(mix(vec3f(1.0), near.centre, blend), blend * near.ring),
        depth_doublings(point),
    );
}

/// What a block keeps, as a texel: the mean irradiance of its far field, the weight of that, the share of the centre
/// and that of the ring. Nine bits per number do, since a pixel mixes several blocks.
fn block_texel(light: BlockLight) -> vec4u {
    // The mean, not the sum: then what rounding does to the weight changes no constant irradiance.
    let mean = light.far.irradiance / max(light.far.weight, vec3f(SMALLEST_WEIGHT));
    let form = share_exponent(mean, LARGEST_PACKED_IRRADIANCE, LIGHT_STEP_EXPONENT);
    // A ring of less than all has no use for the last bit of its exponent: the sixth of the irradiance's takes it.
    let ring = pack_shared_exponent(min(light.near.ring, vec3f(LARGEST_RING)));
    return vec4u(
        form.mantissas | (form.exponent << 27u),
        pack_weight(light.far.weight, light.doublings),
        pack_shared_exponent(light.near.centre),
        ring | ((form.exponent >> 5u) << 31u),
    );
}

/// What a block keeps for its pixels, with what `coarse` holds of the blocks around.
fn texel_of_block(pixels: texture_2d<u32>, coarse: texture_2d<u32>, block: vec2i) -> vec4u {
    let surface = block_of(block, pixels_of_block(pixels, block));
    if surface.material == NO_MATERIAL {
        return vec4u(0u);
    }
    let point = surface_point(
        subsurface_view,
        surface.nearest_pixel,
        surface.position,
        surface.material,
        material_table[surface.material],
        surface.distance_mm,
        surface.surface_albedo,
        surface.mean_free_path_scale,
    );
    return block_texel(block_light(subsurface_view, pixels, coarse, point, block));
}
