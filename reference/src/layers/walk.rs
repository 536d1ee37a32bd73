//! The walk of one packet through a stack.

use rand_xoshiro::rand_core::Rng;

use super::grid::Grid;
use super::interface::{clear_reflectance, fresnel};
use super::layer::LayerStack;
use super::tally::{Tally, quantize};

/// Below this weight a packet plays roulette, and survives with [`SURVIVAL`] (\[WJZ95\]).
const ROULETTE_BELOW: f64 = 1e-4;
const SURVIVAL: f64 = 0.1;

/// A stack as the walk needs it.
#[derive(Debug, Clone)]
pub(super) struct Walk {
    slabs: Vec<Slab>,
    above: f64,
    below: f64,
    /// Layer in which packets begin: the first one that is not clear, or the half-space below.
    first: usize,
    /// Weight of a packet that has entered; what is missing from 1 was reflected specularly.
    weight: f64,
    grid: Grid,
}

#[derive(Debug, Clone)]
struct Slab {
    refractive_index: f64,
    extinction: f64,
    /// 1/extinction, infinite in a clear layer.
    mean_free_path: f64,
    absorbed_fraction: f64,
    anisotropy: f64,
    thickness: f64,
    top: f64,
}

/// Where a packet is and where it goes: `depth` counts from the top of its layer, so that a thin layer below a thick one
/// keeps its digits.
struct Packet {
    layer: usize,
    x: f64,
    y: f64,
    depth: f64,
    direction: [f64; 3],
    weight: f64,
    /// Optical length that remains until the next event; 0 asks for a new one.
    optical: f64,
}

/// The half-space into which a packet goes.
enum Side {
    Above,
    Below,
}

impl Walk {
    pub(super) fn new(stack: &LayerStack, grid: &Grid) -> Self {
        let layers = stack.layers();
        let mut top = 0.0;
        let mut slabs = Vec::with_capacity(layers.len());
        for layer in layers {
            let extinction = layer.extinction_coefficient();
            slabs.push(Slab {
                refractive_index: layer.refractive_index(),
                extinction,
                mean_free_path: 1.0 / extinction,
                absorbed_fraction: if layer.is_clear() {
                    0.0
                } else {
                    layer.absorption_coefficient() / extinction
                },
                anisotropy: layer.anisotropy(),
                thickness: layer.thickness(),
                top,
            });
            top += layer.thickness();
        }
        let first = layers.iter().take_while(|layer| layer.is_clear()).count();
        let (above, below) = (stack.refractive_index_above(), stack.refractive_index_below());
        let mut passed = vec![above];
        passed.extend(slabs.iter().take(first + 1).map(|slab| slab.refractive_index));
        if first == slabs.len() {
            passed.push(below);
        }
        let weight = quantize(1.0 - clear_reflectance(&passed));
        Self { slabs, above, below, first, weight, grid: *grid }
    }

    /// Fraction of the beam that the surface, and clear layers on top, reflect.
    pub(super) fn specular_reflectance(&self) -> f64 {
        1.0 - self.weight
    }

    /// Traces one packet from its entry to its end.
    pub(super) fn trace(&self, rng: &mut impl Rng, tally: &mut Tally) {
        let mut packet = Packet {
            layer: self.first,
            x: 0.0,
            y: 0.0,
            depth: 0.0,
            direction: [0.0, 0.0, 1.0],
            weight: self.weight,
            optical: 0.0,
        };
        if self.first == self.slabs.len() {
            tally.transmitted.add(&self.grid, 0.0, 1.0, packet.weight);
        } else {
            while let Some(exit) = self.step(&mut packet, rng, tally) {
                if let Some(side) = exit {
                    let radius = (packet.x * packet.x + packet.y * packet.y).sqrt();
                    let exits = match side {
                        Side::Above => &mut tally.reflected,
                        Side::Below => &mut tally.transmitted,
                    };
                    exits.add(&self.grid, radius, packet.direction[2].abs(), packet.weight);
                    break;
                }
            }
        }
        tally.finish_packet();
    }

    /// Moves the packet to the next event or interface. `None`: the packet is used up; `Some(Some(side))`: it has left.
    fn step(&self, packet: &mut Packet, rng: &mut impl Rng, tally: &mut Tally) -> Option<Option<Side>> {
        let slab = &self.slabs[packet.layer];
        let down = packet.direction[2];
        let to_interface = if down > 0.0 {
            (slab.thickness - packet.depth) / down
        } else if down < 0.0 {
            packet.depth / -down
        } else {
            f64::INFINITY
        };
        if slab.extinction > 0.0 {
            if packet.optical <= 0.0 {
                // 1 − u is never 0, so the length is finite.
                packet.optical = -libm::log(1.0 - uniform(rng));
            }
            let to_event = packet.optical * slab.mean_free_path;
            if to_event <= to_interface {
                packet.advance(to_event);
                packet.optical = 0.0;
                return self.interact(packet, rng, tally).then_some(None);
            }
            packet.optical -= to_interface * slab.extinction;
        }
        packet.advance(to_interface);
        Some(self.cross(packet, rng))
    }

