//! Quantile radii of a profile as the kernels read them: what `shaders/gather/curve.wgsl` finds in its texture.

use subsurface_kernel::constants::{CURVE_STEPS, EDGE_POWER, SMALLEST_ROOT};
use subsurface_profile::description::{Contents, Dependence};
use subsurface_profile::{Model, RadialProfile};

/// Steps of a curve.
pub const STEPS: usize = CURVE_STEPS as usize;

/// Largest surface albedo that has a curve of its own: at 1 itself the profile falls as r⁻³, and its last quantile is of
/// no use.
pub const LARGEST_SURFACE_ALBEDO: f64 = 0.999;

/// Curves of a model whose shape depends on the surface albedo.
///
/// Node k lies at v = k/15 with A = 1 - (1 - v)²: profiles widen without bound as A nears 1, roughly as 1/√(1 - A), so
/// nodes at even steps of √(1 - A) follow them.
pub const NODES: u32 = 16;

/// Surface albedo of a node.
pub fn node_albedo(node: u32) -> f64 {
    let remainder = 1.0 - f64::from(node) / f64::from(NODES - 1);
    (1.0 - remainder * remainder).min(LARGEST_SURFACE_ALBEDO)
}

/// The share that ends a curve. The radius of the whole energy is infinite for most models.
pub const LAST_SHARE: f64 = 0.9999;

/// Least relative step between neighbouring radii: eight steps of an f32, so that they differ on the GPU too.
const LEAST_STEP: f64 = 1e-6;

/// Values at the ends of all steps.
pub type Knots = [f64; STEPS + 1];

/// What the curves of a model are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodesOf {
    /// The surface albedo: channels differ by it and by the length that the curve is counted in.
    SurfaceAlbedo,
    /// The channel: lengths are absolute, and so are radii, in mm.
    Channel,
    /// Both, channel by channel; radii are in mm, for the material's own lengths.
    Both,
}

impl NodesOf {
    /// Those of a model. Mixtures have both, so that all of them are read alike.
    pub fn model(model: &Model) -> Self {
        match (model.contents(), model.dependence()) {
            (Contents::Parts(_), _) | (_, Dependence::MediumAndChannel) => Self::Both,
            (_, Dependence::Channel) => Self::Channel,
            (_, Dependence::Medium) => Self::SurfaceAlbedo,
        }
    }
}

/// Radii within which the share u = 1 - (1 - t)² of the energy leaves, t = j/64: steps of t are finer in the tail, where
/// radii grow fastest. Strictly increasing, so that a kernel can search for a radius.
pub fn quantiles(profile: &dyn RadialProfile) -> Knots {
    let mut last = 0.0;
    std::array::from_fn(|index| {
        let beyond = 1.0 - fraction(index);
        let share = if index == STEPS { LAST_SHARE } else { 1.0 - beyond * beyond };
        let radius = profile.sample_radius(share);
        if index > 0 {
            let least = last * (1.0 + LEAST_STEP) + f64::from(f32::MIN_POSITIVE);
            last = if radius > least { radius } else { least };
        }
        last
    })
}

/// Distances on both sides of a line within which the share s = 1 - (1 - t)² of its light lands, t = j/64, where the
/// share beyond a distance is `beyond` at even steps of the EDGE_POWER-th root of that, up to `reach`, and straight between.
pub fn line_quantiles(beyond: &Knots, reach: f64) -> Knots {
    let mut step = 0;
    std::array::from_fn(|index| {
        let outside = 1.0 - fraction(index);
        let beyond_there = 0.5 * outside * outside;
        while step < STEPS && beyond[step + 1] > beyond_there {
            step += 1;
        }
        if step == STEPS {
            return reach;
        }
        let (start, end) = (beyond[step], beyond[step + 1]);
        let part = if start > end { ((start - beyond_there) / (start - end)).clamp(0.0, 1.0) } else { 0.0 };
        reach * ((step as f64 + part) / STEPS as f64).powi(EDGE_POWER)
    })
}

/// j/64, the place of a knot.
pub fn fraction(index: usize) -> f64 {
    index as f64 / STEPS as f64
}

/// (radius, its derivative by u) at the quantile `u` of a curve: twin of `curve_quantile`.
pub(crate) fn quantile(curve: &Knots, u: f64) -> (f64, f64) {
    let steps = STEPS as f64;
    let root = (1.0 - u).max(0.0).sqrt();
    let place = (1.0 - root) * steps;
    let step = place.floor().min(steps - 1.0);
    let start = curve[step as usize];
    let rise = curve[step as usize + 1] - start;
    (start + rise * (place - step), rise * steps * 0.5 / root.max(SMALLEST_ROOT))
}

/// Mean radius of a curve: between two of its knots the radius grows evenly with t, u = 1 - (1 - t)².
pub(crate) fn mean_radius(curve: &Knots) -> f64 {
    let share = |index: usize| 1.0 - (1.0 - fraction(index)).powi(2);
    curve
        .windows(2)
        .enumerate()
        .map(|(index, ends)| 0.5 * (ends[0] + ends[1]) * (share(index + 1) - share(index)))
        .sum()
}
