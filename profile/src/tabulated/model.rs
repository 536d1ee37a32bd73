//! Tables by surface albedo, on common radii.

use std::f64::consts::PI;
use std::sync::Arc;

use thiserror::Error;

use crate::description::{Contents, Description, Notation, ProfileModel, Published, Variable};
use crate::radial_data::CLOSEST;
use crate::{Channel, Length, Medium, ModelError, RadialData, RadialProfile, RadialRow};

use super::TabulatedProfile;
use super::hermite::{Piece, knot_densities};

/// Profiles given by tables: one for each of some surface albedos, radii in mean free paths.
///
/// The cdf of a table is a monotone cubic between its radii, exact at the edges of its bins; a table of points is
/// read as straight lines between its values of 2πr·R, but for the last piece, which has the same energy and falls to
/// 0 at its end. Before its first point r·R is constant, and beyond its last radius a table is 0. Each is normalised
/// by its own integral.
///
/// Between two surface albedos the cdfs at equal radius are mixed linearly: a mixture of profiles is a profile.
/// Outside of the tabulated range the nearest table holds.
#[derive(Clone, Debug, PartialEq)]
pub struct TabulatedModel {
    /// Radii at which all curves have a knot: from 0, increasing, at least two.
    radii: Arc<[f64]>,
    /// By surface albedo, increasing; at least one.
    curves: Arc<[Curve]>,
}

/// The table of one surface albedo.
#[derive(Clone, Debug, PartialEq)]
struct Curve {
    surface_albedo: f64,
    /// Integral of the table before it was normalised, over its surface albedo.
    energy: f64,
    /// Density at each radius, per mean free path.
    densities: Vec<f64>,
    /// Fraction of the energy between each radius and the next; 0 for the last.
    masses: Vec<f64>,
}

/// What a table says at one of [`TabulatedModel::radii`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TabulatedKnot {
    /// Radius in mean free paths.
    pub radius: f64,
    /// Fraction of the energy within, in [0, 1].
    pub cdf: f64,
    /// 2πr·R/A at the radius, per mean free path.
    pub density: f64,
    /// The mean of 2πr·R/A from this radius to the next, per mean free path; 0 at the last.
    pub mean_density: f64,
}

/// Why tables make no model. Rows count from 0 within the table of their surface albedo.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TabulatedError {
    /// No table.
    #[error("there is no table: give one for at least one surface albedo")]
    NoData,
    /// Two tables of one surface albedo.
    #[error("surface albedo {surface_albedo} is given twice: merge its tables or remove one")]
    RepeatedSurfaceAlbedo {
        /// The surface albedo.
        surface_albedo: f64,
    },
    /// No bin covers these radii, so the energy there is unknown.
    #[error("surface albedo {surface_albedo}: no bin covers the radii from {from} to {to}")]
    Gap {
        /// The surface albedo.
        surface_albedo: f64,
        /// The row after the gap.
        row: usize,
        /// Where the gap begins.
        from: f64,
        /// Where it ends.
        to: f64,
    },
    /// Two radii that a 32-bit float cannot tell apart.
    #[error("surface albedo {surface_albedo}: the radii {from} and {to} are too close to each other")]
    TooClose {
        /// The surface albedo.
        surface_albedo: f64,
        /// The row of the second radius.
        row: usize,
        /// The first radius.
        from: f64,
        /// The second.
        to: f64,
    },
    /// More entries than a kernel should carry.
    #[error(
        "{radii} radii of {surface_albedos} surface albedos make more than {limit} entries: use the same \
         radii for every surface albedo, or fewer"
    )]
    TooLarge {
        /// Different radii of all tables.
        radii: usize,
        /// Number of tables.
        surface_albedos: usize,
        /// [`TabulatedModel::MAXIMUM_ENTRIES`].
        limit: usize,
    },
}

impl TabulatedModel {
    /// The length this model is parametrized by.
    pub const LENGTH: Length = Length::MeanFreePath;

    /// Most entries that a model has: radii times surface albedos. 5 MB on the GPU.
    pub const MAXIMUM_ENTRIES: usize = 1 << 18;

    /// The model of these tables, one for each surface albedo, in any order.
    pub fn new(data: &[RadialData]) -> Result<TabulatedModel, TabulatedError> {
        let mut data: Vec<&RadialData> = data.iter().collect();
        data.sort_by(|a, b| a.surface_albedo().total_cmp(&b.surface_albedo()));
        if data.is_empty() {
            return Err(TabulatedError::NoData);
        }
        if let Some(pair) = data.windows(2).find(|pair| pair[0].surface_albedo() == pair[1].surface_albedo())
        {
            let surface_albedo = pair[0].surface_albedo();
            return Err(TabulatedError::RepeatedSurfaceAlbedo { surface_albedo });
        }
        for table in &data {
            check_table(table)?;
        }
        let radii = common_radii(&data);
        if radii.len().saturating_mul(data.len()) > Self::MAXIMUM_ENTRIES {
            return Err(TabulatedError::TooLarge {
                radii: radii.len(),
                surface_albedos: data.len(),
                limit: Self::MAXIMUM_ENTRIES,
            });
        }
        let curves = data.iter().map(|table| Curve::new(table, &radii)).collect();
        Ok(TabulatedModel { radii: radii.into(), curves })
    }

