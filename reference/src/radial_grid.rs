//! The rings into which exit points are sorted.

/// Where rings begin and end, in mean free paths: steps of 0.005 up to 0.065, then about 9 % each, rounded so that a
/// table can print them in full. What leaves beyond the last one is counted in one more ring without an end.
///
/// Within a ring only the mean is known. 0.005 is finer than any profile's structure: r·R(r) changes by 4 % from the
/// first ring to the second.
pub const RING_EDGES: [f64; 138] = [
    0.0, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.035, 0.04, 0.045, 0.05, 0.055, 0.06, 0.065, 0.075, 0.08,
    0.09, 0.095, 0.105, 0.115, 0.125, 0.14, 0.155, 0.165, 0.185, 0.2, 0.22, 0.24, 0.265, 0.29, 0.315, 0.345,
    0.38, 0.415, 0.455, 0.495, 0.545, 0.595, 0.655, 0.715, 0.785, 0.86, 0.94, 1.03, 1.125, 1.235, 1.35, 1.48,
    1.62, 1.775, 1.945, 2.12, 2.34, 2.56, 2.8, 3.06, 3.36, 3.68, 4.02, 4.4, 4.82, 5.28, 5.78, 6.34, 6.94,
    7.6, 8.32, 9.1, 9.98, 10.9, 12.0, 13.1, 14.3, 15.7, 17.2, 18.8, 20.6, 22.6, 24.7, 27.1, 29.7, 32.5, 35.6,
    39.0, 43.0, 47.0, 51.0, 56.0, 61.0, 67.0, 74.0, 81.0, 88.0, 97.0, 106.0, 116.0, 127.0, 139.0, 152.0,
    167.0, 183.0, 200.0, 219.0, 240.0, 263.0, 288.0, 315.0, 345.0, 378.0, 413.0, 453.0, 496.0, 543.0, 594.0,
    651.0, 713.0, 780.0, 854.0, 936.0, 1025.0, 1120.0, 1230.0, 1345.0, 1475.0, 1615.0, 1765.0, 1935.0,
    2115.0, 2320.0, 2540.0, 2780.0, 3040.0, 3330.0, 3650.0, 4000.0, 4380.0, 4790.0, 5250.0,
];

/// Rings, the one without an end included.
pub(crate) const RINGS: usize = RING_EDGES.len();

/// Finds the ring of a radius without a search: the leading bits of a float are its logarithm.
pub(crate) struct RingFinder {
    edges: [f32; RINGS],
    first_ring: [u8; RingFinder::KEYS],
}

impl RingFinder {
    /// 32 keys per octave, from 2⁻⁹ (below the first edge) up.
    const SHIFT: u32 = 18;
    const LOWEST: u32 = ((127 - 9) << 23) >> Self::SHIFT;
    const KEYS: usize = 23 * 32;

    pub(crate) fn new() -> RingFinder {
        let edges = RING_EDGES.map(|edge| edge as f32);
        let mut first_ring = [0; Self::KEYS];
        for (key, ring) in first_ring.iter_mut().enumerate().skip(1) {
            let smallest = f32::from_bits((key as u32 + Self::LOWEST) << Self::SHIFT);
            *ring = (edges.partition_point(|&edge| edge <= smallest) - 1) as u8;
        }
        RingFinder { edges, first_ring }
    }

    /// The ring that holds `radius`, which is not negative.
    #[inline]
    pub(crate) fn ring(&self, radius: f32) -> usize {
        let key = (radius.to_bits() >> Self::SHIFT).saturating_sub(Self::LOWEST) as usize;
        let mut ring = usize::from(self.first_ring[key.min(Self::KEYS - 1)]);
        while ring + 1 < RINGS && self.edges[ring + 1] <= radius {
            ring += 1;
        }
        ring
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_radius_has_the_ring_whose_edges_hold_it() {
        let finder = RingFinder::new();
        let mut radius = 1e-6_f32;
        while radius < 2e4 {
            let ring = finder.ring(radius);
            assert!(finder.edges[ring] <= radius, "{radius}");
            assert!(ring + 1 == RINGS || radius < finder.edges[ring + 1], "{radius}");
            radius *= 1.000_7;
        }
        assert_eq!(finder.ring(0.0), 0);
        assert_eq!(finder.ring(0.005), 1);
        assert_eq!(finder.ring(1e30), RINGS - 1);
    }
}
