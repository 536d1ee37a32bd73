//! A point source in a half-space of diffusing medium.

use std::f64::consts::PI;

/// The field of an isotropic point source of power 1 below a surface, by the method of images: the source, and its
/// negative mirrored at the extrapolated surface where the fluence vanishes.
///
/// Lengths are in reduced mean free paths 1/σt′.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointSource {
    diffusion_coefficient: f64,
    transport_extinction: f64,
    extrapolation: f64,
}

/// What a point source sends to a point of the surface, or to the whole of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field {
    /// φ.
    pub(super) fluence: f64,
    /// E = D ∂φ/∂z: the net flux through the surface, outwards.
    pub(super) flux: f64,
}

impl PointSource {
    /// D = 1/(3σt′) and z_b = 2AD, where `reflection` is A (Jensen et al. 2001).
    pub(super) fn classical(reduced_absorption: f64, reflection: f64) -> PointSource {
        PointSource::new(1.0 / 3.0, reduced_absorption, reflection)
    }

    /// Grosjean's D = (2σa + σs′)/(3σt′²) (d'Eon and Irving 2011), and z_b = 2AD.
    pub(super) fn grosjean(reduced_absorption: f64, reflection: f64) -> PointSource {
        // With σt′ = 1, 2σa + σs′ = 1 + σa.
        PointSource::new((1.0 + reduced_absorption) / 3.0, reduced_absorption, reflection)
    }

    fn new(diffusion_coefficient: f64, reduced_absorption: f64, reflection: f64) -> PointSource {
        PointSource {
            diffusion_coefficient,
            transport_extinction: (reduced_absorption / diffusion_coefficient).sqrt(),
            extrapolation: 2.0 * reflection * diffusion_coefficient,
        }
    }

    /// σtr = √(σa/D).
    pub(super) fn transport_extinction(&self) -> f64 {
        self.transport_extinction
    }

    /// z_b = 2AD, the height above the surface where the fluence vanishes.
    pub(super) fn extrapolation(&self) -> f64 {
        self.extrapolation
    }

    /// z_b/D, which stays finite where σtr vanishes.
    fn extrapolation_over_diffusion(&self) -> f64 {
        self.extrapolation / self.diffusion_coefficient
    }

    /// `weight` times the field at `radius`, of a source at `depth` > 0. The weight is taken in early: `radius` times
    /// the field stays finite where the field does not.
    pub(super) fn field(&self, weight: f64, radius: f64, depth: f64) -> Field {
        let image_height = depth + 2.0 * self.extrapolation;
        let (to_source, to_image) = (libm::hypot(radius, depth), libm::hypot(radius, image_height));
        let s = self.transport_extinction;
        let source = weight / to_source * libm::exp(-s * to_source);
        let image = weight / to_image * libm::exp(-s * to_image);
        Field {
            fluence: (source - image) / (4.0 * PI * self.diffusion_coefficient),
            flux: (source * (depth / to_source) * (s + 1.0 / to_source)
                + image * (image_height / to_image) * (s + 1.0 / to_image))
                / (4.0 * PI),
        }
    }

    /// ∫ field 2πr dr over the whole surface.
    pub(super) fn total(&self, depth: f64) -> Field {
        let s = self.transport_extinction;
        let (source, image) = (libm::exp(-s * depth), libm::exp(-s * (depth + 2.0 * self.extrapolation)));
        Field {
            // (e^{-s z} - e^{-s (z + 2 z_b)})/(2 D s), where x = 2 s z_b.
            fluence: source
                * self.extrapolation_over_diffusion()
                * mean_attenuation(2.0 * s * self.extrapolation),
            flux: 0.5 * (source + image),
        }
    }

    /// ∫ total(t) e⁻ᵗ dt: the whole surface, and a beam from the surface downwards.
    pub(super) fn total_of_beam(&self) -> Field {
        let s = self.transport_extinction;
        let image = libm::exp(-2.0 * s * self.extrapolation);
        Field {
            fluence: self.extrapolation_over_diffusion() * mean_attenuation(2.0 * s * self.extrapolation)
                / (1.0 + s),
            flux: 0.5 * (1.0 + image) / (1.0 + s),
        }
    }
}

/// (1 - e⁻ˣ)/x.
fn mean_attenuation(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { -libm::expm1(-x) / x }
}
