//! Angles: the twin of `shaders/lib/angle.wgsl`.

/// cos and sin of the golden angle π (3 - √5).
const GOLDEN_TURN: [f64; 2] = [-0.737_368_878_078_319_8, 0.675_490_294_261_524_1];

/// `direction` turned by the golden angle.
pub(crate) fn turned([x, y]: [f64; 2]) -> [f64; 2] {
    [x * GOLDEN_TURN[0] - y * GOLDEN_TURN[1], x * GOLDEN_TURN[1] + y * GOLDEN_TURN[0]]
}
