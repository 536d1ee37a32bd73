//! The numbers a file may hold: what those of a material mean, and which values are refused. (The models describe their
//! own.)

use subsurface_profile::{Bounds, Quantity};

pub(crate) const MEAN_FREE_PATH: Quantity = Quantity {
    noun: "mean free path",
    unit: "mm",
    bounds: Bounds::Positive,
    kind: "number",
    meaning: "give the mean distance that light travels between two collisions, 1/(σs′ + σa), in mm",
};

pub(crate) const DIFFUSE_MEAN_FREE_PATH: Quantity = Quantity {
    noun: "diffuse mean free path",
    unit: "mm",
    bounds: Bounds::Positive,
    kind: "number",
    meaning: "give the distance in which the diffuse flux falls by a factor e, 1/σtr, in mm",
};

pub(crate) const SURFACE_ALBEDO: Quantity = Quantity {
    noun: "surface albedo",
    unit: "",
    bounds: Bounds::Unit,
    kind: "number",
    meaning: "give the share of the light that the surface reflects in all, from 0 (black) to 1 (white)",
};

pub(crate) const SURFACE_ALBEDO_MIX: Quantity = Quantity {
    noun: "surface albedo mix",
    unit: "",
    bounds: Bounds::Unit,
    kind: "number",
    meaning: "give the power of the surface albedo that light is multiplied by where it enters: 0 for none of it, 1 for all, 0.5 for its square root",
};

pub(crate) const TRANSMITTED_COLOUR: Quantity = Quantity {
    noun: "colour of what comes through",
    unit: "",
    bounds: Bounds::Unit,
    kind: "number",
    meaning: "give the share of the light that is left after `at_distance_mm`, linear, from 0 to 1 (clear)",
};

pub(crate) const DISTANCE: Quantity = Quantity {
    noun: "distance",
    unit: "mm",
    bounds: Bounds::Positive,
    kind: "number",
    meaning: "give the distance at which white light has the colour, in mm",
};

pub(crate) const SHELL_THICKNESS: Quantity = Quantity {
    noun: "thickness of the shell",
    unit: "mm",
    bounds: Bounds::Positive,
    kind: "number",
    meaning: "give the thickness of the walls in mm: 2 for a glass, 0.001 for a soap bubble; leave it out for what is filled",
};

pub(crate) const REFLECTANCE: Quantity = Quantity {
    noun: "reflectance at normal incidence",
    unit: "",
    bounds: Bounds::Unit,
    kind: "number",
    meaning: "give F0 = ((n - 1)/(n + 1))² from 0 to 1: 0.028 for skin, 0.04 for n = 1.5",
};

pub(crate) const ROUGHNESS: Quantity = Quantity {
    noun: "roughness",
    unit: "",
    bounds: Bounds::Unit,
    kind: "number",
    meaning: "give the perceptual roughness, from 0 (mirror) to 1 (rough)",
};

pub(crate) const LOBE_WEIGHT: Quantity = Quantity {
    noun: "weight of the second lobe",
    unit: "",
    bounds: Bounds::Unit,
    kind: "share",
    meaning: "give the second lobe's share of the highlight, from 0 to 1: 0.15 to 0.3 for oily skin",
};

pub(crate) const TRANSMISSION: Quantity = Quantity {
    noun: "transmission strength",
    unit: "",
    bounds: Bounds::NonNegative,
    kind: "number",
    meaning: "give a factor from 0 (no light comes through); 1 is the transmittance of the material",
};

pub(crate) const THICKNESS: Quantity = Quantity {
    noun: "thickness",
    unit: "mm",
    bounds: Bounds::Positive,
    kind: "number",
    meaning: "give the thickness of the sheet in mm: 0.25 for a leaf, 0.1 for paper",
};

pub(crate) const SCATTERING: Quantity = Quantity {
    noun: "scattering coefficient",
    unit: "per mm",
    bounds: Bounds::NonNegative,
    kind: "number",
    meaning: "give the number of scatterings per millimetre, σs or σs′ = (1 - g) σs",
};

