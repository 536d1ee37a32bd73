//! Sums of packet weights that do not depend on their order.

use crate::Estimate;

use super::grid::Grid;

/// Weights are whole multiples of this: 2⁻⁴⁸.
const UNIT: f64 = 1.0 / (1_u64 << 48) as f64;

/// The multiple of [`UNIT`] nearest to `weight`, for weights from 0 to 15.
///
/// Adding 16 leaves no room for more than 48 binary places, so the hardware rounds there.
pub(super) fn quantize(weight: f64) -> f64 {
    (weight + 16.0) - 16.0
}

/// A quantized weight in units. 128 bits hold 2⁶⁴ packets with room to spare.
fn units(weight: f64) -> u128 {
    // By way of 64 bits, which hold 15 and for which the processor has an instruction.
    u128::from((weight / UNIT) as u64)
}

/// First and second moment of a packet's contribution.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Moments {
    sum: u128,
    sum_of_squares: u128,
}

impl Moments {
    pub(super) fn add(&mut self, contribution: f64) {
        self.sum += units(contribution);
        self.sum_of_squares += units(quantize(contribution * contribution));
    }

    fn merge(&mut self, other: &Self) {
        self.sum += other.sum;
        self.sum_of_squares += other.sum_of_squares;
    }

    /// Mean over `photons` packets, times `scale`, with the standard error of the mean.
    pub(super) fn estimate(&self, photons: u64, scale: f64) -> Estimate {
        let count = photons as f64;
        let mean = self.sum as f64 * UNIT / count;
        let variance = (self.sum_of_squares as f64 * UNIT / count - mean * mean).max(0.0);
        // One packet says nothing of its spread.
        let error = if photons > 1 { (variance / (count - 1.0)).sqrt() } else { f64::INFINITY };
        Estimate { mean: mean * scale, standard_error: error * scale }
    }
}

/// Where weight goes on one side of the stack.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Exits {
    pub(super) total: Moments,
    pub(super) by_radius: Vec<Moments>,
    pub(super) by_angle: Vec<Moments>,
}

impl Exits {
    fn new(grid: &Grid) -> Self {
        Self {
            total: Moments::default(),
            by_radius: vec![Moments::default(); grid.radius_cells()],
            by_angle: vec![Moments::default(); grid.angle_cells()],
        }
    }

    /// A packet leaves at `radius` cm with `cosine` in (0, 1] to the normal.
    pub(super) fn add(&mut self, grid: &Grid, radius: f64, cosine: f64, weight: f64) {
        self.total.add(weight);
        cell(&mut self.by_radius, radius / grid.radius_step()).add(weight);
        cell(&mut self.by_angle, libm::acos(cosine.min(1.0)) / grid.angle_step()).add(weight);
    }

    fn merge(&mut self, other: &Self) {
        self.total.merge(&other.total);
        merge_all(&mut self.by_radius, &other.by_radius);
        merge_all(&mut self.by_angle, &other.by_angle);
    }
}

/// All that is known of the packets traced so far. Its size does not depend on their number.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tally {
    pub(super) photons: u64,
    pub(super) reflected: Exits,
    pub(super) transmitted: Exits,
    pub(super) absorbed: Moments,
    pub(super) absorbed_by_layer: Vec<Moments>,
    absorbed_by_depth: Vec<u128>,
    /// Cells per cm of depth: a division fewer per event.
    cells_per_depth: f64,
    /// What the present packet left in each layer, until [`Self::finish_packet`].
    packet: Vec<f64>,
    /// Units taken from packets that died in the roulette less those given to survivors.
    roulette: i128,
}

impl Tally {
    pub(super) fn new(grid: &Grid, layers: usize) -> Self {
        Self {
            photons: 0,
            reflected: Exits::new(grid),
            transmitted: Exits::new(grid),
            absorbed: Moments::default(),
            absorbed_by_layer: vec![Moments::default(); layers],
            absorbed_by_depth: vec![0; grid.depth_cells()],
            cells_per_depth: 1.0 / grid.depth_step(),
            packet: vec![0.0; layers],
            roulette: 0,
        }
    }

    /// The present packet leaves `weight` in `layer` at `depth` cm below the surface of the stack.
    pub(super) fn absorb(&mut self, layer: usize, depth: f64, weight: f64) {
        self.packet[layer] += weight;
        *cell(&mut self.absorbed_by_depth, depth * self.cells_per_depth) += units(weight);
    }

    /// The roulette takes `weight` from the present packet, or gives it where negative.
    pub(super) fn gamble(&mut self, weight: f64) {
        self.roulette += i128::from((weight / UNIT) as i64);
    }

    /// The present packet has left, or is used up.
    pub(super) fn finish_packet(&mut self) {
        self.photons += 1;
        let mut sum = 0.0;
        for (left, moments) in self.packet.iter_mut().zip(&mut self.absorbed_by_layer) {
            if *left > 0.0 {
                moments.add(*left);
                sum += *left;
                *left = 0.0;
            }
        }
        self.absorbed.add(sum);
    }

    pub(super) fn merge(&mut self, other: &Self) {
        self.photons += other.photons;
        self.reflected.merge(&other.reflected);
        self.transmitted.merge(&other.transmitted);
        self.absorbed.merge(&other.absorbed);
        merge_all(&mut self.absorbed_by_layer, &other.absorbed_by_layer);
        for (sum, more) in self.absorbed_by_depth.iter_mut().zip(&other.absorbed_by_depth) {
            *sum += more;
        }
        self.roulette += other.roulette;
    }

    /// Absorbed energy per cm of depth.
    pub(super) fn absorbed_by_depth(&self, grid: &Grid) -> Vec<f64> {
        let scale = UNIT / (self.photons as f64 * grid.depth_step());
        self.absorbed_by_depth.iter().map(|&sum| sum as f64 * scale).collect()
    }

    /// Fraction of the energy that the roulette took, or gave where negative; 0 on average.
    pub(super) fn roulette(&self) -> f64 {
        self.roulette as f64 * UNIT / self.photons as f64
    }
}

/// The cell in which `position`, in cells, falls; the last one where it falls beyond.
fn cell<T>(cells: &mut [T], position: f64) -> &mut T {
    let last = cells.len() - 1;
    &mut cells[(position as usize).min(last)]
}

fn merge_all(sums: &mut [Moments], more: &[Moments]) {
    for (sum, more) in sums.iter_mut().zip(more) {
        sum.merge(more);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantized_weights_are_whole_units() {
        for weight in [0.0, 1e-30, 1e-4, 0.1, 1.0 / 3.0, 0.972, 1.0, 3.7] {
            let quantized = quantize(weight);
            assert_eq!(quantized, units(quantized) as f64 * UNIT);
            assert!((quantized - weight).abs() <= UNIT / 2.0);
        }
    }

    #[test]
    fn moments_of_a_coin() {
        let mut moments = Moments::default();
        for toss in 0..100 {
            moments.add(f64::from(toss % 2));
        }
        let estimate = moments.estimate(100, 2.0);
        assert_eq!(estimate.mean, 1.0);
        // Twice √(p(1 − p)/(n − 1)).
        assert!((estimate.standard_error - 2.0 * (0.25_f64 / 99.0).sqrt()).abs() < 1e-15);
    }
}
