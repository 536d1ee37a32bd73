// uses: kernel/constants

/// Shares of the window in the blocks before a pixel's own along an axis, in it and behind it. `side` is −1 for the
/// first pixel of a block and 1 for the second.
fn window_shares(side: i32, taps: u32) -> vec3f {
    let window = mix(LINEAR_WINDOW, EVEN_WINDOW, min(EVEN_WINDOW_TAPS / f32(max(taps, 1u)), 1.0));
    return select(window.zyx, window, side > 0);
}
