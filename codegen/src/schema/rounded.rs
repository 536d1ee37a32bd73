//! Numbers as messages show them.

/// A number with four significant digits.
pub(crate) fn rounded(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let text = format!("{value:.3e}");
    let short: f64 = text.parse().unwrap_or(value);
    if (1e-4..1e6).contains(&short.abs()) { short.to_string() } else { format!("{short:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_messages_have_four_digits() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-12.345_678, "-12.35"),
            (0.031_25, "0.03125"),
            (123_456.0, "123500"),
            (1.5e-7, "1.5e-7"),
            (2e30, "2e30"),
        ] {
            assert_eq!(rounded(value), text);
        }
    }
}
