//! Random walks, many at a time.
//!
//! [`LANES`] photons are in flight. A step scatters each of them once and moves it to its next event; the loop over lanes
//! has no branch, so it compiles to vector instructions. Then the few lanes that left the medium, or have been followed
//! far enough, are looked at one by one and given the next photon.
//!
//! Positions are `f32`. A step of about one mean free path is rounded by 2⁻²⁵ of the coordinate: 10⁻⁵ at a distance of
//! 300, where rings are 25 wide, and the errors of 10⁴ steps add up like a random walk, to 10⁻³. Near the surface, where
//! it is decided who leaves, the depth is small and so is its rounding. What is counted are integers.

use crate::elementary::{circle, negative_ln, signed_unit, unit};
use crate::fresnel;
use crate::histogram::Histogram;
use crate::radial_grid::RingFinder;
use crate::random::{Random, State, States, advance};
use crate::scattering_count::ScatteringCounts;
use crate::{Entry, HalfSpace};

/// Photons in flight. Enough to fill the vectors of any machine, few enough to stay in the first-level cache (4 KiB).
const LANES: usize = 64;

/// Photons of a batch, which is the unit of work, of storage and of the random numbers.
pub(crate) const BATCH: u64 = 1 << 16;

/// The first photons of each batch are followed up to [`ScatteringCounts::long`], the others to `short`.
pub(crate) const FOLLOWED: u64 = BATCH / 8;

/// What all batches of a half-space share.
pub(crate) struct Walk {
    half_space: HalfSpace,
    counts: ScatteringCounts,
    finder: RingFinder,
}

/// One value per photon in flight.
#[repr(align(64))]
struct Lanes {
    random: [[u32; LANES]; 4],
    position: [[f32; LANES]; 3],
    direction: [[f32; LANES]; 3],
    /// Scatterings until the photon is given up.
    remaining: [u32; LANES],
    /// What `remaining` was at the start.
    limit: [u32; LANES],
    /// 1 where a lane left the medium or used up its scatterings in this step.
    done: [u8; LANES],
}

/// Depth of a lane without a photon: no number of steps brings it back.
const PARKED: f32 = 1e30;

impl Lanes {
    fn new(states: &mut States) -> Lanes {
        let mut random = [[0; LANES]; 4];
        for lane in 0..LANES {
            let state: State = states.next_state();
            for (words, word) in random.iter_mut().zip(state) {
                words[lane] = word;
            }
        }
        Lanes {
            random,
            position: [[0.0; LANES]; 3],
            direction: [[0.0; LANES]; 3],
            remaining: [u32::MAX / 2; LANES],
            limit: [u32::MAX / 2; LANES],
            done: [0; LANES],
        }
    }

    #[inline(always)]
    fn draw(&mut self, lane: usize) -> u32 {
        let state = [self.random[0][lane], self.random[1][lane], self.random[2][lane], self.random[3][lane]];
        let (state, bits) = advance(state);
        self.random[0][lane] = state[0];
        self.random[1][lane] = state[1];
        self.random[2][lane] = state[2];
        self.random[3][lane] = state[3];
        bits
    }

    /// Scatters every photon and moves it along its next free path, out of the medium if it leads there.
    #[inline(always)]
    fn step<const ISOTROPIC: bool>(&mut self, anisotropy: f32) {
        for lane in 0..LANES {
            let path = negative_ln(unit(self.draw(lane)));
            let scattered = signed_unit(self.draw(lane));
            let (cosine_azimuth, sine_azimuth) = circle(self.draw(lane));
            let direction = if ISOTROPIC {
                let sine = ((1.0 - scattered) * (1.0 + scattered)).sqrt();
                [sine * cosine_azimuth, sine * sine_azimuth, scattered]
            } else {
                let incident = [self.direction[0][lane], self.direction[1][lane], self.direction[2][lane]];
                let cosine = henyey_greenstein(scattered, anisotropy);
                turn(incident, cosine, cosine_azimuth, sine_azimuth)
            };
            for (axis, component) in direction.into_iter().enumerate() {
                self.direction[axis][lane] = component;
                self.position[axis][lane] += path * component;
            }
            // Wrapping, or the check against overflow would keep the loop from being a vector loop.
            self.remaining[lane] = self.remaining[lane].wrapping_sub(1);
            // A sign bit: of the depth, or of the 0 minus 1.
            let done = self.position[2][lane].to_bits() | self.remaining[lane].wrapping_sub(1);
            self.done[lane] = (done >> 31) as u8;
        }
    }
}