    /// Surface albedos of the tables, increasing.
    pub fn surface_albedos(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        self.curves.iter().map(|curve| curve.surface_albedo)
    }

    /// Radii at which every table has a knot, in mean free paths: from 0, increasing, at least two.
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// The knots of all tables, table by table in the order of [`surface_albedos`](Self::surface_albedos).
    pub fn knots(&self) -> impl Iterator<Item = TabulatedKnot> + '_ {
        let radii = &self.radii;
        self.curves.iter().flat_map(move |curve| {
            let mut cdf = 0.0;
            radii.iter().enumerate().map(move |(index, &radius)| {
                let mass = curve.masses[index];
                let mean_density = radii.get(index + 1).map_or(0.0, |next| mass / (next - radius));
                let knot = TabulatedKnot {
                    radius,
                    cdf: f64::min(cdf, 1.0),
                    density: curve.densities[index],
                    mean_density,
                };
                cdf += mass;
                knot
            })
        })
    }

    /// The integral of a table before it was normalised, over its surface albedo: 1 if nothing is missing.
    ///
    /// Between two tables it is interpolated as the profile is.
    pub fn energy_before_normalization(&self, surface_albedo: f64) -> f64 {
        let (lower, upper, t) = self.between(surface_albedo);
        (1.0 - t) * lower.energy + t * upper.energy
    }

    /// The profile of a medium whose length is the mean free path.
    pub fn profile(&self, medium: Medium) -> Result<TabulatedProfile, ModelError> {
        let surface_albedo = medium.surface_albedo();
        let (lower, upper, t) = self.between(surface_albedo);
        let end_mm = self.radii[self.radii.len() - 1] * medium.mean_free_path_mm();
        if !(end_mm > 0.0 && end_mm.is_finite()) {
            return Err(ModelError::OutOfNumericRange { quantity: "r_max", surface_albedo });
        }
        let mix = move |(lower, upper): (&f64, &f64)| (1.0 - t) * lower + t * upper;
        let densities = lower.densities.iter().zip(&upper.densities).map(mix);
        let masses = lower.masses.iter().zip(&upper.masses).map(mix);
        Ok(TabulatedProfile::new(
            surface_albedo,
            medium.mean_free_path_mm(),
            Arc::clone(&self.radii),
            densities.zip(masses),
        ))
    }

    /// The tables on either side of a surface albedo, and how far it is from the lower to the upper.
    fn between(&self, surface_albedo: f64) -> (&Curve, &Curve, f64) {
        let curves = &self.curves;
        let above = curves.partition_point(|curve| curve.surface_albedo <= surface_albedo);
        let lower = &curves[above.saturating_sub(1)];
        let upper = &curves[above.min(curves.len() - 1)];
        let span = upper.surface_albedo - lower.surface_albedo;
        if span <= 0.0 {
            return (lower, upper, 0.0);
        }
        (lower, upper, ((surface_albedo - lower.surface_albedo) / span).clamp(0.0, 1.0))
    }
}

impl ProfileModel for TabulatedModel {
    const DESCRIPTION: Description = Description {
        name: "Tabulated",
        stem: "tabulated",
        caption: "table",
        equation: "Any profile, as a table by surface albedo and radius",
        notes: "The path is relative to the file that names it.",
        source: "a table of your own",
        notation: Notation::Table,
        example: "Tabulated(file: \"my_table.csv\")",
        lengths: &[Self::LENGTH],
        variable: Variable::SURFACE_ALBEDO,
    };

    const PUBLISHED: &'static [Published<Self>] = &[];

    fn boxed_profile(&self, medium: Medium, _channel: Channel) -> Result<Box<dyn RadialProfile>, ModelError> {
        Ok(Box::new(self.profile(medium)?))
    }

    fn energy(&self, surface_albedo: f64) -> Option<Result<f64, ModelError>> {
        Some(Ok(self.energy_before_normalization(surface_albedo)))
    }

    fn contents(&self) -> Contents<'_> {
        Contents::Table(self)
    }
}

/// Radii differ by more than this: the reciprocal of their distance is a density.
const LEAST: f64 = 1e-100;

