//! How wide letters are.

/// Width of a text in the unit of its size, from the mean width of DejaVu's letters.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    0.6 * size * text.chars().count() as f64
}
