//! The colour channels that a medium is described by.

use std::fmt;

/// A colour channel of linear RGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Channel {
    /// The long wavelengths; in most tissue the ones that travel farthest.
    Red,
    /// The middle wavelengths.
    Green,
    /// The short wavelengths.
    Blue,
}

impl Channel {
    /// All channels in the order of their [`index`](Self::index).
    pub const ALL: [Channel; 3] = [Channel::Red, Channel::Green, Channel::Blue];

    /// Position of the channel in an RGB triple: 0, 1 or 2.
    pub const fn index(self) -> usize {
        match self {
            Channel::Red => 0,
            Channel::Green => 1,
            Channel::Blue => 2,
        }
    }
}

impl fmt::Display for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Channel::Red => "red",
            Channel::Green => "green",
            Channel::Blue => "blue",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn index_is_the_position_in_all() {
        for (position, channel) in Channel::ALL.into_iter().enumerate() {
            assert_eq!(channel.index(), position);
        }
    }
}