/// Cosine of the scattering angle for ξ uniform in (-1, 1) (Henyey and Greenstein 1941, inverted).
///
/// The usual form ((1 + g²) - ((1 - g²)/(1 + gξ))²)/2g, multiplied out: the division by g cancels, so that no digits
/// are lost for a small g.
#[inline(always)]
fn henyey_greenstein(xi: f32, g: f32) -> f32 {
    let squares = 1.0 + g * g;
    let t = 1.0 + g * xi;
    let cosine = (xi * squares + 0.5 * g * (3.0 - g * g + squares * xi * xi)) / (t * t);
    cosine.clamp(-1.0, 1.0)
}

/// `incident` turned by an angle with `cosine`, around an axis chosen by the azimuth.
///
/// The frame is Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1), which has no branch.
#[inline(always)]
fn turn(incident: [f32; 3], cosine: f32, cosine_azimuth: f32, sine_azimuth: f32) -> [f32; 3] {
    let [x, y, z] = incident;
    let sign = 1.0_f32.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    let (u, v) = (sine * cosine_azimuth, sine * sine_azimuth);
    let turned = [
        u * (1.0 + sign * x * x * a) + v * b + cosine * x,
        u * sign * b + v * (sign + y * y * a) + cosine * y,
        cosine * z - u * sign * x - v * y,
    ];
    // One step of Newton's method for 1/√: lengths stay 1 to the last place over any number of turns.
    let squared = turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2];
    let scale = 1.5 - 0.5 * squared;
    turned.map(|component| component * scale)
}

impl Walk {
    pub(crate) fn new(half_space: HalfSpace) -> Walk {
        Walk { half_space, counts: ScatteringCounts::of(&half_space), finder: RingFinder::new() }
    }

    /// Adds the photons of one batch to `histogram`.
    pub(crate) fn run_batch(&self, seed: u64, batch: u64, histogram: &mut Histogram) {
        if self.half_space.anisotropy() == 0.0 {
            isotropic_batch(self, seed, batch, histogram);
        } else {
            anisotropic_batch(self, seed, batch, histogram);
        }
    }

    #[inline(always)]
    fn batch<const ISOTROPIC: bool>(&self, seed: u64, batch: u64, histogram: &mut Histogram) {
        let mut states = States::new(seed, batch);
        let mut random = Random::new(states.next_state());
        let mut lanes = Lanes::new(&mut states);
        let mut begun = 0;
        let mut in_flight = 0;
        for lane in 0..LANES {
            in_flight += usize::from(self.refill(&mut lanes, lane, &mut begun, &mut random));
        }
        let anisotropy = self.half_space.anisotropy() as f32;
        while in_flight > 0 {
            lanes.step::<ISOTROPIC>(anisotropy);
            for block in 0..LANES / 8 {
                let mut flags = [0; 8];
                flags.copy_from_slice(&lanes.done[8 * block..8 * block + 8]);
                let mut flags = u64::from_le_bytes(flags);
                while flags != 0 {
                    let lane = 8 * block + flags.trailing_zeros() as usize / 8;
                    flags &= flags - 1;
                    if self.finish(&mut lanes, lane, &mut random, histogram)
                        && !self.refill(&mut lanes, lane, &mut begun, &mut random)
                    {
                        in_flight -= 1;
                    }
                }
            }
        }
    }

    /// Puts the next photon of the batch into a lane, at the place of its first event. False when there is none.
    #[inline(always)]
    fn refill(&self, lanes: &mut Lanes, lane: usize, begun: &mut u64, random: &mut Random) -> bool {
        if *begun == BATCH {
            lanes.position[2][lane] = PARKED;
            lanes.remaining[lane] = u32::MAX / 2;
            return false;
        }
        let limit = if *begun < FOLLOWED { self.counts.long() } else { self.counts.short() };
        *begun += 1;
        let direction = match self.half_space.entry() {
            Entry::Searchlight => [0.0, 0.0, 1.0],
            Entry::Diffuse => {
                let cosine = self.diffuse_entry(random);
                let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
                let (x, y) = circle(random.bits());
                [sine * x, sine * y, cosine]
            }
        };
        let path = negative_ln(random.uniform());
        for (axis, component) in direction.into_iter().enumerate() {
            lanes.direction[axis][lane] = component;
            lanes.position[axis][lane] = path * component;
        }
        lanes.limit[lane] = limit;
        lanes.remaining[lane] = limit;
        true
    }

    /// Cosine inside of a direction whose cosine outside has the density 2μ, given that it was not reflected.
    #[inline(always)]
    fn diffuse_entry(&self, random: &mut Random) -> f32 {
        if self.half_space.is_matched() {
            return random.uniform().sqrt();
        }
        let refractive_index = self.half_space.refractive_index();
        loop {
            let outside = f64::from(random.uniform()).sqrt();
            let inside = fresnel::refracted_cosine(outside, refractive_index);
            if f64::from(random.uniform()) >= fresnel::reflectance(inside, refractive_index) {
                return inside as f32;
            }
        }
    }

