//! Where a monotone function crosses zero.

/// The zero of `f`, which falls from `f(low) >= 0` to `f(high) <= 0`.
///
/// False position with Ridders' exponential correction (Ridders 1979, IEEE Trans. Circuits Syst. 26): it never leaves
/// the bracket and doubles the digits with each pair of evaluations.
pub(crate) fn falling(mut low: f64, mut high: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    let (mut at_low, mut at_high) = (f(low), f(high));
    if at_low <= 0.0 {
        return low;
    }
    if at_high >= 0.0 {
        return high;
    }
    // 100 halvings are more than an f64 has; ten are the rule.
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if high - low <= 1e-15 * middle.abs() || middle == low || middle == high {
            break;
        }
        let at_middle = f(middle);
        let root = (at_middle * at_middle - at_low * at_high).sqrt();
        let guess = (middle + (middle - low) * at_middle / root).clamp(low, high);
        let at_guess = f(guess);
        if at_guess == 0.0 {
            return guess;
        }
        for (x, at_x) in [(middle, at_middle), (guess, at_guess)] {
            if x > low && x < high {
                if at_x >= 0.0 {
                    (low, at_low) = (x, at_x);
                } else {
                    (high, at_high) = (x, at_x);
                }
            }
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::falling;

    #[test]
    fn it_finds_what_it_brackets() {
        let mut calls = 0;
        let root = falling(0.0, 3.0, |x| {
            calls += 1;
            2.0 - x * x
        });
        assert!((root - std::f64::consts::SQRT_2).abs() < 1e-14);
        assert!(calls < 40, "{calls}");
        assert_eq!(falling(0.0, 1.0, |x| -x), 0.0);
        assert_eq!(falling(0.0, 1.0, |x| 2.0 - x), 1.0);
    }
}
