//! Twin of `shaders/kernels/interleaved/far.wgsl`: what a block gathers from beyond the ring.

use std::f64::consts::TAU;

use subsurface_kernel::constants::{FAR_QUANTILE, FAR_RADIUS_PIXELS, FAR_STRETCH, LATTICE_SLICES};

use crate::angle::turned;
use crate::gather::gathered::Gathered;
use crate::gather::point::Point;
use crate::gather::tap::{Tap, pixel_at};
use crate::pictures::scene::Scene;

/// The taps of all slices of the lattice.
#[derive(Debug)]
pub(crate) struct Lattice {
    slices: Vec<Vec<Tap>>,
    /// Share of the light that a tap stands for.
    share: f64,
}

impl Lattice {
    /// The lattice for blocks with `taps` taps.
    pub(crate) fn new(point: &Point<'_>, taps: u32) -> Self {
        let widest = &point.optics.channels[point.optics.widest];
        let u_inner = widest.profile.radial_cdf(FAR_RADIUS_PIXELS * point.pixel / FAR_STRETCH);
        if taps == 0 || u_inner >= FAR_QUANTILE {
            return Self { slices: vec![Vec::new(); LATTICE_SLICES as usize], share: 0.0 };
        }
        let u_range = FAR_QUANTILE - u_inner;
        let slice = |slice: usize| {
            let start = TAU * slice as f64 / f64::from(LATTICE_SLICES);
            let mut direction = [start.cos(), start.sin()];
            let taps = (0..taps).map(|tap| {
                let within = (slice as f64 + 0.5) / f64::from(LATTICE_SLICES);
                let stratum = (f64::from(tap) + within) / f64::from(taps);
                let (radius, slope) = point.quantile(u_inner + stratum * u_range);
                let here = direction;
                direction = turned(direction);
                Tap::new(point, (FAR_STRETCH * radius, FAR_STRETCH * slope), here)
            });
            taps.collect()
        };
        Self { slices: (0..LATTICE_SLICES as usize).map(slice).collect(), share: u_range / f64::from(taps) }
    }

    /// The far field of a block whose middle is at `position` of the scene, `depth` pixels away.
    pub(crate) fn gather(
        &self,
        point: &Point<'_>,
        scene: Scene,
        slice: usize,
        position: [f64; 2],
        depth: f64,
    ) -> Gathered {
        let mut gathered = Gathered::default();
        for tap in &self.slices[slice] {
            let [x, y] = pixel_at(position, tap.offset);
            let apart = point.depth_pixels(scene.depth(x) - depth);
            gathered.add(tap.weight(point, apart), [scene.light(x, y); 3]);
        }
        let mut far = Gathered::default();
        far.add_share(&gathered, self.share);
        far
    }
}

/// Slice of the lattice that a block takes.
pub(crate) fn lattice_slice([x, y]: [i32; 2]) -> usize {
    ((x & 1) + 2 * ((x + y) & 1)) as usize
}
