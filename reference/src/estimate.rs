//! From counts to profiles.
//!
//! All N photons are followed for S scatterings, one in eight of them for L, and those that are left then leave by the
//! diffusion tail. The energy that leaves in a ring is, per photon, x = αⁿ if the photon left there after n ≤ S
//! scatterings, and for those that outlast S, which are the fraction p, on average ȳ: the mean over the followed ones of
//! αⁿ, or of the tail T if they outlast L. So the estimate is
//!
//! x̄ + p ȳ,  with the variance (E\[x²\] + p ȳ² - (x̄ + p ȳ)²)/N + p² (E\[y²\] - ȳ²)/M,
//!
//! where M followed photons outlast S. It has no bias: what a photon does after S does not depend on how many others came
//! that far. α^2n takes the place of αⁿ in the squares.
//!
//! For perpendicular entry, what leaves after one scattering is known exactly ([`crate::single_scattering`]), P in all. Then
//! the photons are those that did something else, and stand for the fraction 1 - P.
//!
//! # The tail
//!
//! In diffusion a photon leaves a half-space after n scatterings with a density ∝ n^(-3/2), independently of its sideways
//! position, which is Gaussian with the variance 2n / 3(1 - g) per axis (each path has the mean square 2, and a
//! direction is kept for 1/(1 - g) of them). Put u² = L/n: then u is uniform in (0, 1), and
//!
//! T = ∫₀¹ α^(L/u²) [exp(-k r_lo² u²) - exp(-k r_hi² u²)] du,  k = 3 (1 - g) / 4L.
//!
//! At L (1 - g) = 10⁴ the next term of the law is 10⁻³ of the first, and the tail is 1 % of the photons.

use std::sync::LazyLock;

use crate::chandrasekhar;
use crate::gauss_legendre::GaussLegendre;
use crate::radial_grid::{RING_EDGES, RINGS};
use crate::{Goal, HalfSpace, RadialBin, RadialTable, Run, root, single_scattering};

/// A mean and one standard deviation of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The estimate.
    pub mean: f64,
    /// One standard deviation of `mean`.
    pub standard_error: f64,
}

/// Why a run cannot say what it was asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EstimateError {
    /// α is outside [0, 1] or not a number.
    #[error("single-scattering albedo {0} is not in [0, 1]: give scattering over extinction")]
    SingleScatteringAlbedo(f64),
    /// A is outside [0, 1] or not a number.
    #[error("surface albedo {0} is not in [0, 1]: give the reflected fraction of what entered")]
    SurfaceAlbedo(f64),
    /// Surface albedos of a table that do not rise.
    #[error("surface albedo {0} does not rise above the one before it: sort them, each once")]
    Order(f64),
    /// There is nothing to estimate from.
    #[error("the run holds no photons yet: simulate some first")]
    NoPhotons,
    /// Radii that do not rise, or that are none of [`RING_EDGES`].
    #[error("radius {0} is not among RING_EDGES, or does not rise: choose the edges from these")]
    Edge(f64),
}

static RULE: LazyLock<GaussLegendre<32>> = LazyLock::new(GaussLegendre::new);

/// Sums of weights and their squares over rings, of one single-scattering albedo.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    /// Up to the short limit: Σ αⁿ, Σ α^2n.
    short: [f64; 2],
    /// Beyond it.
    long: [f64; 2],
    /// Exact energy after one scattering.
    single: f64,
}

impl Sums {
    fn add(&mut self, other: &Sums) {
        for (sum, more) in self.short.iter_mut().zip(other.short) {
            *sum += more;
        }
        for (sum, more) in self.long.iter_mut().zip(other.long) {
            *sum += more;
        }
        self.single += other.single;
    }
}

/// A run seen at one single-scattering albedo.
struct AtAlbedo<'run> {
    run: &'run Run,
    single_scattering_albedo: f64,
    rings: Vec<Sums>,
    /// Photons that did something else than what is known exactly.
    photons: f64,
    /// What they stand for: 1 - P of the module's text.
    share: f64,
    /// Followed photons that outlast the short limit: M.
    outlasting: f64,
    /// p of the module's text.
    outlasting_fraction: f64,
}

