// Blocks of 2×2 pixels share one far field.

/// Side of a block, pixels.
const BLOCK_SIDE: i32 = 2;

/// Depth difference, in pixels, up to which pixels of one material belong to one block or to one far field.
const BLOCK_DEPTH_PIXELS: f32 = 6.0;

/// The pixels of a block that are of its first translucent pixel's material and depth, as one surface.
struct Block {
    /// The first of them.
    first_pixel: vec2i,
    /// Mean position, pixels.
    position: vec2f,
    /// Material number, or NO_MATERIAL where no pixel of the block is translucent.
    material: i32,
    /// Mean distance, mm.
    distance_mm: f32,
    /// Mean surface albedo.
    surface_albedo: vec3f,
    /// Mean factor on the mean free path.
    mean_free_path_scale: f32,
}

/// What a block keeps for its pixels: its far field, and their near field.
struct BlockLight {
    far: Gathered,
    near: NearField,
}

/// Reciprocal of the depth difference up to which pixels belong together, mm⁻¹; 0 where distance does not reject.
fn depth_scale(span_mm: f32) -> f32 {
    return select(0.0, 1.0 / (BLOCK_DEPTH_PIXELS * span_mm), REJECT_BY_DISTANCE);
}

/// How far a surface is in front of another or behind it, in BLOCK_DEPTH_PIXELS, at most 1.
fn apart_in_depth(depth_scale: f32, a_mm: f32, b_mm: f32) -> f32 {
    return min(abs(depth_scale * (a_mm - b_mm)), 1.0);
}

/// Share of what lies `apart` in depth that counts: 1 on the surface itself, 0 from 1 on.
///
/// A parabola: as good as the Gaussian that it stands for, without an exponential.
fn depth_agreement(apart: f32) -> f32 {
    return 1.0 - apart * apart;
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

/// A block as its pixels read it.
struct FarField {
    /// Where it lies; no material where the block has no surface.
    surface: InputSurface,
    /// Light from beyond the ring.
    light: Gathered,
    /// Share of the centre.
    centre: vec3f,
}

/// The far field of `block`.
fn load_far_field(blocks: texture_2d<u32>, block: vec2i) -> FarField {
    if any(block < vec2i(0)) || any(block >= vec2i(textureDimensions(blocks))) {
        return FarField(InputSurface(0.0, NO_MATERIAL), Gathered(vec3f(0.0), vec3f(0.0)), vec3f(0.0));
    }
    let words = textureLoad(blocks, block, 0);
    let weight = unpack_shared_exponent(words.y);
    let light = Gathered(weight * unpack_irradiance(words.xw), weight);
    return FarField(unpack_surface(words.w), light, unpack_shared_exponent(words.z));
}