pub(crate) const ABSORPTION: Quantity = Quantity {
    noun: "absorption coefficient",
    unit: "per mm",
    bounds: Bounds::NonNegative,
    kind: "number",
    meaning: "give the number of absorptions per millimetre, σa",
};

pub(crate) const ANISOTROPY: Quantity = Quantity {
    noun: "anisotropy",
    unit: "",
    bounds: Bounds::Between(-1, 1),
    kind: "number",
    meaning: "give the mean cosine of the scattering angle: 0 for isotropic, 0.8 for tissue",
};

pub(crate) const REFRACTIVE_INDEX: Quantity = Quantity {
    noun: "refractive index",
    unit: "",
    bounds: Bounds::Between(1, 2),
    kind: "number",
    meaning: "give the index of the medium over that of what is outside: 1.33 for water, 1.4 for tissue, 1.5 for stone",
};

/// Why a number is refused: the message and the label.
pub(crate) struct Refusal {
    pub(crate) message: String,
    pub(crate) label: String,
    pub(crate) help: String,
}

/// Checks `value`, written as `text`: it is within the bounds of its quantity, and fits into a 32-bit float.
pub(crate) fn check(quantity: &Quantity, value: f64, text: &str) -> Result<(), Refusal> {
    let Quantity { noun, unit, meaning, .. } = quantity;
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let refusal = |message: String, label: &str, help: &str| {
        Err(Refusal { message, label: label.to_owned(), help: help.to_owned() })
    };
    if value.is_nan() {
        return refusal(format!("{noun} is not a number"), "expected a number, found NaN", meaning);
    }
    if value.is_infinite() && text.contains("inf") {
        return refusal(format!("{noun} is infinite"), "expected a finite number", meaning);
    }
    let magnitude = value.abs();
    if magnitude > f64::from(f32::MAX) {
        return refusal(
            format!("{noun} {text}{unit} does not fit into a 32-bit float"),
            "too large",
            "the GPU computes in 32-bit floats: the largest is 3.4e38",
        );
    }
    if !quantity.bounds.contain(value) {
        return refusal(format!("{noun} is {text}{unit}"), &quantity.expected(), meaning);
    }
    // A denormal may be flushed to 0 on the GPU (WGSL §15.7.2), and a text such as 1e-400 is 0 already.
    let written_zero =
        !text.split(['e', 'E']).next().unwrap_or(text).contains(|c: char| ('1'..='9').contains(&c));
    if magnitude < f64::from(f32::MIN_POSITIVE) && !written_zero {
        return refusal(
            format!("{noun} {text}{unit} does not fit into a 32-bit float"),
            "too small: it would become 0",
            "the GPU computes in 32-bit floats: the smallest above 0 is 1.2e-38",
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(quantity: &Quantity, text: &str) -> Option<String> {
        let value = ron::from_str::<f64>(text).expect("a number");
        check(quantity, value, text).err().map(|refusal| refusal.message)
    }

    #[test]
    fn what_a_32_bit_float_cannot_hold_is_refused() {
        for text in ["1e60", "-1e60", "1e400", "1e-60", "-1e-60", "1e-400", "1e-39"] {
            let message = message(&Quantity::COEFFICIENT, text).expect("refused");
            assert!(message.contains("does not fit into a 32-bit float"), "{text}: {message}");
        }
        for text in ["0", "0.0", "-0.0", "0e5", "3.4e38", "1.2e-38", "1"] {
            assert_eq!(message(&Quantity::COEFFICIENT, text), None, "{text}");
        }
    }

    #[test]
    fn bounds_hold_at_their_ends() {
        for (quantity, legal, illegal) in [
            (&MEAN_FREE_PATH, ["1e-30", "1e30"], ["0", "-1"]),
            (&SURFACE_ALBEDO, ["0", "1"], ["-0.001", "1.001"]),
            (&TRANSMISSION, ["0", "100"], ["-1e-6", "-1"]),
        ] {
            assert!(legal.iter().all(|text| message(quantity, text).is_none()));
            assert!(illegal.iter().all(|text| message(quantity, text).is_some()));
            assert!(["NaN", "inf", "-inf"].iter().all(|text| message(quantity, text).is_some()));
        }
    }
}
