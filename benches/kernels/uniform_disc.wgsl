// A disc of constant density (Vogel 1979, "A better way to construct the sunflower head", Mathematical Biosciences 44:
// radius R √u, golden angle), every tap weighted by the profile at its distance in space: what importance sampling is
// measured against, as in [L23] Liang et al. 2023, eq. (22) with a constant p.
//
// `table` holds r·R(r) of red, green and blue at radii (i / (n − 1))² × reach: dense where the profile bends.

/// R(r) / A per channel; 0 beyond the reach.
fn profile(radius_mm: f32) -> vec3f {
    let last = f32(arrayLength(&table) - 1u);
    let x = sqrt(radius_mm / settings.reach_mm) * last;
    if x >= last {
        return vec3f(0.0);
    }
    let index = u32(x);
    return mix(table[index].xyz, table[index + 1u].xyz, fract(x)) / radius_mm;
}

fn gather(pixel: vec2i, own: vec4f, distance_mm: f32) -> vec3f {
    let scale = pixel_mm(distance_mm);
    let turn = pixel_angle(pixel);
    var light = vec3f(0.0);
    var weights = vec3f(0.0);
    for (var tap = 0u; tap < settings.taps; tap += 1u) {
        let radius_mm = settings.reach_mm * sqrt((f32(tap) + 0.5) / f32(settings.taps));
        let angle = turn + GOLDEN_ANGLE * f32(tap);
        let position = pixel + vec2i(round(radius_mm / scale * vec2f(cos(angle), sin(angle))));
        let there_mm = tap_distance_mm(position);
        if there_mm == 0.0 {
            continue;
        }
        let rise = there_mm - distance_mm;
        let weight = profile(sqrt(radius_mm * radius_mm + rise * rise));
        light += weight * textureLoad(irradiance_texture, position, 0).rgb;
        weights += weight;
    }
    return select(own.rgb, light / weights, weights > vec3f(0.0));
}
