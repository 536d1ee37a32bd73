// A pixel of the inputs in two words: the irradiance with a shared exponent, and distance with material. Eight bytes in
// one load, where the inputs take three loads and twenty bytes and more.

/// Bits of a key that hold the material number + 1; the others hold the distance.
const MATERIAL_MASK: u32 = (1u << MATERIAL_BITS) - 1u;

/// A word that holds no irradiance: every mantissa and the exponent at their largest, which packed light stays below.
const NO_LIGHT: u32 = 0xffffffffu;

/// Material number + 1 and distance of a surface; 0 where there is none.
fn pack_surface(surface: InputSurface) -> u32 {
    if surface.material == NO_MATERIAL {
        return 0u;
    }
    let half_step = (MATERIAL_MASK + 1u) >> 1u;
    // A distance is positive: its sign makes room for one bit more.
    let distance = ((bitcast<u32>(surface.distance_mm) << 1u) + half_step) & ~MATERIAL_MASK;
    return distance | u32(surface.material + 1);
}

/// The surface whose word `pack_surface` made.
fn unpack_surface(key: u32) -> InputSurface {
    return InputSurface(bitcast<f32>((key & ~MATERIAL_MASK) >> 1u), i32(key & MATERIAL_MASK) - 1);
}

/// The words of a pixel that shows `surface`.
fn pack_pixel(surface: InputSurface, irradiance: vec3f) -> vec2u {
    let light = min(pack_shared_exponent(finite_irradiance(irradiance)), NO_LIGHT - 1u);
    return vec2u(select(NO_LIGHT, light, is_finite_rgb(irradiance)), pack_surface(surface));
}

/// The pixel of two words as a tap sees it.
fn unpack_pixel(words: vec2u) -> InputPixel {
    let surface = unpack_surface(words.y);
    let material = select(surface.material, NO_MATERIAL, words.x == NO_LIGHT);
    return InputPixel(unpack_shared_exponent(words.x), surface.distance_mm, material);
}

/// The words of the pixel at `position`; zero outside of the target.
fn load_packed_pixel(pixels: texture_2d<u32>, position: vec2i) -> vec2u {
    if any(position < vec2i(0)) || any(position >= vec2i(textureDimensions(pixels))) {
        return vec2u(0u);
    }
    return textureLoad(pixels, position, 0).rg;
}
