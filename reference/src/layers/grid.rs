//! Cells in which results are gathered.

use super::layer::LARGEST_COUNT;
use super::layer_error::LayerError;

/// Cells of depth, radius and exit angle, as MCML has them. The last cell of each also holds what falls beyond it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    depth_step: f64,
    radius_step: f64,
    depth_cells: usize,
    radius_cells: usize,
    angle_cells: usize,
}

impl Grid {
    /// A grid in the order of MCML's input: `dz` and `dr` in cm, then the counts `nz`, `nr`, `na`.
    ///
    /// # Errors
    ///
    /// [`LayerError::CellSize`] outside [10⁻¹², 10¹²] cm, [`LayerError::CellCount`] outside 1 to 32 767.
    pub fn new(
        depth_step: f64,
        radius_step: f64,
        depth_cells: u64,
        radius_cells: u64,
        angle_cells: u64,
    ) -> Result<Self, LayerError> {
        for (axis, value) in [("dz", depth_step), ("dr", radius_step)] {
            if !(1e-12..=1e12).contains(&value) {
                return Err(LayerError::CellSize { axis, value });
            }
        }
        let count = |axis, value: u64| {
            usize::try_from(value)
                .ok()
                .filter(|count| (1..=LARGEST_COUNT).contains(count))
                .ok_or(LayerError::CellCount { axis, value })
        };
        Ok(Self {
            depth_step,
            radius_step,
            depth_cells: count("nz", depth_cells)?,
            radius_cells: count("nr", radius_cells)?,
            angle_cells: count("na", angle_cells)?,
        })
    }

    /// Height of a cell of depth, cm.
    pub fn depth_step(&self) -> f64 {
        self.depth_step
    }

    /// Width of a cell of radius, cm.
    pub fn radius_step(&self) -> f64 {
        self.radius_step
    }

    /// Number of cells of depth.
    pub fn depth_cells(&self) -> usize {
        self.depth_cells
    }

    /// Number of cells of radius.
    pub fn radius_cells(&self) -> usize {
        self.radius_cells
    }

    /// Number of cells of the exit angle between 0 and π/2.
    pub fn angle_cells(&self) -> usize {
        self.angle_cells
    }

    /// Width of a cell of the exit angle, radians.
    pub fn angle_step(&self) -> f64 {
        std::f64::consts::FRAC_PI_2 / self.angle_cells as f64
    }
}
