//! Twin of `shaders/kernels/interleaved/far.wgsl`: what a block gathers from beyond the blocks around it.

use std::f64::consts::TAU;

use subsurface_kernel::constants::{
    BLOCK_SIDE, FAR_QUANTILE, FAR_RADIUS_PIXELS, FAR_STRETCH, LARGEST_FILTER_RADIUS, LATTICE_SLICES,
    LATTICE_START, LATTICE_TURN, PIXELS_OF_BLOCK, RING_TAPS, SPARSE_TAP_AREA,
};

use crate::angle::turned;
use crate::gather::gathered::Gathered;
use crate::gather::point::Point;
use crate::gather::tap::{Tap, pixel_at};
use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;

use super::square::Square;

/// The taps of all slices of the lattice.
#[derive(Debug)]
pub(crate) struct Lattice {
    slices: Vec<Vec<Tap>>,
    /// Share of the light that a tap stands for.
    share: f64,
    /// Side of the squares that taps read, pixels.
    side: i32,
}

/// Taps of a block for its far field, where a pixel has a budget of `taps`.
pub(crate) fn far_taps(taps: u32) -> u32 {
    PIXELS_OF_BLOCK * taps - taps.min(RING_TAPS)
}

impl Lattice {
    /// The lattice for blocks with `taps` taps, of which windows with that variance along an axis mix what they find.
    pub(crate) fn new(point: &Point<'_>, taps: u32, window_variance: f64) -> Self {
        let widest = &point.optics.channels[point.optics.widest];
        let u_inner = widest.profile.radial_cdf(FAR_RADIUS_PIXELS * point.pixel / FAR_STRETCH);
        if taps == 0 || u_inner >= FAR_QUANTILE {
            return Self { slices: vec![Vec::new(); LATTICE_SLICES as usize], share: 0.0, side: BLOCK_SIDE };
        }
        let u_range = FAR_QUANTILE - u_inner;
        let radius = point.filter_radius_pixels.min(LARGEST_FILTER_RADIUS);
        let is_sparse = radius * radius >= SPARSE_TAP_AREA * f64::from(LATTICE_SLICES * taps);
        let side = if is_sparse { 2 * BLOCK_SIDE } else { BLOCK_SIDE };
        let blur = reading_variance(side) + 2.0 * window_variance;
        let slice = |slice: usize| {
            let start = TAU * (LATTICE_START + slice as f64 / f64::from(LATTICE_SLICES));
            let mut direction = [start.cos(), start.sin()];
            let taps = (0..taps).map(|tap| {
                let stratum = (f64::from(tap) + 0.25 + 0.5 * (slice & 1) as f64) / f64::from(taps);
                let (radius, slope) = point.quantile(u_inner + stratum * u_range);
                let here = direction;
                direction = turned(direction, LATTICE_TURN);
                Tap::new(point, (FAR_STRETCH * radius, FAR_STRETCH * slope), here).narrowed(blur)
            });
            taps.collect()
        };
        Self {
            slices: (0..LATTICE_SLICES as usize).map(slice).collect(),
            share: u_range / f64::from(taps),
            side,
        }
    }

    /// The far field of a block whose middle is at `position` of the scene, `depth` pixels away.
    pub(crate) fn gather(
        &self,
        point: &Point<'_>,
        scene: Scene,
        patch: Patch,
        slice: usize,
        position: [f64; 2],
        depth: f64,
    ) -> Gathered {
        let mut gathered = Gathered::default();
        for tap in &self.slices[slice] {
            let place = pixel_at(position, tap.offset);
            let Some(square) = Square::around(point, scene, patch, place, self.side) else { continue };
            let apart = point.depth_pixels(square.depth - depth);
            gathered.add(tap.weight(point, apart), [square.light; 3]);
        }
        let mut far = Gathered::default();
        far.add_share(&gathered, self.share);
        far
    }
}

/// What reading squares of `side` pixels adds to the mean square distance, pixels².
fn reading_variance(side: i32) -> f64 {
    f64::from(side * side - 1) / 3.0
}

/// Slice of the lattice that a block takes.
pub(crate) fn lattice_slice([x, y]: [i32; 2]) -> usize {
    (((x + y) & 1) + 2 * (y & 1)) as usize
}