    /// Absorption, roulette and a new direction. Returns whether the packet lives on.
    fn interact(&self, packet: &mut Packet, rng: &mut impl Rng, tally: &mut Tally) -> bool {
        let slab = &self.slabs[packet.layer];
        let absorbed = quantize(packet.weight * slab.absorbed_fraction);
        if absorbed > 0.0 {
            tally.absorb(packet.layer, slab.top + packet.depth, absorbed);
            packet.weight -= absorbed;
            if packet.weight <= 0.0 {
                return false;
            }
            if packet.weight < ROULETTE_BELOW {
                if uniform(rng) >= SURVIVAL {
                    tally.gamble(packet.weight);
                    return false;
                }
                // An integer factor keeps the weight a whole number of units.
                tally.gamble(-9.0 * packet.weight);
                packet.weight *= 10.0;
            }
        }
        packet.turn(henyey_greenstein_cosine(slab.anisotropy, uniform(rng)), rng);
        true
    }

    /// Reflects the packet at the interface that it has reached, or lets it pass. Returns the half-space it enters.
    fn cross(&self, packet: &mut Packet, rng: &mut impl Rng) -> Option<Side> {
        let here = &self.slabs[packet.layer];
        let down = packet.direction[2] > 0.0;
        let next = if down { packet.layer.checked_add(1) } else { packet.layer.checked_sub(1) };
        let beyond = next.and_then(|index| self.slabs.get(index));
        let outside = if down { self.below } else { self.above };
        let to = beyond.map_or(outside, |slab| slab.refractive_index);
        let interface = fresnel(here.refractive_index, to, packet.direction[2].abs().min(1.0));
        // A fair comparison for all values: u < 1 always, so total reflection is certain; matched media draw nothing.
        if interface.reflectance > 0.0 && uniform(rng) < interface.reflectance {
            packet.depth = if down { here.thickness } else { 0.0 };
            packet.direction[2] = -packet.direction[2];
            return None;
        }
        let ratio = here.refractive_index / to;
        packet.direction[0] *= ratio;
        packet.direction[1] *= ratio;
        packet.direction[2] = interface.refracted_cosine.copysign(packet.direction[2]);
        match (beyond, next) {
            (Some(slab), Some(next)) => {
                packet.layer = next;
                packet.depth = if down { 0.0 } else { slab.thickness };
                None
            }
            _ if down => Some(Side::Below),
            _ => Some(Side::Above),
        }
    }
}

impl Packet {
    fn advance(&mut self, length: f64) {
        self.x += length * self.direction[0];
        self.y += length * self.direction[1];
        self.depth += length * self.direction[2];
    }

    /// Turns by an angle of the given cosine, to a side drawn evenly.
    fn turn(&mut self, cosine: f64, rng: &mut impl Rng) {
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let (side_cosine, side_sine) = point_on_circle(rng);
        let [x, y, z] = self.direction;
        // An orthonormal basis without a singular direction: Duff et al. 2017, "Building an Orthonormal Basis,
        // Revisited".
        let sign = 1.0_f64.copysign(z);
        let a = -1.0 / (sign + z);
        let b = x * y * a;
        let (p, q) = (sine * side_cosine, sine * side_sine);
        let turned = [
            cosine * x + p * (1.0 + sign * x * x * a) + q * b,
            cosine * y + p * sign * b + q * (sign + y * y * a),
            cosine * z - p * sign * x - q * y,
        ];
        // One Newton step towards length 1 keeps rounding from growing over long walks.
        let square = turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2];
        let scale = 1.5 - 0.5 * square;
        self.direction = turned.map(|component| component * scale);
    }
}

/// A number from 0 to 1 − 2⁻⁵³, evenly.
fn uniform(rng: &mut impl Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
}

/// Cosine and sine of an angle drawn evenly, without trigonometry: a point in the unit disc has such an angle, and so
/// has twice that angle (von Neumann 1951).
fn point_on_circle(rng: &mut impl Rng) -> (f64, f64) {
    loop {
        let bits = rng.next_u64();
        // Halves of the bits as signed numbers; the added half centres them and excludes 0.
        let x = f64::from((bits >> 32) as u32 as i32) + 0.5;
        let y = f64::from(bits as u32 as i32) + 0.5;
        let (xx, yy) = (x * x, y * y);
        let square = xx + yy;
        if square <= (1_u64 << 62) as f64 {
            return ((xx - yy) / square, 2.0 * x * y / square);
        }
    }
}

