//! Reflection and refraction of unpolarized light at a plane interface.

/// What happens to light that meets an interface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Interface {
    /// Reflected fraction, 0 to 1.
    pub(super) reflectance: f64,
    /// Cosine of the angle of refraction, above 0 where anything is refracted.
    pub(super) refracted_cosine: f64,
}

/// Light in a medium of index `from` meets one of index `to` at an angle of incidence with `cosine` in [0, 1].
///
/// Fresnel's equations, mean of both polarizations; Snell's law.
pub(super) fn fresnel(from: f64, to: f64, cosine: f64) -> Interface {
    if from == to {
        return Interface { reflectance: 0.0, refracted_cosine: cosine };
    }
    let ratio = from / to;
    let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if square <= 0.0 {
        return Interface { reflectance: 1.0, refracted_cosine: 0.0 };
    }
    let refracted_cosine = square.sqrt();
    // Polarized across and along the plane of incidence.
    let crossed = (from * cosine - to * refracted_cosine) / (from * cosine + to * refracted_cosine);
    let parallel = (from * refracted_cosine - to * cosine) / (from * refracted_cosine + to * cosine);
    Interface { reflectance: 0.5 * (crossed * crossed + parallel * parallel), refracted_cosine }
}

/// Reflectance of a pile of clear plates for perpendicular light, with all reflections between them added without
/// interference: R = r + (1 − r)² R′/(1 − r R′) from the lowest interface up (\[WJZ95\] for one plate).
///
/// `indices` are those of all media that the light passes, first and last included.
pub(super) fn clear_reflectance(indices: &[f64]) -> f64 {
    indices.windows(2).rev().fold(0.0, |below, pair| {
        let own = fresnel(pair[0], pair[1], 1.0).reflectance;
        own + (1.0 - own) * (1.0 - own) * below / (1.0 - own * below)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energy_goes_both_ways_alike() {
        // Stokes' relations: the reflectance is the same along the reversed path. 1e-12 is rounding, magnified by
        // 1/cosine near grazing.
        for (from, to) in [(1.0, 1.5), (1.37, 1.0), (1.4, 1.33)] {
            for step in 1..=1000 {
                let there = fresnel(from, to, f64::from(step) / 1000.0);
                if there.reflectance < 1.0 {
                    let back = fresnel(to, from, there.refracted_cosine);
                    assert!((there.reflectance - back.reflectance).abs() < 1e-12, "{from} {to} {step}");
                }
            }
        }
    }

    #[test]
    fn known_angles() {
        // Normal incidence on glass: ((1.5 − 1)/(1.5 + 1))² = 0.04.
        assert!((fresnel(1.0, 1.5, 1.0).reflectance - 0.04).abs() < 1e-15);
        // Brewster's angle, tan θ = 1.5: one polarization vanishes, the other reflects ((n² − 1)/(n² + 1))².
        let brewster = 1.0 / (1.0_f64 + 1.5 * 1.5).sqrt();
        let half = 0.5 * (1.25_f64 / 3.25).powi(2);
        assert!((fresnel(1.0, 1.5, brewster).reflectance - half).abs() < 1e-15);
        // Beyond the critical angle nothing leaves; grazing light is reflected whole.
        assert_eq!(fresnel(1.5, 1.0, 0.7).reflectance, 1.0);
        assert_eq!(fresnel(1.0, 1.5, 0.0).reflectance, 1.0);
        assert_eq!(fresnel(1.4, 1.4, 0.0).reflectance, 0.0);
    }

    #[test]
    fn plates() {
        assert_eq!(clear_reflectance(&[1.4]), 0.0);
        assert!((clear_reflectance(&[1.0, 1.5]) - 0.04).abs() < 1e-15);
        // A plate in air: 2r/(1 + r).
        assert!((clear_reflectance(&[1.0, 1.5, 1.0]) - 0.08 / 1.04).abs() < 1e-15);
        // A cut through a plate changes nothing.
        assert_eq!(clear_reflectance(&[1.0, 1.5, 1.5, 1.37]), clear_reflectance(&[1.0, 1.5, 1.37]));
    }
}
