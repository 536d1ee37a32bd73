//! Loops of the profiles, written out as long as a material set needs them.
//!
//! Loops cost more than their rounds: `Dense` calls densities tens of thousands of times per pixel, and there is a
//! driver that ends a shader's loops, inner ones included, after 65,536 rounds (Mesa's llvmpipe).

use std::fmt::Write as _;

/// Terms of a Gaussian sum that are written out; longer sums repeat them.
const TERMS_AT_ONCE: u32 = 32;

/// The functions of a Gaussian sum that add its terms up, for sums of at most `terms` terms.
pub(crate) fn gaussian_sums(terms: u32) -> String {
    let area_pdf = "R(r) / A per unit area, mm⁻².";
    let radial_cdf =
        "Fraction of the reflected energy that leaves within `radius_mm`: Σ wᵢ (1 − e^(−r²/2vᵢ)).";
    let mut text = String::new();
    for (function, docs) in [("area_pdf", area_pdf), ("radial_cdf", radial_cdf)] {
        let _ = writeln!(text, "/// {docs}");
        let _ = writeln!(text, "fn gaussian_sum_{function}(profile: vec4f, radius_mm: f32) -> f32 {{");
        text.push_str("    var sum = 0.0;\n");
        let repeats = terms > TERMS_AT_ONCE;
        let (indent, first) = if repeats { ("        ", "first + ") } else { ("    ", "") };
        if repeats {
            let _ = writeln!(
                text,
                "    for (var first = 0u; first < u32(profile.y) - u32(profile.x); first += {TERMS_AT_ONCE}u) {{"
            );
        }
        for place in 0..terms.min(TERMS_AT_ONCE) {
            let _ = writeln!(
                text,
                "{indent}sum += gaussian_term_{function}(profile, {first}{place}u, radius_mm);"
            );
        }
        text.push_str(if repeats { "    }\n    return sum;\n}\n\n" } else { "    return sum;\n}\n\n" });
    }
    text
}

/// The search for the piece of a table that holds a radius, for tables of at most `knots` knots.
pub(crate) fn table_search(knots: u32) -> String {
    let mut text = String::from(
        "/// The last piece that does not begin beyond `radius`, in mean free paths: strides are halved from the longest \
         that a\n/// table of the set needs.\nfn tabulated_piece_start(profile: vec4f, radius: f32) -> u32 {\n    \
         var start = 0u;\n",
    );
    // The last knot begins no piece, and the search starts at the first.
    let farthest = knots.saturating_sub(2);
    let strides = u32::BITS - farthest.leading_zeros();
    for stride in (0..strides).rev().map(|bit| 1u32 << bit) {
        let _ = writeln!(text, "    start = tabulated_stride(profile, start, {stride}u, radius);");
    }
    text.push_str("    return start;\n}\n\n");
    text
}

#[cfg(test)]
mod tests {
    use super::{gaussian_sums, table_search};

    #[test]
    fn sums_of_up_to_32_terms_have_no_loop() {
        for terms in [1, 6, 32] {
            let text = gaussian_sums(terms);
            assert_eq!(text.matches("sum += ").count() as u32, 2 * terms, "{text}");
            assert!(!text.contains("for ("), "{text}");
        }
    }

    #[test]
    fn longer_sums_take_32_terms_a_round() {
        let text = gaussian_sums(33);
        assert_eq!((text.matches("sum += ").count(), text.matches("for (").count()), (64, 2), "{text}");
    }

    #[test]
    fn strides_reach_the_last_piece_and_no_further_than_they_must() {
        let strides = |knots| table_search(knots).matches("tabulated_stride(").count();
        // One stride of 1 reaches the second of two pieces; 2 + 1 the fourth of four.
        assert_eq!([2, 3, 4, 5, 6, 9, 10].map(strides), [0, 1, 2, 2, 3, 3, 4]);
    }
}
