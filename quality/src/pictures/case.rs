//! Pictures with their exact results, and how far a kernel is from them.

use std::rc::Rc;

use subsurface_kernel::Estimator;
use subsurface_kernel::{Rejected, Rejection};

use crate::gather::gathered::Rgb;
use crate::gather::point::Point;
use crate::kernels::twin::Twin;
use crate::optics::Optics;
use crate::pictures::patch::Patch;
use crate::pictures::reference::expected;
use crate::pictures::scene::Scene;
use crate::pictures::stage::Stage;

/// Mean radii of the widest channel, pixels.
pub(crate) const FOOTPRINTS: [f64; 5] = [1.0, 3.0, 10.0, 30.0, 100.0];

/// A material in a picture at a footprint.
#[derive(Debug)]
pub(crate) struct Case<'a> {
    pub(crate) scene: Scene,
    pub(crate) mean_radius_pixels: f64,
    stage: Rc<Stage<'a>>,
    patches: Vec<Patch>,
    /// Pixel by pixel, patch by patch; `None` where a pixel shows no surface.
    expected: Vec<Option<Rgb>>,
    /// Kernels that were tried, with their effective taps.
    known: Vec<(Estimator, Deviation)>,
}

/// How far a kernel is from the exact result.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Deviation {
    /// Root mean square over the pixels, the largest over whatever was compared.
    pub(crate) error: f64,
    /// Largest difference of a pixel.
    pub(crate) worst_pixel: f64,
}

impl Deviation {
    pub(crate) fn and(self, other: Self) -> Self {
        Self { error: self.error.max(other.error), worst_pixel: self.worst_pixel.max(other.worst_pixel) }
    }
}

impl<'a> Case<'a> {
    /// All cases of all materials.
    pub(crate) fn all(optics: &'a [Optics], rejection: Rejection) -> Vec<Self> {
        let footprints = optics.iter().flat_map(|optics| FOOTPRINTS.map(|footprint| (optics, footprint)));
        footprints.flat_map(|(optics, footprint)| Self::of_footprint(optics, footprint, rejection)).collect()
    }

    /// The pictures of one material at one footprint.
    pub(crate) fn of_footprint(optics: &'a Optics, mean_radius: f64, rejection: Rejection) -> Vec<Self> {
        let returned = rejection.rejected == Rejected::ReturnedToCentre;
        let point = Point::new(optics, mean_radius, rejection.by_distance, returned);
        let stage = Rc::new(Stage::new(point));
        let of_scene = |scene: Scene| {
            let patches = Patch::all(scene, scene.reach(mean_radius));
            let expected = expected(&point, scene, &patches);
            let stage = Rc::clone(&stage);
            Self { scene, mean_radius_pixels: mean_radius, stage, patches, expected, known: Vec::new() }
        };
        Scene::all(mean_radius).into_iter().map(of_scene).collect()
    }

    /// Whether two kernels of one kind draw the same picture.
    pub(crate) fn tells_apart(&self, a: Estimator, b: Estimator) -> bool {
        Twin::effective(a, &self.stage.point) != Twin::effective(b, &self.stage.point)
    }

    /// How far `kernel` is from the exact result; `None` for `Dense`, which has no twin.
    pub(crate) fn deviation(&mut self, kernel: Estimator) -> Option<Deviation> {
        let effective = Twin::effective(kernel, &self.stage.point);
        if let Some((_, deviation)) = self.known.iter().find(|(known, _)| *known == effective) {
            return Some(*deviation);
        }
        let deviation = self.draw(kernel)?;
        self.known.push((effective, deviation));
        Some(deviation)
    }

    fn draw(&self, kernel: Estimator) -> Option<Deviation> {
        let drawn = self.stage.draw(kernel, self.scene, &self.patches)?;
        let mut squares = [0.0; 3];
        let (mut worst_pixel, mut pixels) = (0.0_f64, 0.0);
        for (place, (pixel, expected)) in drawn.iter().zip(&self.expected).enumerate() {
            // What moves is as it was before.
            let before = Patch::before_pan(place).and_then(|before| drawn.get(before)).copied();
            let expected = if self.scene == Scene::Pan { before } else { *expected };
            let Some(expected) = expected else { continue };
            pixels += 1.0;
            for channel in 0..3 {
                let difference = pixel[channel] - expected[channel];
                squares[channel] += difference * difference;
                worst_pixel = worst_pixel.max(difference.abs());
            }
        }
        let error = squares.into_iter().fold(0.0, f64::max);
        Some(Deviation { error: (error / pixels).sqrt(), worst_pixel })
    }
}
