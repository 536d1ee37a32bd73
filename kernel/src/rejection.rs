//! Which taps an estimator leaves out, and where their light goes.

use std::fmt;

/// Which taps an estimator leaves out because no light gets from there to the pixel under the surface, and what becomes of
/// their weight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rejection {
    /// Leaves out taps on another material.
    pub by_material: bool,
    /// Weights taps by their distance in space, not on the screen (Liang et al. 2023, eq. 22): across a step in depth
    /// little is left.
    pub by_distance: bool,
    /// Leaves out taps whose surface faces away from the pixel's.
    pub by_normal: bool,
    /// What becomes of the weight of taps that are left out.
    pub rejected: Rejected,
}

/// What becomes of the weight of taps that an estimator leaves out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rejected {
    /// The other taps share it: a constant irradiance stays constant.
    #[default]
    Renormalized,
    /// The pixel itself gets it: energy that would have left comes back to where it entered.
    ReturnedToCentre,
}

impl Default for Rejection {
    fn default() -> Self {
        Self { by_material: true, by_distance: true, by_normal: false, rejected: Rejected::Renormalized }
    }
}

impl Rejected {
    /// Name as in material files: `Renormalized` or `ReturnedToCentre`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Renormalized => "Renormalized",
            Self::ReturnedToCentre => "ReturnedToCentre",
        }
    }
}

/// As the header of the generated text has it: `by material, by distance; rejected energy is renormalized`.
impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let reasons: Vec<&str> = [
            (self.by_material, "by material"),
            (self.by_distance, "by distance"),
            (self.by_normal, "by normal"),
        ]
        .into_iter()
        .filter_map(|(holds, reason)| holds.then_some(reason))
        .collect();
        if reasons.is_empty() {
            return f.write_str("none");
        }
        let rejected = match self.rejected {
            Rejected::Renormalized => "renormalized",
            Rejected::ReturnedToCentre => "returned to the centre",
        };
        write!(f, "{}; rejected energy is {rejected}", reasons.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn policies_in_words() {
        let default = Rejection::default();
        assert_eq!(default.to_string(), "by material, by distance; rejected energy is renormalized");
        let none = Rejection { by_material: false, by_distance: false, ..default };
        assert_eq!(none.to_string(), "none");
        let returned = Rejection { by_normal: true, rejected: Rejected::ReturnedToCentre, ..none };
        assert_eq!(returned.to_string(), "by normal; rejected energy is returned to the centre");
    }
}
