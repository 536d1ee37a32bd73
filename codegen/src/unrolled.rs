//! Loops of densities and CDFs, written out as long as a material set needs them: the search of a table for a radius,
//! and Gaussian sums of up to 32 terms.
//!
//! Loops cost more than their rounds: `Dense` calls densities tens of thousands of times per pixel, and there is a
//! driver that ends a shader's loops, inner ones included, after 65,536 rounds (Mesa's llvmpipe). Where it is
//! written out, a shorter sum or table pays for the longest of its set.

use std::fmt::Write as _;

/// Terms of a Gaussian sum that are written out at most: some drivers compile long functions slowly. A set with a longer
/// sum has a loop.
const MOST_TERMS: u32 = 32;

/// The functions of a Gaussian sum that add its terms up, for sums of at most `terms` terms.
pub(crate) fn gaussian_sums(terms: u32) -> String {
    let mut text = String::new();
    for (function, docs) in [
        ("area_pdf", "R(r) / A per unit area, mm⁻²."),
        ("radial_cdf", "Fraction of the reflected energy that leaves within `radius_mm`."),
    ] {
        let _ = writeln!(text, "/// {docs}");
        let _ = writeln!(text, "fn gaussian_sum_{function}(profile: vec4f, radius_mm: f32) -> f32 {{");
        text.push_str("    var sum = 0.0;\n");
        let term = |place: &str| format!("sum += gaussian_term_{function}(profile, {place}, radius_mm);");
        if terms > MOST_TERMS {
            let count = "u32(profile.y) - u32(profile.x)";
            let _ = writeln!(text, "    for (var place = 0u; place < {count}; place += 1u) {{");
            let _ = writeln!(text, "        {}\n    }}", term("place"));
        } else {
            for place in 0..terms {
                let _ = writeln!(text, "    {}", term(&format!("{place}u")));
            }
        }
        text.push_str("    return sum;\n}\n\n");
    }
    text
}

/// The head of the search, whose strides follow.
const TABLE_SEARCH: &str = "\
/// The last piece that does not begin beyond `radius`, in mean free paths: strides are halved from the longest that a
/// table of the set needs.
fn tabulated_piece_start(profile: vec4f, radius: f32) -> u32 {
    var start = 0u;
";

/// The search for the piece of a table that holds a radius, for tables of at most `knots` knots.
pub(crate) fn table_search(knots: u32) -> String {
    let mut text = TABLE_SEARCH.to_owned();
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
    fn a_sum_is_one_line_per_term() {
        let area_pdf = "\
/// R(r) / A per unit area, mm⁻².
fn gaussian_sum_area_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    var sum = 0.0;
    sum += gaussian_term_area_pdf(profile, 0u, radius_mm);
    sum += gaussian_term_area_pdf(profile, 1u, radius_mm);
    return sum;
}

";
        let text = gaussian_sums(2);
        assert!(text.starts_with(area_pdf), "{text}");
    }

    #[test]
    fn longer_sums_have_a_loop() {
        let text = gaussian_sums(33);
        assert_eq!((text.matches("sum += ").count(), text.matches("for (").count()), (2, 2), "{text}");
    }

    #[test]
    fn strides_reach_the_last_piece_and_no_further_than_they_must() {
        let strides = |knots| table_search(knots).matches("tabulated_stride(").count();
        // One stride of 1 reaches the second of two pieces; 2 + 1 the fourth of four.
        assert_eq!([2, 3, 4, 5, 6, 9, 10].map(strides), [0, 1, 2, 2, 3, 3, 4]);
    }
}