impl<'run> AtAlbedo<'run> {
    fn new(run: &'run Run, single_scattering_albedo: f64) -> Result<AtAlbedo<'run>, EstimateError> {
        if !(0.0..=1.0).contains(&single_scattering_albedo) {
            return Err(EstimateError::SingleScatteringAlbedo(single_scattering_albedo));
        }
        if run.batches() == 0 {
            return Err(EstimateError::NoPhotons);
        }
        let count = |counts: &[u64]| counts.iter().sum::<u64>() as f64;
        let mut rings = vec![Sums::default(); RINGS];
        let mut photons = run.photons() as f64;
        let mut share = 1.0;
        let mut first_row = 0;
        if let Some(energy) = single_scattering::energy(&run.half_space, 0.0, f64::INFINITY) {
            first_row = 1;
            photons -= count(run.histogram.row(0));
            share -= energy;
            for (ring, sums) in rings.iter_mut().enumerate() {
                let to = RING_EDGES.get(ring + 1).copied().unwrap_or(f64::INFINITY);
                let energy = single_scattering::energy(&run.half_space, RING_EDGES[ring], to);
                sums.single = single_scattering_albedo * energy.unwrap_or_default();
            }
        }
        let powers = run.counts.powers(single_scattering_albedo);
        let short_rows = run.counts.short_rows();
        let mut outlasting = run.histogram.long_survivors as f64;
        for (row, &power) in powers.iter().enumerate().skip(first_row) {
            let squared = power * power;
            let counts = run.histogram.row(row);
            if row >= short_rows {
                outlasting += count(counts);
            }
            for (sums, &count) in rings.iter_mut().zip(counts) {
                let sums = if row < short_rows { &mut sums.short } else { &mut sums.long };
                sums[0] += power * count as f64;
                sums[1] += squared * count as f64;
            }
        }
        // A run of real photons has some that did more than scatter once; one made up in a file may not.
        let photons = photons.max(1.0);
        let outlasting_fraction = (outlasting + run.histogram.short_survivors as f64) / photons;
        Ok(AtAlbedo { run, single_scattering_albedo, rings, photons, share, outlasting, outlasting_fraction })
    }

    /// What leaves in the rings `from..to`.
    fn energy(&self, from: usize, to: usize) -> Estimate {
        let mut sums = Sums::default();
        for ring in &self.rings[from..to] {
            sums.add(ring);
        }
        let outer = RING_EDGES.get(to).copied().unwrap_or(f64::INFINITY);
        let tail = self.tail(RING_EDGES[from], outer);
        let survivors = self.run.histogram.long_survivors as f64;
        let [x, x_squared] = sums.short.map(|sum| sum / self.photons);
        // In a handful of photons none may outlast the limit. Then nothing is known of what would have been.
        let outlasting = self.outlasting.max(1.0);
        let y = (sums.long[0] + survivors * tail) / outlasting;
        let y_squared = (sums.long[1] + survivors * tail * tail) / outlasting;
        let p = self.outlasting_fraction;
        let mean = x + p * y;
        let variance_of_all = (x_squared + p * y * y - mean * mean).max(0.0);
        let variance_of_outlasting = (y_squared - y * y).max(0.0);
        let variance = variance_of_all / self.photons + p * p * variance_of_outlasting / outlasting;
        Estimate { mean: sums.single + self.share * mean, standard_error: self.share * variance.sqrt() }
    }

    /// T of the module's text.
    fn tail(&self, r_lo: f64, r_hi: f64) -> f64 {
        if self.single_scattering_albedo == 0.0 {
            return 0.0;
        }
        // Half a count: the sum over n > L becomes an integral.
        let long = f64::from(self.run.counts.long()) + 0.5;
        let k = 0.75 * (1.0 - self.run.half_space.anisotropy()) / long;
        let ln_alpha = libm::log(self.single_scattering_albedo);
        if long * ln_alpha < -700.0 {
            return 0.0;
        }
        let outside = |r: f64, u: f64| if r.is_infinite() { 0.0 } else { libm::exp(-k * r * r * u * u) };
        let integrand = |u: f64| libm::exp(long * ln_alpha / (u * u)) * (outside(r_lo, u) - outside(r_hi, u));
        // The Gaussian is narrow for a large radius: panels halve towards 0, to 2⁻⁹.
        let mut to = 1.0;
        let mut sum = 0.0;
        for _ in 0..9 {
            sum += RULE.integrate(to / 2.0, to, integrand);
            to /= 2.0;
        }
        sum + RULE.integrate(0.0, to, integrand)
    }

    fn table(&self, edges: &[usize]) -> RadialTable {
        let total = self.energy(0, RINGS).mean;
        let mut inside = if edges[0] == 0 { 0.0 } else { self.energy(0, edges[0]).mean };
        let bins = edges
            .windows(2)
            .map(|pair| {
                let (r_lo, r_hi) = (RING_EDGES[pair[0]], RING_EDGES[pair[1]]);
                let energy = self.energy(pair[0], pair[1]);
                inside += energy.mean;
                let area = std::f64::consts::TAU * (r_hi - r_lo);
                RadialBin {
                    r_lo,
                    r_hi,
                    r_reflectance: energy.mean / area,
                    standard_error: energy.standard_error / area,
                    cdf_at_r_hi: if total > 0.0 { (inside / total).min(1.0) } else { 0.0 },
                }
            })
            .collect();
        let exact = exact_entry(&self.run.half_space)
            .and_then(|entry| chandrasekhar::surface_albedo(entry, self.single_scattering_albedo).ok());
        RadialTable {
            single_scattering_albedo: self.single_scattering_albedo,
            surface_albedo: exact.unwrap_or(total),
            bins,
        }
    }
}

/// The entry, if the medium is one that [`chandrasekhar`] knows.
fn exact_entry(half_space: &HalfSpace) -> Option<crate::Entry> {
    (half_space.is_matched() && half_space.anisotropy() == 0.0).then(|| half_space.entry())
}

impl Run {
    /// Surface albedo A at `single_scattering_albedo`, as simulated.
    ///
    /// # Errors
    ///
    /// α outside [0, 1]; no photons.
    pub fn surface_albedo(&self, single_scattering_albedo: f64) -> Result<Estimate, EstimateError> {
        Ok(AtAlbedo::new(self, single_scattering_albedo)?.energy(0, RINGS))
    }

