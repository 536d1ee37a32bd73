//! What a number means, and which values it may take.

use std::borrow::Cow;

/// Legal values of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bounds {
    /// Any finite number.
    Any,
    /// Above 0.
    Positive,
    /// 0 or more.
    NonNegative,
    /// From 0 to 1, both included.
    Unit,
    /// Between two whole numbers, both included.
    Between(i8, i8),
}

impl Bounds {
    /// Whether a number is within them. NaN and infinities never are.
    pub fn contain(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Bounds::Any => true,
                Bounds::Positive => value > 0.0,
                Bounds::NonNegative => value >= 0.0,
                Bounds::Unit => (0.0..=1.0).contains(&value),
                Bounds::Between(low, high) => (f64::from(low)..=f64::from(high)).contains(&value),
            }
    }

    /// The values in a few words, for a table: `above 0`.
    pub fn words(self) -> Cow<'static, str> {
        match self {
            Bounds::Any => "any".into(),
            Bounds::Positive => "above 0".into(),
            Bounds::NonNegative => "0 or more".into(),
            Bounds::Unit => "0 to 1".into(),
            Bounds::Between(low, high) => format!("{low} to {high}").into(),
        }
    }
}

/// What a number measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// The noun that begins a message, such as `mean free path`.
    pub noun: &'static str,
    /// `mm`, `mm²`, or nothing for a number without a unit.
    pub unit: &'static str,
    /// What it may be.
    pub bounds: Bounds,
    /// What kind of number it is, for a message: `number`, `share` or `ratio`.
    pub kind: &'static str,
    /// What the number is, as a remedy: `give …`.
    pub meaning: &'static str,
}

impl Quantity {
    /// A coefficient of a formula, which may be any finite number.
    pub const COEFFICIENT: Quantity = Quantity {
        noun: "coefficient",
        unit: "",
        bounds: Bounds::Any,
        kind: "number",
        meaning: "give a finite number",
    };

    /// What is expected of a number that is out of bounds.
    pub fn expected(&self) -> String {
        match self.bounds {
            Bounds::Any => "expected a finite number".to_owned(),
            Bounds::Positive => format!("expected a {} above 0", self.kind),
            Bounds::NonNegative => "expected 0 or more".to_owned(),
            Bounds::Unit => format!("expected a {} from 0 to 1", self.kind),
            Bounds::Between(low, high) => format!("expected a {} from {low} to {high}", self.kind),
        }
    }
}

/// A number with four significant digits, as messages show it: the last digits of e^x differ between systems, and a
/// message must not.
pub fn rounded(value: f64) -> String {
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

    #[test]
    fn bounds_hold_at_their_ends() {
        for (bounds, legal, illegal) in [
            (Bounds::Any, [-1e300, 0.0], [f64::NAN, f64::INFINITY]),
            (Bounds::Positive, [1e-300, 1e300], [0.0, -1.0]),
            (Bounds::NonNegative, [0.0, 1e300], [-1e-300, f64::NAN]),
            (Bounds::Unit, [0.0, 1.0], [-1e-300, 1.0 + f64::EPSILON]),
            (Bounds::Between(-1, 2), [-1.0, 2.0], [-1.0 - f64::EPSILON, f64::NAN]),
        ] {
            assert!(legal.into_iter().all(|value| bounds.contain(value)), "{bounds:?}");
            assert!(!illegal.into_iter().any(|value| bounds.contain(value)), "{bounds:?}");
        }
    }
}
