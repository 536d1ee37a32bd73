/// Largest finite half float.
const LARGEST_HALF: f32 = 65504.0;

/// Largest f32 below 1: the last u that a quantile takes.
const LARGEST_BELOW_ONE: f32 = 0.99999994;

/// Smallest radius (mm) at which a per-area density is evaluated: R(r) of several models diverges at r = 0. A picometre
/// is below every sampled radius, and its reciprocal times any 2πrR stays finite.
const SMALLEST_RADIUS_MM: f32 = 1e-9;

/// True for every value but NaN and ±infinity.
///
/// Tests the exponent bits: a compiler may assume that `x != x` never holds.
fn is_finite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}

/// True when all three components are finite.
fn is_finite_rgb(value: vec3f) -> bool {
    return is_finite(value.r) && is_finite(value.g) && is_finite(value.b);
}
