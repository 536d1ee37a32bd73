// uses: kernel/constants, lib/angle

// Points on a unit disc that stand for equal areas, each turned by the golden angle against the last (Vogel 1979). A
// loop turns a direction on, which costs less than an angle's sine and cosine.

/// Radius of point `index` of `count`.
fn vogel_radius(index: u32, count: u32) -> f32 {
    return sqrt((f32(index) + 0.5) / f32(count));
}

/// Direction of the next point.
fn next_vogel_direction(direction: vec2f) -> vec2f {
    return turned(direction, GOLDEN_TURN);
}
