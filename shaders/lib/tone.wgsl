// uses: lib/numeric_limits

/// Radiance to display-linear [0, 1] with hue kept: the Khronos PBR Neutral tone mapper (Khronos 2024).
///
/// Below a peak of 0.8 − offset nothing changes but the removal of the 4 % specular floor; above it the peak is
/// compressed towards 1 and the colour slides to white.
fn tone_map_neutral(unbounded: vec3f) -> vec3f {
    // Several highlights may add up past the half floats they came in; infinity over infinity is no colour.
    let radiance = min(unbounded, vec3f(LARGEST_HALF));
    let start_compression = 0.8 - 0.04;
    let desaturation = 0.15;
    let smallest = min(radiance.r, min(radiance.g, radiance.b));
    let offset = select(0.04, smallest - 6.25 * smallest * smallest, smallest < 0.08);
    let lifted = radiance - offset;
    let peak = max(lifted.r, max(lifted.g, lifted.b));
    if peak < start_compression {
        return lifted;
    }
    let headroom = 1.0 - start_compression;
    let new_peak = 1.0 - headroom * headroom / (peak + headroom - start_compression);
    let towards_white = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return mix(lifted * (new_peak / peak), vec3f(new_peak), towards_white);
}

/// Display-linear to sRGB code values, IEC 61966-2-1.
fn srgb_from_linear(linear: vec3f) -> vec3f {
    let clamped = clamp(linear, vec3f(0.0), vec3f(1.0));
    let low = 12.92 * clamped;
    let high = 1.055 * pow(clamped, vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, clamped <= vec3f(0.0031308));
}

/// Radiance as a display takes it: tone mapped where `tone_map` is 1, then encoded as sRGB where `encode_srgb` is.
fn display_colour(radiance: vec3f, tone_map: u32, encode_srgb: u32) -> vec3f {
    var colour = radiance;
    if tone_map != 0u {
        colour = clamp(tone_map_neutral(radiance), vec3f(0.0), vec3f(1.0));
    }
    if encode_srgb != 0u {
        colour = srgb_from_linear(colour);
    }
    return colour;
}
