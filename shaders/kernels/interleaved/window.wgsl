/// Shares of a window in the blocks along an axis: in the block on the pixel's farther side, in its own, and on its
/// nearer side. The pixel lies a quarter of a block off the middle of its own.
///
/// This window is as wide as two blocks: wherever the pixel lies, every slice has a quarter of it.
const EVEN_WINDOW: vec3f = vec3f(0.125, 0.5, 0.375);

/// Linear between the middles of the blocks: less blur, but the slices count unevenly.
const LINEAR_WINDOW: vec3f = vec3f(0.0, 0.75, 0.25);

/// Taps per pixel up to which the window is the even one. With more of them a slice alone has less noise.
const EVEN_WINDOW_TAPS: f32 = 4.0;

/// Shares of the window in the blocks before a pixel's own along an axis, in it and behind it. `side` is −1 for the
/// first pixel of a block and 1 for the second.
fn window_shares(side: i32, taps: u32) -> vec3f {
    let window = mix(LINEAR_WINDOW, EVEN_WINDOW, min(EVEN_WINDOW_TAPS / f32(max(taps, 1u)), 1.0));
    return select(window.zyx, window, side > 0);
}
