// A gather of 16 taps as in Blender's EEVEE (since 4.2), written from what is known of the method: Burley's profile
// ([CB15] Christensen and Burley 2015, "Approximate Reflectance Profiles for Efficient Subsurface Scattering", eq. 3
// and 6) sampled on a golden-angle spiral up to 16 d, placed for a white surface albedo and weighted for the pixel's
// own; distances in space between reconstructed positions; taps on another object are left out; weights normalised.
//
// `table` holds, per tap, the offset over the d that it is placed for, and 8π times its density per area, mm⁻².

fn view_position_mm(pixel: vec2i, distance_mm: f32) -> vec3f {
    let centre = 0.5 * vec2f(textureDimensions(distance_texture));
    return vec3f((vec2f(pixel) + 0.5 - centre) * pixel_mm(distance_mm), distance_mm);
}

fn gather(pixel: vec2i, own: vec4f, distance_mm: f32) -> vec3f {
    let d = settings.scattering_distance_mm;
    let placed = settings.reach_mm / 16.0;
    let object = textureLoad(surface_texture, pixel, 0).w;
    let here = view_position_mm(pixel, distance_mm);
    let scale = pixel_mm(distance_mm);
    let turn = pixel_angle(pixel);
    let rotation = mat2x2f(cos(turn), sin(turn), -sin(turn), cos(turn));
    var light = vec3f(0.0);
    var weights = vec3f(0.0);
    for (var tap = 0u; tap < settings.taps; tap += 1u) {
        let entry = table[tap];
        let position = pixel + vec2i(round(rotation * entry.xy * (placed / scale)));
        let there_mm = tap_distance_mm(position);
        if there_mm == 0.0 || textureLoad(surface_texture, position, 0).w != object {
            continue;
        }
        // R diverges at 0, where a tap rounds to the pixel itself: of 0.1, 0.25 and 0.5 pixels the best.
        let path_mm = max(distance(here, view_position_mm(position, there_mm)), 0.25 * scale);
        let weight = burley(path_mm, d) / (path_mm * entry.z);
        light += weight * textureLoad(irradiance_texture, position, 0).rgb;
        weights += weight;
    }
    return select(own.rgb, light / weights, weights > vec3f(0.0));
}
