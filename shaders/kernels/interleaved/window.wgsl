// uses: kernel/constants

/// The window of a pixel with `taps` taps: its shares in the block on the pixel's farther side, in its own, and on its
/// nearer side.
fn window_of_taps(taps: u32) -> vec3f {
    return mix(LINEAR_WINDOW, EVEN_WINDOW, min(EVEN_WINDOW_TAPS / f32(max(taps, 1u)), 1.0));
}

/// Shares of the window in the blocks before a pixel's own along an axis, in it and behind it. `side` is −1 for the
/// first pixel of a block and 1 for the second.
fn window_shares(side: i32, taps: u32) -> vec3f {
    let window = window_of_taps(taps);
    return select(window.zyx, window, side > 0);
}

/// Mean square of the distance along an axis from a pixel to the blocks that it mixes, pixels²: their middles lie 2½,
/// ½ and 1½ pixels off.
fn window_variance(taps: u32) -> f32 {
    return dot(window_of_taps(taps), vec3f(6.25, 0.25, 2.25));
}
