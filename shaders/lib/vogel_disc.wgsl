// uses: lib/angle

/// Position `index` of `count` on a unit disc: equal areas, golden angle (Vogel 1979).
fn vogel_disc(index: u32, count: u32) -> vec2f {
    let radius = sqrt((f32(index) + 0.5) / f32(count));
    let angle = GOLDEN_ANGLE * f32(index);
    return radius * vec2f(cos(angle), sin(angle));
}
