// uses: lib/covering_triangle

/// The level above.
@group(0) @binding(0) var halved_texture: texture_2d<f32>;

@vertex
fn halve_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return covering_triangle(index);
}

/// The mean of four texels; at an odd edge the last stand for those beyond.
@fragment
fn halve_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let last = vec2i(textureDimensions(halved_texture)) - 1;
    let first = 2 * vec2i(position.xy);
    var sum = vec4f(0.0);
    for (var corner = 0; corner < 4; corner += 1) {
        sum += textureLoad(halved_texture, min(first + vec2i(corner % 2, corner / 2), last), 0);
    }
    return 0.25 * sum;
}
