//! Logarithm and circle in `f32`, by polynomials: a vector of lanes at a time, and the same bits on every machine.
//!
//! The platform's own functions differ between machines in the last place. These use products, sums and bit patterns
//! only, which IEEE 754 fixes. Polynomials are those of Cephes (Moshier 1992, `logf.c`, `sinf.c`), good to about 10⁻⁷.

use std::f32::consts::FRAC_PI_4;

/// A uniform number in (0, 1) out of 23 random bits: the centre of one of 2²³ cells, so neither end is ever met.
#[inline(always)]
pub(crate) fn unit(bits: u32) -> f32 {
    ((bits >> 9) as i32 as f32 + 0.5) * (1.0 / 8_388_608.0)
}

/// A uniform number in (-1, 1) out of 24 random bits.
#[inline(always)]
pub(crate) fn signed_unit(bits: u32) -> f32 {
    ((bits as i32 >> 8) as f32 + 0.5) * (1.0 / 8_388_608.0)
}

/// -ln(x) for a normal x > 0.
#[inline(always)]
pub(crate) fn negative_ln(x: f32) -> f32 {
    /// √½: the mantissa is brought into [√½, √2), around the polynomial's centre 1.
    const SQRT_HALF_BITS: u32 = 0x3f35_04f3;
    let exponent = (x.to_bits().wrapping_sub(SQRT_HALF_BITS) as i32) >> 23;
    let f = f32::from_bits(x.to_bits().wrapping_sub((exponent as u32) << 23)) - 1.0;
    let e = exponent as f32;
    let z = f * f;
    let mut p = 7.037_683_6e-2;
    p = p * f - 1.151_461e-1;
    p = p * f + 1.167_699_87e-1;
    p = p * f - 1.242_014_1e-1;
    p = p * f + 1.424_932_3e-1;
    p = p * f - 1.666_805_8e-1;
    p = p * f + 2.000_071_5e-1;
    p = p * f - 2.499_999_4e-1;
    p = p * f + 3.333_333e-1;
    // ln 2 in two parts, the first of few bits, so that its product with e is exact.
    let low = p * f * z - 2.121_944_4e-4 * e - 0.5 * z;
    -(f + low + 0.693_359_4 * e)
}

/// Cosine and sine of a uniformly random angle out of 32 random bits.
///
/// 23 bits choose an angle in (-π/4, π/4), one bit turns it by a half, another swaps the axes.
#[inline(always)]
pub(crate) fn circle(bits: u32) -> (f32, f32) {
    let a = ((bits as i32 >> 9) as f32 + 0.5) * (FRAC_PI_4 / 4_194_304.0);
    let z = a * a;
    let sine = a + a * z * ((-1.951_529_6e-4 * z + 8.332_161e-3) * z - 1.666_665_5e-1);
    let cosine = 1.0 - 0.5 * z + z * z * ((2.443_315_7e-5 * z - 1.388_731_6e-3) * z + 4.166_664_6e-2);
    let sine = sine.to_bits();
    let cosine = cosine.to_bits() ^ ((bits & 2) << 30);
    let swap = (sine ^ cosine) & (bits & 1).wrapping_neg();
    (f32::from_bits(cosine ^ swap), f32::from_bits(sine ^ swap))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_is_that_of_f64() {
        for bits in (0..=u32::MAX).step_by(65_521) {
            let x = unit(bits);
            let exact = -f64::from(x).ln();
            // Cephes states 1 unit in the last place; relative to 1 near x = 1/e.
            assert!((f64::from(negative_ln(x)) - exact).abs() <= 2e-7 * exact, "{x}");
        }
    }

    #[test]
    fn circle_is_round_and_even() {
        let (mut c, mut s, mut cc, mut cs) = (0.0, 0.0, 0.0, 0.0);
        let count = f64::from(1 << 16);
        for key in 0..1_u32 << 16 {
            // Spread over all bits, the lowest two included.
            let (x, y) = circle(key.wrapping_mul(0x9e37_79b1));
            let (x, y) = (f64::from(x), f64::from(y));
            assert!((x * x + y * y - 1.0).abs() < 3e-7);
            c += x;
            s += y;
            cc += x * x;
            cs += x * y;
        }
        // Weyl's sequence is more even than random numbers, whose sums would be within 1/√65536 = 0.004.
        assert!((c / count).abs() < 0.004 && (s / count).abs() < 0.004 && (cs / count).abs() < 0.004);
        assert!((cc / count - 0.5).abs() < 0.004);
    }

    #[test]
    fn uniform_numbers_stay_inside() {
        assert!(unit(0) > 0.0 && unit(u32::MAX) < 1.0);
        assert!(signed_unit(i32::MIN as u32) > -1.0 && signed_unit(i32::MAX as u32) < 1.0);
    }
}
