//! Colours and dash patterns that stay apart for readers who see colours differently.

/// A colour in sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub u8, pub u8, pub u8);

impl Colour {
    /// Text, axes, and the truth.
    pub const BLACK: Colour = Colour(0, 0, 0);
    /// What stays in the background.
    pub const GREY: Colour = Colour(120, 120, 120);

    /// Colours of things without an order: those of Okabe and Ito 2008, "Color Universal Design", without the black
    /// and the yellow, which is too pale for a line.
    const UNORDERED: [Colour; 6] = [
        Colour(0, 114, 178),
        Colour(213, 94, 0),
        Colour(0, 158, 115),
        Colour(204, 121, 167),
        Colour(86, 180, 233),
        Colour(230, 159, 0),
    ];

    /// Stops of "viridis" (van der Walt and Smith 2015), from dark to light; its yellow end, too pale, is left out.
    const ORDERED: [Colour; 6] = [
        Colour(68, 1, 84),
        Colour(65, 68, 135),
        Colour(42, 120, 142),
        Colour(34, 168, 132),
        Colour(122, 209, 81),
        Colour(189, 210, 38),
    ];

    /// The colour of item `index` of a list without an order.
    pub fn unordered(index: usize) -> Colour {
        Self::UNORDERED[index % Self::UNORDERED.len()]
    }

    /// The colour of item `index` of `count` that have an order.
    pub fn ordered(index: usize, count: usize) -> Colour {
        let last = Self::ORDERED.len() - 1;
        let position = index as f64 / (count.max(2) - 1) as f64 * last as f64;
        let stop = (position as usize).min(last - 1);
        let (low, high) = (Self::ORDERED[stop], Self::ORDERED[stop + 1]);
        let share = position - stop as f64;
        let mix = |a: u8, b: u8| (f64::from(a) + share * (f64::from(b) - f64::from(a))).round() as u8;
        Colour(mix(low.0, high.0), mix(low.1, high.1), mix(low.2, high.2))
    }
}

/// The pattern of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dash(&'static [u32]);

impl Dash {
    /// Without gaps.
    pub const SOLID: Dash = Dash(&[]);

    /// Lengths of strokes and gaps in tenths of a pixel.
    const PATTERNS: [&'static [u32]; 7] =
        [&[], &[70, 30], &[18, 22], &[90, 25, 18, 25], &[140, 40], &[40, 20], &[90, 20, 18, 20, 18, 20]];

    /// The pattern of item `index` of a list.
    pub fn nth(index: usize) -> Dash {
        Dash(Self::PATTERNS[index % Self::PATTERNS.len()])
    }

    /// Lengths of strokes and gaps in tenths of a pixel; empty for a line without gaps.
    pub(super) fn lengths(self) -> &'static [u32] {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_in_a_list_never_look_alike() {
        for index in 0..20 {
            assert_ne!(Colour::unordered(index), Colour::unordered(index + 1));
            assert_ne!(Dash::nth(index), Dash::nth(index + 1));
            assert_ne!(Colour::ordered(index, 21), Colour::ordered(index + 1, 21));
        }
    }

    #[test]
    fn a_list_of_one_has_a_colour() {
        assert_eq!(Colour::ordered(0, 1), Colour::ORDERED[0]);
    }
}