/// What a table must fulfil to be a whole profile.
fn check_table(table: &RadialData) -> Result<(), TabulatedError> {
    let surface_albedo = table.surface_albedo();
    let mut last = 0.0;
    for (row, RadialRow { r_lo, r_hi, .. }) in table.rows().iter().copied().enumerate() {
        if !table.is_points() && r_lo - last > CLOSEST * r_lo {
            return Err(TabulatedError::Gap { surface_albedo, row, from: last, to: r_lo });
        }
        let from = if table.is_points() { last } else { r_lo };
        // Twice the tolerance, so that two radii of one table are never taken for one of another's.
        let is_first_point = table.is_points() && row == 0 && r_hi == 0.0;
        if !is_first_point && r_hi - from <= (2.0 * CLOSEST * r_hi).max(LEAST) {
            return Err(TabulatedError::TooClose { surface_albedo, row, from, to: r_hi });
        }
        last = r_hi;
    }
    Ok(())
}

/// Outer radii of a table's bins, or its points: its knots but for the first, which is 0.
fn knots_of(table: &RadialData) -> impl Iterator<Item = f64> + '_ {
    table.rows().iter().map(|row| row.r_hi).filter(|r| *r > 0.0)
}

/// The radii of all tables, those that mean the same taken once.
fn common_radii(data: &[&RadialData]) -> Vec<f64> {
    let mut all: Vec<f64> = data.iter().flat_map(|table| knots_of(table)).collect();
    all.sort_by(f64::total_cmp);
    let mut radii = vec![0.0];
    for radius in all {
        let last = radii[radii.len() - 1];
        if radius - last > CLOSEST * radius {
            radii.push(radius);
        }
    }
    radii
}

/// Position of the common radius that stands for `radius`.
fn position(radii: &[f64], radius: f64) -> usize {
    radii.partition_point(|known| *known <= radius).saturating_sub(1)
}

impl Curve {
    /// The table on the common radii. Where other tables have a radius that it has not, its cubic is split there,
    /// which leaves it the same.
    fn new(table: &RadialData, radii: &[f64]) -> Curve {
        let own: Vec<usize> =
            std::iter::once(0).chain(knots_of(table).map(|radius| position(radii, radius))).collect();
        let widths: Vec<f64> = own.windows(2).map(|ends| radii[ends[1]] - radii[ends[0]]).collect();
        // In units of 2π and of the largest, so that no sum or ratio leaves the range of numbers.
        let values = values_of(table);
        let peak = values.iter().copied().fold(0.0, f64::max);
        let values: Vec<f64> = values.into_iter().map(|value| value / peak).collect();
        let masses: Vec<f64> = if table.is_points() {
            values
                .windows(2)
                .zip(&widths)
                .map(|(ends, width)| (0.5 * ends[0] + 0.5 * ends[1]) * width)
                .collect()
        } else {
            values.iter().zip(table.rows()).map(|(value, row)| value * (row.r_hi - row.r_lo)).collect()
        };
        let total: f64 = masses.iter().sum();
        let masses: Vec<f64> = masses.iter().map(|mass| mass / total).collect();
        let densities = if table.is_points() {
            // With the trapezoidal masses the cubic of a piece is the parabola of a linear density; but for the last
            // piece, at whose end the density is 0.
            let inner = &values[..values.len() - 1];
            inner.iter().map(|value| value / total).chain([0.0]).collect()
        } else {
            let bins: Vec<f64> = masses.iter().zip(&widths).map(|(mass, width)| mass / width).collect();
            knot_densities(&widths, &bins)
        };
        let mut curve = Curve {
            surface_albedo: table.surface_albedo(),
            // Finite, for it is mixed with others.
            energy: (2.0 * PI * total * peak / table.surface_albedo()).min(f64::MAX),
            densities: Vec::with_capacity(radii.len()),
            masses: Vec::with_capacity(radii.len()),
        };
        for (index, ends) in own.windows(2).enumerate() {
            let piece = Piece {
                width: widths[index],
                mass: masses[index],
                density: [densities[index], densities[index + 1]],
            };
            curve.split(&piece, &radii[ends[0]..=ends[1]]);
        }
        // The end, and the radii of longer tables.
        curve.densities.resize(radii.len(), 0.0);
        curve.masses.resize(radii.len(), 0.0);
        curve
    }

    /// Adds a piece, cut at the radii within it.
    fn split(&mut self, piece: &Piece, radii: &[f64]) {
        if let [_, _] = radii {
            self.densities.push(piece.density[0]);
            self.masses.push(piece.mass);
            return;
        }
        let at = |radius: f64| (radius - radii[0]) / piece.width;
        for ends in radii.windows(2) {
            self.densities.push(piece.density_at(at(ends[0])));
            let mass = piece.mass_below(at(ends[1])) - piece.mass_below(at(ends[0]));
            self.masses.push(mass.max(0.0));
        }
    }
}

/// r·R at the knots of a table of points: constant before the first.
fn values_of(table: &RadialData) -> Vec<f64> {
    let rows = table.rows();
    let before = Some(rows[0]).filter(|first| table.is_points() && first.r_lo > 0.0);
    before.iter().chain(rows).map(|row| row.r_reflectance).collect()
}