/// Cosine of the scattering angle of Henyey and Greenstein 1941, from u in [0, 1).
///
/// The usual inverse, (1 + g² − ((1 − g²)/(1 + gs))²)/2g with s = 2u − 1, is 0/0 at g = 0 and loses digits near it.
/// Multiplied out, the division by 2g goes.
fn henyey_greenstein_cosine(anisotropy: f64, u: f64) -> f64 {
    let (g, s) = (anisotropy, 2.0 * u - 1.0);
    if g == 0.0 {
        return s;
    }
    if g.abs() == 1.0 {
        return g;
    }
    let square = s * s;
    let root = 1.0 + g * s;
    let cosine = (s + g * (0.5 * (square + 3.0) + g * (s + g * 0.5 * (square - 1.0)))) / (root * root);
    cosine.clamp(-1.0, 1.0)
}

#[cfg(test)]
mod tests {
    use rand_xoshiro::Xoshiro256PlusPlus;
    use rand_xoshiro::rand_core::SeedableRng;

    use super::super::layer::Layer;
    use super::*;

    #[test]
    fn refraction_follows_snell() {
        let layers = [1.2, 1.5].map(|index| Layer::new(index, 1.0, 1.0, 0.0, 0.1).expect("values in range"));
        let stack = LayerStack::new(1.0, layers.to_vec(), 1.0).expect("a short walk");
        let walk = Walk::new(&stack, &Grid::new(0.1, 0.1, 1, 1, 1).expect("a small grid"));
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(1);
        for step in 1..100 {
            let cosine = f64::from(step) / 100.0;
            let sine = (1.0 - cosine * cosine).sqrt();
            let direction = [0.6 * sine, 0.8 * sine, cosine];
            let mut packet =
                Packet { layer: 0, x: 0.0, y: 0.0, depth: 0.1, direction, weight: 1.0, optical: 0.0 };
            assert!(walk.cross(&mut packet, &mut rng).is_none());
            let [x, y, z] = packet.direction;
            if packet.layer == 0 {
                assert_eq!(packet.direction, [direction[0], direction[1], -cosine]);
                continue;
            }
            // n sin θ stays, along x and y alike; the direction keeps its length; 1e-14 is rounding.
            assert!(
                (1.5 * x - 1.2 * direction[0]).abs() < 1e-14 && (1.5 * y - 1.2 * direction[1]).abs() < 1e-14
            );
            assert!((x * x + y * y + z * z - 1.0).abs() < 1e-14);
            assert_eq!((packet.depth, z > 0.0), (0.0, true));
        }
    }

    #[test]
    fn turns_have_the_angle_asked_for() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(2);
        let mut packet = Packet {
            layer: 0,
            x: 0.0,
            y: 0.0,
            depth: 0.0,
            direction: [0.0, 0.0, -1.0],
            weight: 1.0,
            optical: 0.0,
        };
        for turn in 0..100_000 {
            let before = packet.direction;
            let cosine = henyey_greenstein_cosine(0.9, uniform(&mut rng));
            packet.turn(cosine, &mut rng);
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            // Rounding, which the Newton step keeps from growing over the whole walk.
            assert!((dot(before, packet.direction) - cosine).abs() < 1e-14, "turn {turn}");
            assert!((dot(packet.direction, packet.direction) - 1.0).abs() < 1e-14, "turn {turn}");
        }
    }

    #[test]
    fn henyey_greenstein_inverts_its_distribution() {
        for g in [-0.99, -0.5, -1e-9, 0.0, 1e-12, 0.3, 0.9, 0.99] {
            for step in 0..1000 {
                let u = f64::from(step) / 1000.0;
                let cosine = henyey_greenstein_cosine(g, u);
                // P(cos θ < c) of isotropic scattering plus its first order in g; the exact one is 0/0 here.
                let cdf = if g.abs() < 1e-6 {
                    0.5 * (1.0 + cosine) + 0.75 * g * (cosine * cosine - 1.0)
                } else {
                    (1.0 - g * g) / (2.0 * g)
                        * (1.0 / (1.0 + g * g - 2.0 * g * cosine).sqrt() - 1.0 / (1.0 + g))
                };
                // Rounding, magnified at most by 1/(1 − |g|)³ = 10⁶ in this list.
                assert!((cdf - u).abs() < 1e-9, "g {g}, u {u}: {cdf}");
            }
        }
    }

    #[test]
    fn ends_of_the_range_of_anisotropy() {
        for u in [0.0, 0.5, 1.0 - f64::EPSILON / 2.0] {
            assert_eq!(henyey_greenstein_cosine(1.0, u), 1.0);
            assert_eq!(henyey_greenstein_cosine(-1.0, u), -1.0);
            for g in [-1.0 + f64::EPSILON, 1.0 - f64::EPSILON / 2.0] {
                assert!((-1.0..=1.0).contains(&henyey_greenstein_cosine(g, u)));
            }
        }
    }
}
