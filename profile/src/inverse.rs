//! The inverse of an increasing function.

/// Ends the search in a bracket without a root. Others end sooner: bisection alone takes some 60 steps where x is
/// a logarithm, and where it is not, the callers start at bounds from which Newton's method converges.
const MAXIMUM_STEPS: usize = 128;

/// The root in `bracket` of an increasing function, by Newton's method inside a shrinking bracket.
///
/// `value_and_slope(x)` returns f(x) and f′(x) ≥ 0. A step that leaves the bracket, or that is not at least
/// twice as short as the one before the last, is replaced by a bisection (Press et al., Numerical Recipes,
/// `rtsafe`), so the result never depends on the quality of `start`, only the number of steps does.
///
/// The root is exact to a few units in the last place of max(|x|, `scale`): a `scale` of 0 asks for relative
/// accuracy, one of 1 suits an x that is a logarithm.
///
/// If f has one sign over the whole bracket, which rounding can cause, the result is the end nearer to the root,
/// to the same accuracy.
pub(crate) fn increasing_root(
    value_and_slope: impl Fn(f64) -> (f64, f64),
    bracket: [f64; 2],
    start: f64,
    scale: f64,
) -> f64 {
    let [mut lower, mut upper] = bracket;
    // Not `clamp`, which panics where a bracket is reversed by rounding.
    let mut x = start.max(lower).min(upper);
    let mut last_step = upper - lower;
    let mut step_before_last = last_step;
    for _ in 0..MAXIMUM_STEPS {
        let (value, slope) = value_and_slope(x);
        if value == 0.0 {
            return x;
        }
        if value < 0.0 {
            lower = x;
        } else {
            upper = x;
        }
        let newton = x - value / slope;
        // A NaN (0/0) fails both comparisons and bisects.
        let next = if newton >= lower && newton <= upper && (newton - x).abs() <= 0.5 * step_before_last {
            newton
        } else {
            lower + 0.5 * (upper - lower)
        };
        step_before_last = last_step;
        last_step = (next - x).abs();
        let resolution = 2.0 * f64::EPSILON * next.abs().max(scale);
        x = next;
        if last_step <= resolution {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_root_from_any_start() {
        // x³ = 2: a few ulps is what the resolution promises.
        for start in [-10.0, 0.0, 0.1, 1.0, 1.26, 99.0, 1e9] {
            let root = increasing_root(|x| (x * x * x - 2.0, 3.0 * x * x), [0.0, 100.0], start, 0.0);
            assert!((root - 2f64.cbrt()).abs() <= 4.0 * f64::EPSILON, "start {start}: {root}");
        }
    }

    #[test]
    fn survives_flat_and_steep_functions() {
        // Newton alone diverges on both: the first overshoots, the second has slope 0 almost everywhere.
        let root = increasing_root(
            |x| ((x - 0.3).cbrt(), (x - 0.3).abs().powf(-2.0 / 3.0) / 3.0),
            [-5.0, 5.0],
            4.0,
            1.0,
        );
        assert!((root - 0.3).abs() < 1e-15, "{root}");
        let step = |x: f64| (if x < 0.3 { -1.0 } else { 1.0 }, 0.0);
        let root = increasing_root(step, [-5.0, 5.0], 4.0, 1.0);
        assert!((root - 0.3).abs() < 4.0 * f64::EPSILON, "{root}");
    }

    #[test]
    fn one_sign_over_the_bracket_gives_the_nearer_end() {
        let at_lower = increasing_root(|x| (x + 1.0, 1.0), [0.0, 1.0], 0.7, 1.0);
        let at_upper = increasing_root(|x| (x - 2.0, 1.0), [0.0, 1.0], 0.3, 1.0);
        // The resolution at scale 1 is 2 ε, and the last bisection may stop that far from the end.
        assert!((0.0..=4.0 * f64::EPSILON).contains(&at_lower), "{at_lower}");
        assert!((1.0 - 4.0 * f64::EPSILON..=1.0).contains(&at_upper), "{at_upper}");
    }
}
