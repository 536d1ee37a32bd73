//! \[L23\] eq. (19)-(21): the closed form that stands for the inverse of the cdf.

use subsurface_profile::{Channel, Medium, Model, RadialProfile};
use subsurface_reference::{RadialTable, truth};

use crate::comparison::{Comparison, number};
use crate::stored::{at, share_within};

/// Strata of ξ: as fine as the third digit of a distance.
const STRATA: u32 = 20_000;

/// Strata of ξ where densities are counted: the least populated of their bins gets more than 100.
const FINE_STRATA: u32 = 200_000;

/// Eq. (19) with ε = 0.01 and eq. (20), at a mean free path of 1.
#[derive(Clone, Copy)]
struct Sampler {
    k1: f64,
    k2: f64,
}

impl Sampler {
    fn liang_2023(alpha: f64) -> Sampler {
        Sampler {
            k1: 1.504 * alpha.powf(2.175 * alpha.powf(0.7) + 0.19),
            k2: 3.993 * alpha.powf(3.268 * alpha + 0.2838),
        }
    }

    /// g(ξ), not clamped.
    fn at(self, xi: f64) -> f64 {
        (self.k1 * xi - self.k2) * xi.sqrt() * (1.01 - xi).ln()
    }

    /// g′(ξ).
    fn derivative(self, xi: f64) -> f64 {
        let (line, root, log) = (self.k1 * xi - self.k2, xi.sqrt(), (1.01 - xi).ln());
        self.k1 * root * log + line * log / (2.0 * root) - line * root / (1.01 - xi)
    }
}

/// The middles of so many strata of [0, 1].
fn strata(strata: u32) -> impl Iterator<Item = f64> {
    (0..strata).map(move |stratum| (f64::from(stratum) + 0.5) / f64::from(strata))
}

fn model(table: &RadialTable) -> Box<dyn RadialProfile> {
    let medium = Medium::new(table.surface_albedo, 1.0).unwrap();
    Model::published("liang_2023").unwrap().profile(medium, Channel::Red).unwrap()
}

/// The greatest distance of `cdf` at the samples from their ξ: that of the two distributions, since g rises.
fn distance(sampler: Sampler, end: f64, cdf: impl Fn(f64) -> f64) -> f64 {
    strata(STRATA).map(|xi| (cdf(sampler.at(xi).clamp(0.0, end)) - xi).abs()).fold(0.0, f64::max)
}

#[test]
fn equation_19_approximates_the_inverse() {
    let mut table = Comparison::new("L23 eq. (19)-(21): g as the inverse of the cdf");
    let tables = &truth::searchlight().tables;
    let distances: Vec<(f64, f64, f64)> = tables
        .iter()
        .map(|table| {
            let (sampler, model) = (Sampler::liang_2023(table.single_scattering_albedo), model(table));
            let end = model.max_radius().unwrap();
            let to_model = distance(sampler, end, |r| model.radial_cdf(r));
            (table.surface_albedo, to_model, distance(sampler, end, |r| share_within(table, r)))
        })
        .collect();
    let greatest = |of: &dyn Fn(&(f64, f64, f64)) -> f64, within: [f64; 2]| {
        let here = distances.iter().filter(|(a, ..)| (within[0]..=within[1]).contains(a));
        here.map(of).fold(0.0, f64::max)
    };
    let to_model = |distance: &(f64, f64, f64)| distance.1;
    let least = distances.iter().map(to_model).fold(f64::INFINITY, f64::min);
    // Formula against formula: the tables lend their albedos alone, which have six digits and more.
    table.statement(
        "KS distance to the model, least",
        "\"accurate\"",
        &number(least),
        (least - 0.0318).abs() < 1e-3,
    );
    let middle = greatest(&to_model, [0.02, 0.9]);
    table.statement(
        "KS distance to the model, greatest, A = 0.02..0.90",
        "\"accurate\"",
        &number(middle),
        (middle - 0.0961).abs() < 1e-3,
    );
    // α from 0.4 to 0.6 is A from 0.083 to 0.155.
    let admitted = greatest(&to_model, [0.08, 0.16]);
    let bright = greatest(&to_model, [0.9, 1.0]);
    table.contradiction(
        "greatest where alpha is in [0.4, 0.6] (section 7)",
        &number(admitted),
        &format!("{} at A >= 0.9", number(bright)),
        (admitted - 0.0661).abs() < 1e-3 && (bright - 0.113).abs() < 2e-3,
        "there is a peak, but both ends are worse",
    );
    let to_truth = greatest(&|distance| distance.2, [0.0, 1.0]);
    // The quick tables and those of an independent simulation agree to 0.0005 of the cdf.
    table.statement(
        "KS distance to the truth, greatest",
        "-",
        &number(to_truth),
        (to_truth - 0.1666).abs() < 2e-3,
    );
    table.finish();
}

