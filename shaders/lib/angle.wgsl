const PI: f32 = 3.14159265;

const TAU: f32 = 6.28318531;

/// The golden angle π(3 − √5) in radians: successive multiples cover a disc most evenly.
const GOLDEN_ANGLE: f32 = 2.39996323;

/// `direction` turned by the angle whose cosine and sine are `turn`.
fn turned(direction: vec2f, turn: vec2f) -> vec2f {
    return vec2f(
        direction.x * turn.x - direction.y * turn.y,
        direction.x * turn.y + direction.y * turn.x,
    );
}
