//! Curves with fewer points.

/// Leaves out points that lie within `tolerance` of the line between those that stay (Ramer 1972; Douglas and Peucker
/// 1973): many where the curve bends, few where it is straight. Tenths of a pixel.
pub(super) fn thinned(points: &[(i32, i32)], tolerance: f64) -> Vec<(i32, i32)> {
    let mut keep = vec![false; points.len()];
    let mut spans = Vec::new();
    if let Some(last) = points.len().checked_sub(1) {
        (keep[0], keep[last]) = (true, true);
        spans.push((0, last));
    }
    while let Some((first, last)) = spans.pop() {
        let inner = first + 1..last;
        let farthest = inner
            .map(|index| (distance(points[index], points[first], points[last]), index))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((far, index)) = farthest.filter(|(far, _)| *far > tolerance) {
            debug_assert!(far.is_finite(), "pixels are whole numbers");
            keep[index] = true;
            spans.extend([(first, index), (index, last)]);
        }
    }
    points.iter().zip(keep).filter_map(|(point, keep)| keep.then_some(*point)).collect()
}

/// Distance of `point` from the segment from `start` to `end`.
fn distance(point: (i32, i32), start: (i32, i32), end: (i32, i32)) -> f64 {
    let minus = |a: (i32, i32), b: (i32, i32)| (f64::from(a.0 - b.0), f64::from(a.1 - b.1));
    let (along, to) = (minus(end, start), minus(point, start));
    let length = along.0 * along.0 + along.1 * along.1;
    let share = if length > 0.0 { ((to.0 * along.0 + to.1 * along.1) / length).clamp(0.0, 1.0) } else { 0.0 };
    (to.0 - share * along.0).hypot(to.1 - share * along.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_keeps_its_ends() {
        let line: Vec<_> = (0..100).map(|x| (x, 2 * x)).collect();
        assert_eq!(thinned(&line, 0.5), [(0, 0), (99, 198)]);
        assert_eq!(thinned(&line[..1], 0.5), [(0, 0)]);
        assert_eq!(thinned(&[], 0.5), []);
    }

    #[test]
    fn no_point_is_farther_away_than_the_tolerance() {
        let curve: Vec<_> = (0..=600).map(|x| (10 * x, 6_000_000 / (x + 100))).collect();
        let thin = thinned(&curve, 2.0);
        assert!(thin.len() < 100, "{}", thin.len());
        for point in &curve {
            let nearest = thin.windows(2).map(|pair| distance(*point, pair[0], pair[1]));
            assert!(nearest.fold(f64::INFINITY, f64::min) <= 2.0, "{point:?}");
        }
    }
}
