//! Axes: where a value lies, and which values are written.

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences, equal lengths.
    Linear,
    /// Equal ratios, equal lengths.
    Log,
}

/// An axis: its name with the unit, and the values at its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Name and unit.
    pub label: String,
    /// How values are spread.
    pub scale: Scale,
    /// Value at the left or lower end; above 0 where the scale is logarithmic.
    pub low: f64,
    /// Value at the other end, above `low`.
    pub high: f64,
}

impl Axis {
    /// A linear axis from `low` to `high`.
    pub fn linear(label: impl Into<String>, low: f64, high: f64) -> Self {
        Self { label: label.into(), scale: Scale::Linear, low, high }
    }

    /// A logarithmic axis from `low` to `high`, both above 0.
    pub fn log(label: impl Into<String>, low: f64, high: f64) -> Self {
        Self { label: label.into(), scale: Scale::Log, low, high }
    }

    /// The axis with its upper end moved outwards to a round value, so that the highest point does not touch the frame.
    #[must_use]
    pub fn with_round_end(mut self) -> Self {
        match self.scale {
            Scale::Linear => {
                let step = step(self.high - self.low) / 2.0;
                self.high = (self.high / step).ceil() * step;
            }
            Scale::Log => self.high = 10f64.powf(self.high.log10().ceil()),
        }
        self
    }

    /// Position of a value: 0 at the lower end, 1 at the upper.
    pub(super) fn position(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Log => (value / self.low).log10() / (self.high / self.low).log10(),
        }
    }

    /// The value at a position.
    pub fn value(&self, position: f64) -> f64 {
        match self.scale {
            Scale::Linear => self.low + position * (self.high - self.low),
            Scale::Log => self.low * (self.high / self.low).powf(position),
        }
    }

    /// The values that are written, from low to high.
    fn ticks(&self) -> Vec<f64> {
        match self.scale {
            Scale::Linear => {
                let step = step(self.high - self.low);
                // A tick at the very end may round beyond it.
                let slack = 1e-9 * step;
                let first = ((self.low - slack) / step).ceil() as i64;
                let last = ((self.high + slack) / step).floor() as i64;
                (first..=last).map(|count| count as f64 * step).collect()
            }
            Scale::Log => {
                let (first, last) = self.decades();
                let stride = usize::try_from((last - first) / 7 + 1).unwrap_or(1);
                // From the top, where the curves are.
                let mut ticks: Vec<f64> =
                    (first..=last).rev().step_by(stride).map(|d| 10f64.powi(d)).collect();
                ticks.reverse();
                // One number is no scale.
                if ticks.len() < 2 { self.half_decades(first, last) } else { ticks }
            }
        }
    }

    /// 1, 2 and 5 times the powers of ten about those from `first` to `last`, on the axis.
    fn half_decades(&self, first: i32, last: i32) -> Vec<f64> {
        let of = |decade: i32| [1.0, 2.0, 5.0].map(|digit| digit * 10f64.powi(decade));
        let inside = |value: &f64| (self.low..=self.high).contains(value);
        (first - 1..=last.max(first)).flat_map(of).filter(inside).collect()
    }

    /// Values between the ticks that get a pale line.
    fn minor_ticks(&self) -> Vec<f64> {
        let (first, last) = match self.scale {
            Scale::Linear => return Vec::new(),
            Scale::Log => self.decades(),
        };
        if last - first > 4 {
            return Vec::new();
        }
        let between = |decade: i32| (2..10).map(move |digit| f64::from(digit) * 10f64.powi(decade));
        let inside = |value: &f64| (self.low..=self.high).contains(value);
        (first - 1..=last).flat_map(between).filter(inside).collect()
    }

    /// Exponents of the first and the last power of ten on the axis.
    fn decades(&self) -> (i32, i32) {
        let slack = 1e-9;
        ((self.low.log10() - slack).ceil() as i32, (self.high.log10() + slack).floor() as i32)
    }

    /// A tick's text.
    fn text(&self, value: f64) -> String {
        match self.scale {
            Scale::Linear => {
                let step = step(self.high - self.low);
                if step < 1e-3 || self.high.abs() >= 1e5 {
                    return if value == 0.0 {
                        "0".into()
                    } else {
                        format!("{value:.1e}").replace('-', "−")
                    };
                }
                let decimals = (0..6).find(|&digits| {
                    let scaled = step * 10f64.powi(digits);
                    (scaled - scaled.round()).abs() < 1e-6
                });
                // The sum turns -0.0 into 0.0.
                format!("{:.*}", decimals.unwrap_or(6) as usize, value + 0.0).replace('-', "−")
            }
            Scale::Log => {
                let exponent = value.log10().round() as i32;
                match exponent {
                    -2..=3 => format!("{value}"),
                    _ => format!("10{}", superscript(exponent)),
                }
            }
        }
    }
}

/// A step of 1, 2 or 5 times a power of ten that divides `width` into four to nine.
fn step(width: f64) -> f64 {
    let rough = width / 8.0;
    let decade = 10f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * decade >= rough);
    factor.unwrap_or(10.0) * decade
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digits = exponent.unsigned_abs().to_string();
    let raised = digits.chars().filter_map(|digit| digit.to_digit(10)).map(|digit| DIGITS[digit as usize]);
    if exponent < 0 { std::iter::once('⁻').chain(raised).collect() } else { raised.collect() }
}

/// How plotters sees an axis.
impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let pixels = f64::from(limit.1 - limit.0) * self.position(*value);
        // Far outside is as good as just outside, and stays within i32.
        limit.0 + pixels.round().clamp(-1e5, 1e5) as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { self.minor_ticks() } else { self.ticks() }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        self.text(*value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis) -> Vec<String> {
        axis.ticks().into_iter().map(|tick| axis.text(tick)).collect()
    }

    #[test]
    fn linear_ticks_are_round_and_reach_both_ends() {
        assert_eq!(texts(&Axis::linear("r", 0.0, 8.0)), ["0", "1", "2", "3", "4", "5", "6", "7", "8"]);
        assert_eq!(texts(&Axis::linear("u", 0.0, 1.0)), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(texts(&Axis::linear("d", -0.02, 0.02)).first().map(String::as_str), Some("−0.020"));
    }

    #[test]
    fn logarithmic_ticks_are_decades() {
        let axis = Axis::log("R", 1e-4, 10.0);
        assert_eq!(texts(&axis), ["10⁻⁴", "10⁻³", "0.01", "0.1", "1", "10"]);
        assert_eq!(axis.minor_ticks(), Vec::<f64>::new());
        assert_eq!(texts(&Axis::log("r", 0.5, 20.0)), ["1", "10"]);
    }

    #[test]
    fn a_short_logarithmic_axis_has_ticks_between_decades() {
        assert_eq!(texts(&Axis::log("t", 0.15, 4.0)), ["0.2", "0.5", "1", "2"]);
        assert_eq!(texts(&Axis::log("t", 1.5, 6.0)), ["2", "5"]);
    }

    #[test]
    fn a_position_is_where_the_value_is() {
        for axis in [Axis::linear("", -1.0, 3.0), Axis::log("", 1e-3, 1e2)] {
            for position in [0.0, 0.25, 0.5, 1.0] {
                // A few roundings, those of powf and log10 included.
                assert!((axis.position(axis.value(position)) - position).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_round_end_lies_outside() {
        let axis = Axis::linear("", 0.0, 0.137).with_round_end();
        assert!(axis.high >= 0.137 && axis.high < 0.16, "{}", axis.high);
        assert_eq!(Axis::log("", 1e-3, 0.7).with_round_end().high, 1.0);
    }
}