#[test]
fn equations_19_to_21_need_a_clamp_and_have_their_own_density() {
    let mut table = Comparison::new("L23 eq. (19)-(21): clamps and density of the samples");
    let tables = &truth::searchlight().tables;
    let (mut negative, mut rises) = (true, true);
    for table in tables {
        let sampler = Sampler::liang_2023(table.single_scattering_albedo);
        negative &= (1..100).all(|step| sampler.at(1e-4 * f64::from(step)) < 0.0);
        rises &= (100..9_999).all(|step| {
            let xi = 1e-4 * f64::from(step);
            sampler.at(xi + 1e-4) > sampler.at(xi) && sampler.derivative(xi) > 0.0
        });
    }
    table.contradiction(
        "radii are not negative",
        "r = min(g, r_max)",
        "g < 0 for all xi < 0.01",
        negative,
        "ln(1.01 - xi) > 0: clamp to [0, r_max]",
    );
    table.statement("g rises from xi = 0.01 on", "inverse of a cdf", "at all albedos", rises);
    let reach = |surface_albedo: f64| {
        let truth = at(tables, surface_albedo);
        let sampler = Sampler::liang_2023(truth.single_scattering_albedo);
        sampler.at(1.0) / model(truth).max_radius().unwrap()
    };
    // Formula against formula.
    table.differs(
        "g(1) / r_max at A = 0.5",
        1.0,
        reach(0.5),
        [1.161, 1e-2],
        "eq. (21) clamps the last percent",
    );
    table.differs(
        "g(1) / r_max at A = 0.99",
        1.0,
        reach(0.99),
        [0.585, 1e-2],
        "the outer 40 % are never sampled",
    );

    // What eq. (22) divides by: the density of the samples, which is 1/g′ and not the model's own pdf.
    let (mut of_derivative, mut of_model): (f64, f64) = (0.0, 0.0);
    for surface_albedo in [0.2, 0.5, 0.8] {
        let truth = at(tables, surface_albedo);
        let (sampler, model) = (Sampler::liang_2023(truth.single_scattering_albedo), model(truth));
        let (from, to) = (0.05, 0.9);
        let (r_lo, r_hi) = (sampler.at(from), sampler.at(to));
        const BINS: usize = 200;
        let mut counts = [0.0; BINS];
        for xi in strata(FINE_STRATA) {
            let bin = (sampler.at(xi) - r_lo) / (r_hi - r_lo) * BINS as f64;
            if (0.0..BINS as f64).contains(&bin) {
                counts[bin as usize] += 1.0 / f64::from(FINE_STRATA);
            }
        }
        let width = (r_hi - r_lo) / BINS as f64;
        for (bin, count) in counts.into_iter().enumerate() {
            let middle = r_lo + (bin as f64 + 0.5) * width;
            // The ξ of the middle, by bisection: g rises.
            let (mut lo, mut hi) = (from, to);
            for _ in 0..50 {
                let xi = 0.5 * (lo + hi);
                if sampler.at(xi) < middle { lo = xi } else { hi = xi }
            }
            let density = count / width;
            of_derivative = of_derivative.max((1.0 / (sampler.derivative(lo) * density) - 1.0).abs());
            of_model = of_model.max((model.radial_pdf(middle) / density - 1.0).abs());
        }
    }
    // One stratum on the other side of an edge is 1 % of the least populated bin; bending within the first bin is as
    // much again.
    table.agrees("1/g' over the density of samples, greatest error", 0.0, of_derivative, 0.02);
    table.contradiction(
        "model's pdf over the density of samples",
        "p of eq. (22)",
        &format!("off by up to {}", number(of_model)),
        of_model > 0.2,
        "p must be 1/g', or r the inverse of eq. (17)",
    );
    table.finish();
}
