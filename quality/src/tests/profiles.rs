//! Curves of the profiles, and the strips that are cut by them.

use super::{optics_of, published};
use crate::gather::curve::{Knots, line_quantiles, quantile};
use crate::gather::point::Point;
use crate::kernels::separable::strips::beside_centre;
use crate::noise::interleaved_gradient_noise;
use crate::optics::line_spread::{beyond_line, edge_spread, line_spread};
use subsurface_kernel::constants::FILTER_QUANTILE;
use subsurface_profile::{Channel, EdgeSpread, Medium, Model};

#[test]
fn light_of_an_edge_is_that_of_the_profile_crate() {
    for stem in Model::PUBLISHED {
        let model = Model::published(stem).expect("it is published");
        for surface_albedo in [0.0, 0.6, 0.999] {
            let medium = Medium::new(surface_albedo, 1.0).expect("a medium");
            let profile = model.profile(medium, Channel::Red).expect("a profile");
            let exact = EdgeSpread::new(&*profile);
            for x in [-3.0, -0.3, 0.0, 0.01, 0.2, 1.0, 4.0, 20.0] {
                let found = edge_spread(&*profile, x);
                // The polynomial and tables have corners, where the rule falls back to the square of its step.
                let tolerance = if profile.max_radius().is_some() { 2e-3 } else { 1e-5 };
                assert!((found - exact.at(x)).abs() < tolerance, "{stem} at {x}: {found}, {}", exact.at(x));
            }
            // Its slope is the light of a line.
            if profile.max_radius().is_none() {
                for x in [0.05, 0.5, 2.0] {
                    let step = 1e-3 * x;
                    let slope = (exact.at(x + step) - exact.at(x - step)) / (2.0 * step);
                    let found = line_spread(&*profile, x);
                    assert!((found - slope).abs() < 1e-4 * slope + 1e-6, "{stem} at {x}: {found}, {slope}");
                }
            }
        }
    }
}

#[test]
fn edge_curves_reach_as_far_as_filters_do() {
    for stem in Model::PUBLISHED {
        for surface_albedo in [0.0, 0.33, 0.6, 0.999] {
            let [optics, ..] = &optics_of(&[published(stem, [1.3, 0.95, 0.67], [surface_albedo; 3])])[..]
            else {
                panic!("{stem}: one material");
            };
            for channel in &optics.channels {
                let last = quantile(&channel.curve, FILTER_QUANTILE).0;
                for step in 0..=200 {
                    let x = last * f64::from(step) / 200.0;
                    let (found, exact) = (channel.edge_curve.at(x), beyond_line(&*channel.profile, x));
                    // 64 straight pieces up to where the widest surface albedo ends, and no light beyond: a curve that
                    // is much narrower has fewer of them (measured: 6.5e-3 at most).
                    assert!((found - exact).abs() < 1e-2, "{stem}, {surface_albedo}, {x}: {found}, {exact}");
                }
            }
        }
    }
}

#[test]
fn noise_is_from_0_to_1_left_of_the_screen_too() {
    for pixel in [[-3, -5], [-1, 0], [0, 0], [-4096, 7]] {
        assert!((0.0..1.0).contains(&interleaved_gradient_noise(pixel)), "{pixel:?}");
    }
}

#[test]
fn strips_adjoin_and_hold_all_light() {
    for stem in Model::PUBLISHED {
        let optics = optics_of(&[published(stem, [1.3, 0.95, 0.67], [0.83, 0.64, 0.55])]);
        for mean_radius in [0.5, 3.0, 30.0, 300.0] {
            let point = Point::new(&optics[0], mean_radius, true, false);
            let widest = |offset: f64| point.beyond_line(offset * point.pixel)[optics[0].widest];
            let beyond_centre = 2.0 * widest(0.5);
            for count in [1, 2, 8, 32] {
                let strips: Vec<_> = beside_centre(&point, beyond_centre, count).collect();
                let mut start = 0.5;
                for (number, strip) in strips.iter().enumerate() {
                    assert_eq!(strip.start, start, "{stem}: they adjoin");
                    assert!(strip.end >= strip.start + 1.0, "{stem}: {strip:?}");
                    let is_last = number + 1 == strips.len();
                    let end = if is_last { f64::INFINITY } else { strip.end };
                    let is_within = |line: &f64| *line == line.trunc() && (strip.start..=end).contains(line);
                    assert!(strip.lines.iter().all(is_within), "{stem}: {strip:?}");
                    assert!(is_last || strip.end.fract() == 0.5, "{stem}: {strip:?} ends within a pixel");
                    // A share more than its own is that of a pixel, or of the half pixels that its ends are rounded by.
                    let share = widest(strip.start) - if is_last { 0.0 } else { widest(strip.end) };
                    let pixel = widest(strip.start) - widest(strip.start + 1.0);
                    let part = |left: usize| (left as f64 / f64::from(count)).powf(1.5);
                    let own =
                        0.5 * beyond_centre * (part(strips.len() - number) - part(strips.len() - number - 1));
                    assert!(share < own + pixel + 1e-2, "{stem}: {share} of {own} in {strip:?}");
                    start = strip.end;
                }
            }
        }
    }
}

#[test]
fn lines_of_a_plateau_and_of_an_end_are_found() {
    // Half of the light at the centre, none up to the middle of the curve, the rest beyond; and none from there on.
    let plateau: Knots =
        std::array::from_fn(|knot| if knot < 32 { 0.25 } else { 0.25 * (64 - knot) as f64 / 32.0 });
    let ended: Knots =
        std::array::from_fn(|knot| if knot < 32 { 0.5 * (32 - knot) as f64 / 32.0 } else { 0.0 });
    for knots in [plateau, ended] {
        let lines = line_quantiles(&knots, 7.0);
        assert!(
            lines.is_sorted() && lines.iter().all(|distance| (0.0..=7.0).contains(distance)),
            "{lines:?}"
        );
    }
    // Before the share at the centre is used up.
    assert_eq!(line_quantiles(&plateau, 7.0)[8], 0.0);
    // All light lands up to where the curve comes to an end.
    assert_eq!(line_quantiles(&ended, 7.0)[64], 7.0 / 16.0);
}