    /// Looks at a lane that is done. False if the boundary sent its photon back in.
    #[inline(always)]
    fn finish(&self, lanes: &mut Lanes, lane: usize, random: &mut Random, histogram: &mut Histogram) -> bool {
        let scatterings = lanes.limit[lane] - lanes.remaining[lane];
        let depth = lanes.position[2][lane];
        if depth >= 0.0 {
            return self.give_up(lanes, lane, histogram);
        }
        let vertical = lanes.direction[2][lane];
        if !self.half_space.is_matched() {
            let reflectance = fresnel::reflectance(f64::from(-vertical), self.half_space.refractive_index());
            if f64::from(random.uniform()) < reflectance {
                // The rest of the path, mirrored.
                lanes.position[2][lane] = -depth;
                lanes.direction[2][lane] = -vertical;
                return lanes.remaining[lane] == 0 && self.give_up(lanes, lane, histogram);
            }
        }
        // Both are negative: how far it went beyond the surface.
        let beyond = depth / vertical;
        let x = lanes.position[0][lane] - beyond * lanes.direction[0][lane];
        let y = lanes.position[1][lane] - beyond * lanes.direction[1][lane];
        let ring = self.finder.ring((x * x + y * y).sqrt());
        histogram.record(self.counts.row(scatterings), ring, scatterings);
        true
    }

    #[inline(always)]
    fn give_up(&self, lanes: &Lanes, lane: usize, histogram: &mut Histogram) -> bool {
        let limit = lanes.limit[lane];
        histogram.give_up(limit == self.counts.long(), limit);
        true
    }
}

/// The vectors are as wide as the machine allows. No fused multiply-add among the features: it rounds once where others
/// round twice, and the bytes of a run would depend on the machine.
#[multiversion::multiversion(targets("x86_64+sse+sse2+sse3+ssse3+sse4.1+sse4.2+popcnt+avx+avx2"))]
fn isotropic_batch(walk: &Walk, seed: u64, batch: u64, histogram: &mut Histogram) {
    walk.batch::<true>(seed, batch, histogram);
}

#[multiversion::multiversion(targets("x86_64+sse+sse2+sse3+ssse3+sse4.1+sse4.2+popcnt+avx+avx2"))]
fn anisotropic_batch(walk: &Walk, seed: u64, batch: u64, histogram: &mut Histogram) {
    walk.batch::<false>(seed, batch, histogram);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wider_vectors_change_no_count() {
        for (anisotropy, refractive_index) in [(0.0, 1.0), (0.3, 1.4)] {
            let half_space =
                HalfSpace::new(Entry::Diffuse, anisotropy, refractive_index).expect("a medium that can be");
            let walk = Walk::new(half_space);
            let [mut dispatched, mut plain] = [(); 2].map(|()| Histogram::new(walk.counts.rows()));
            walk.run_batch(1, 2, &mut dispatched);
            // Compiled for the target as it is, on x86-64 with SSE2 alone.
            if anisotropy == 0.0 {
                walk.batch::<true>(1, 2, &mut plain);
            } else {
                walk.batch::<false>(1, 2, &mut plain);
            }
            assert_eq!(dispatched, plain);
        }
    }

    #[test]
    fn henyey_greenstein_has_its_mean_cosine() {
        for g in [-0.9, -0.2, 0.0, 1e-6, 0.5, 0.95_f32] {
            let count = 100_000;
            let cosines = (0..count).map(|index| {
                let xi = (index as f32 + 0.5) / count as f32 * 2.0 - 1.0;
                f64::from(henyey_greenstein(xi, g))
            });
            let mean = cosines.sum::<f64>() / f64::from(count);
            // The midpoint rule, and f32 in 1 - g near ξ = ±1.
            assert!((mean - f64::from(g)).abs() < 1e-5, "{g}: {mean}");
        }
    }

    #[test]
    fn turns_keep_the_length_and_the_angle() {
        let mut direction = [0.0, 0.0, 1.0];
        for step in 0..10_000_u32 {
            let bits = step.wrapping_mul(0x9e37_79b1);
            let (x, y) = circle(bits);
            let cosine = signed_unit(bits.rotate_left(13));
            let turned = turn(direction, cosine, x, y);
            let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            // A few units in the last place of f32.
            assert!(
                (dot(turned, turned) - 1.0).abs() < 1e-6 && (dot(turned, direction) - cosine).abs() < 2e-6
            );
            direction = turned;
        }
    }
}