    /// The single-scattering albedo α that gives `surface_albedo`: exact for an index-matched isotropic medium, the
    /// inverse of [`surface_albedo`](Run::surface_albedo) otherwise.
    ///
    /// # Errors
    ///
    /// A outside [0, 1]; no photons.
    pub fn single_scattering_albedo(&self, surface_albedo: f64) -> Result<f64, EstimateError> {
        if !(0.0..=1.0).contains(&surface_albedo) {
            return Err(EstimateError::SurfaceAlbedo(surface_albedo));
        }
        if let Some(entry) = exact_entry(&self.half_space) {
            return chandrasekhar::single_scattering_albedo(entry, surface_albedo)
                .map_err(|_| EstimateError::SurfaceAlbedo(surface_albedo));
        }
        // A is nearly linear in q = √(1 - α).
        let single_scattering_albedo = |q: f64| (1.0 - q) * (1.0 + q);
        self.surface_albedo(1.0)?;
        let q = root::falling(0.0, 1.0, |q| {
            let estimate = self.surface_albedo(single_scattering_albedo(q));
            estimate.map_or(f64::NAN, |estimate| estimate.mean) - surface_albedo
        });
        Ok(single_scattering_albedo(q))
    }

    /// The profile at `single_scattering_albedo`, on all of [`RING_EDGES`].
    ///
    /// # Errors
    ///
    /// α outside [0, 1]; no photons.
    pub fn radial_profile(&self, single_scattering_albedo: f64) -> Result<RadialTable, EstimateError> {
        self.radial_profile_on(single_scattering_albedo, &RING_EDGES)
    }

    /// The profile at `single_scattering_albedo` on wider rings: `edges` are a rising selection of [`RING_EDGES`].
    ///
    /// # Errors
    ///
    /// α outside [0, 1]; no photons; another radius than those of [`RING_EDGES`].
    pub fn radial_profile_on(
        &self,
        single_scattering_albedo: f64,
        edges: &[f64],
    ) -> Result<RadialTable, EstimateError> {
        let mut indices: Vec<usize> = Vec::with_capacity(edges.len());
        for &edge in edges {
            let index = RING_EDGES.iter().position(|&known| known == edge);
            match index {
                Some(index) if indices.last().is_none_or(|&last| last < index) => indices.push(index),
                _ => return Err(EstimateError::Edge(edge)),
            }
        }
        let at_albedo = AtAlbedo::new(self, single_scattering_albedo)?;
        Ok(if indices.is_empty() { at_albedo.table(&[0]) } else { at_albedo.table(&indices) })
    }

    /// See [`crate::Progress::relative_standard_error`]. Infinite without photons.
    pub(crate) fn relative_standard_error(&self) -> f64 {
        let Ok(at_albedo) = AtAlbedo::new(self, Goal::SINGLE_SCATTERING_ALBEDO) else {
            return f64::INFINITY;
        };
        let total = at_albedo.energy(0, RINGS).mean;
        (0..RINGS - 1)
            .map(|ring| at_albedo.energy(ring, ring + 1))
            .filter(|energy| energy.mean >= Goal::POPULATED * total)
            .map(|energy| energy.standard_error / energy.mean)
            .fold(0.0, f64::max)
    }
}
