// uses: gather/input, lib/{numeric_limits, shared_exponent}, the material set

// A pixel of the inputs in two words: the irradiance with a shared exponent, and distance with material. Eight bytes in
// one load, where the inputs take three loads and twenty bytes and more.
//
//     first word    low five bits of the exponent, three mantissas of nine bits
//     second word   sixth bit of the exponent (where a distance has its sign), distance, material number + 1

/// Bits of a key that hold the material number + 1; the others hold the distance.
const MATERIAL_MASK: u32 = (1u << MATERIAL_BITS) - 1u;

/// Bits of a key that hold the distance.
const DISTANCE_MASK: u32 = 0x7fffffffu & ~MATERIAL_MASK;

/// A first word that holds no irradiance: an exponent without mantissas. Light with an exponent above 0 has one of 256
/// and more.
const NO_LIGHT: u32 = 31u << 27u;

/// Exponent of the smallest step of an irradiance, 2^−40, with the bias of f32: below 2^−32 bits of the mantissas go.
const LIGHT_STEP_EXPONENT: u32 = 87u;

/// Largest irradiance that has the form, 511 · 2^23. A larger one counts as this.
const LARGEST_PACKED_IRRADIANCE: f32 = 4286578688.0;

/// Material number + 1 and distance of a surface; 0 where there is none.
fn pack_surface(surface: InputSurface) -> u32 {
    if surface.material == NO_MATERIAL {
        return 0u;
    }
    let half_step = (MATERIAL_MASK + 1u) >> 1u;
    let distance = (bitcast<u32>(surface.distance_mm) + half_step) & DISTANCE_MASK;
    return distance | u32(surface.material + 1);
}

/// The surface whose word `pack_surface` made.
fn unpack_surface(key: u32) -> InputSurface {
    return InputSurface(bitcast<f32>(key & DISTANCE_MASK), i32(key & MATERIAL_MASK) - 1);
}

/// The words of `irradiance`, finite and not negative, on `surface`.
fn pack_lit_surface(surface: InputSurface, irradiance: vec3f) -> vec2u {
    let form = share_exponent(irradiance, LARGEST_PACKED_IRRADIANCE, LIGHT_STEP_EXPONENT);
    let light = form.mantissas | (form.exponent << 27u);
    return vec2u(light, pack_surface(surface) | ((form.exponent >> 5u) << 31u));
}

/// The irradiance that `pack_lit_surface` packed.
fn unpack_irradiance(words: vec2u) -> vec3f {
    return shared_values(words.x, (words.x >> 27u) | ((words.y >> 31u) << 5u), LIGHT_STEP_EXPONENT);
}

/// The words of a pixel that shows `surface`.
fn pack_pixel(surface: InputSurface, irradiance: vec3f) -> vec2u {
    let words = pack_lit_surface(surface, finite_irradiance(irradiance));
    return vec2u(select(NO_LIGHT, words.x, is_finite_rgb(irradiance)), words.y);
}

/// The pixel of two words as a tap sees it.
fn unpack_pixel(words: vec2u) -> InputPixel {
    let surface = unpack_surface(words.y);
    let material = select(surface.material, NO_MATERIAL, words.x == NO_LIGHT);
    return InputPixel(unpack_irradiance(words), surface.distance_mm, material);
}

/// The words of the pixel at `position`; zero outside of the target.
fn load_packed_pixel(pixels: texture_2d<u32>, position: vec2i) -> vec2u {
    if any(position < vec2i(0)) || any(position >= vec2i(textureDimensions(pixels))) {
        return vec2u(0u);
    }
    return textureLoad(pixels, position, 0).rg;
}
