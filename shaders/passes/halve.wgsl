// uses: lib/covering_triangle

/// The level above.
@group(0) @binding(0) var halved_texture: texture_2d<f32>;

@vertex
fn halve_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return covering_triangle(index);
}

/// The mean over a texel's area: of four texels, and of parts of nine where a side is odd.
@fragment
fn halve_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let size = vec2i(textureDimensions(halved_texture));
    // Texels of the level above per texel of this one.
    let growth = vec2f(size) / vec2f(max(size / 2, vec2i(1)));
    let start = floor(position.xy) * growth;
    let end = start + growth;
    var sum = vec4f(0.0);
    for (var corner = 0; corner < 9; corner += 1) {
        let texel = floor(start) + vec2f(f32(corner % 3), f32(corner / 3));
        let overlap = max(min(end, texel + 1.0) - max(start, texel), vec2f(0.0));
        let place = min(vec2i(texel), size - 1);
        sum += overlap.x * overlap.y * textureLoad(halved_texture, place, 0);
    }
    return sum / (growth.x * growth.y);
}
