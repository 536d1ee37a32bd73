// [J15] Jimenez et al. 2015, "Separable Subsurface Scattering", Computer Graphics Forum 34(6): two passes along x and y
// with one row of weights; where the depth differs, a tap goes over to the colour of the centre ("surface following"):
// wholly at a difference of the row's half width, which gives the smallest error here (of 0.1 to 4 times that). Colours
// are those of the nearest pixel: as close to the reference as filtered ones, and cheaper where filtering is software.
//
// `table` holds, per tap, the offset in mm and the weights of red, green and blue; the centre comes first.

fn gather(pixel: vec2i, own: vec4f, distance_mm: f32) -> vec3f {
    let size = vec2f(textureDimensions(distance_texture));
    let direction = select(vec2f(1.0, 0.0), vec2f(0.0, 1.0), settings.axis == 1u) / pixel_mm(distance_mm);
    let here = vec2f(pixel) + 0.5;
    var light = table[0].yzw * own.rgb;
    for (var tap = 1u; tap < settings.taps; tap += 1u) {
        let entry = table[tap];
        let position = clamp(here + entry.x * direction, vec2f(0.5), size - 0.5);
        let colour = textureLoad(irradiance_texture, vec2i(position), 0).rgb;
        let rise = abs(load_distance_mm(vec2i(position)) - distance_mm);
        light += entry.yzw * mix(colour, own.rgb, saturate(rise / settings.reach_mm));
    }
    return light;
}
