//! Angles: the twin of `shaders/lib/angle.wgsl`.

use subsurface_kernel::constants::GOLDEN_TURN;

/// `direction` turned by the golden angle.
pub(crate) fn turned([x, y]: [f64; 2]) -> [f64; 2] {
    [x * GOLDEN_TURN[0] - y * GOLDEN_TURN[1], x * GOLDEN_TURN[1] + y * GOLDEN_TURN[0]]
}
