//! Numbers as C's `printf` writes them, which readers of MCML's output expect.

/// C's `%.{digits}E`: at least two digits of exponent, always with a sign.
pub(super) fn exponential(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$E}");
    match text.split_once('E') {
        Some((mantissa, exponent)) => {
            let (sign, magnitude) = exponent.strip_prefix('-').map_or(('+', exponent), |rest| ('-', rest));
            format!("{mantissa}E{sign}{magnitude:0>2}")
        }
        // Infinity and NaN have no exponent.
        None => text,
    }
}

/// C's `%.{digits}G`: fixed where the decimal exponent is from −4 to `digits` − 1, else exponential; without trailing
/// zeros.
pub(super) fn general(value: f64, digits: usize) -> String {
    let scientific = exponential(value, digits - 1);
    let Some((mantissa, exponent)) = scientific.split_once('E') else {
        return scientific;
    };
    let power: i64 = exponent.parse().unwrap_or_default();
    if (-4..digits as i64).contains(&power) {
        let places = usize::try_from(digits as i64 - 1 - power).unwrap_or_default();
        without_trailing_zeros(&format!("{value:.places$}")).to_owned()
    } else {
        format!("{}E{exponent}", without_trailing_zeros(mantissa))
    }
}

fn without_trailing_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_c_prints() {
        // What `printf("%.4E")` and `printf("%.6G")` of the C library print.
        for (value, e, g) in [
            (0.0, "0.0000E+00", "0"),
            (30.924, "3.0924E+01", "30.924"),
            (1e-7, "1.0000E-07", "1E-07"),
            (1e8, "1.0000E+08", "1E+08"),
            (0.024_372_9, "2.4373E-02", "0.0243729"),
            (-0.000_123_456_78, "-1.2346E-04", "-0.000123457"),
            (999_999.7, "1.0000E+06", "1E+06"),
            (123_456.0, "1.2346E+05", "123456"),
            (1.5e-300, "1.5000E-300", "1.5E-300"),
        ] {
            assert_eq!(exponential(value, 4), e);
            assert_eq!(general(value, 6), g);
        }
    }
}
