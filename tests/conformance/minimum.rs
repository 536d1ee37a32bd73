//! The least value of a function of one number.

/// Points of the first look. The functions here have at most a few minima, farther apart than 1/60 of their range.
const POINTS: u32 = 60;

/// Where `f` is least between `from` and `to`: the least of evenly spaced points, then golden sections around it.
pub(crate) fn minimum_between(f: &dyn Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let step = (to - from) / f64::from(POINTS);
    let point = |index: u32| from + step * f64::from(index);
    let least =
        (0..=POINTS).map(|index| (index, f(point(index)))).min_by(|x, y| x.1.total_cmp(&y.1)).unwrap().0;
    golden_section(f, point(least.saturating_sub(1)), point((least + 1).min(POINTS)), 40)
}

/// Where `f` is least between `from` and `to`, if it has one minimum there, after so many steps, each of which leaves
/// 0.618 of the interval. 40 make 4e-9 of it: smooth minima are no better known in doubles.
pub(crate) fn golden_section(f: &dyn Fn(f64) -> f64, from: f64, to: f64, steps: u32) -> f64 {
    let (mut lo, mut hi) = (from, to);
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut x, mut y) = (hi - golden * (hi - lo), lo + golden * (hi - lo));
    let (mut at_x, mut at_y) = (f(x), f(y));
    for _ in 0..steps {
        if at_x < at_y {
            (hi, y, at_y) = (y, x, at_x);
            x = hi - golden * (hi - lo);
            at_x = f(x);
        } else {
            (lo, x, at_x) = (x, y, at_y);
            y = lo + golden * (hi - lo);
            at_y = f(y);
        }
    }
    0.5 * (lo + hi)
}
