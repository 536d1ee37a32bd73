/// Clip-space corner `index` (0 to 2) of one triangle that covers the whole target: (−1, −1), (3, −1), (−1, 3).
fn covering_triangle(index: u32) -> vec4f {
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return vec4f(2.0 * corner - 1.0, 0.0, 1.0);
}
