use proptest::prelude::*;

use super::*;
use crate::load::load_memory;

fn set(files: &[(&str, &str)]) -> MaterialSet {
    let loaded = load_memory(files.iter().copied());
    loaded.set.unwrap_or_else(|| panic!("{}", loaded.report))
}

fn material(profile: &str) -> String {
    format!("Material(profile: {profile}, mean_free_path_mm: (1, 2, 3), surface_albedo: (0.8, 0.6, 0.4))")
}

fn one(profile: &str) -> MaterialSet {
    set(&[("a.ron", &material(profile))])
}

/// Every published model, mixtures, and a table whose density has a hole.
fn sets() -> Vec<(String, MaterialSet)> {
    let published = Model::PUBLISHED.into_iter().map(|stem| (stem.to_owned(), one(&format!("\"{stem}\""))));
    let hole = "surface_albedo,r,r_reflectance\n0.5,0,0.1\n0.5,0.5,0\n0.5,2,0\n0.5,3,0.1\n0.5,4,0\n";
    let tabulated = set(&[("a.ron", &material("Tabulated(file: \"t.csv\")")), ("t.csv", hole)]);
    let mixtures = [
        ("scaled", "Mixture([(0.3, Burley(parametrization: Searchlight)), (0.7, ExponentialDipole(entry: Diffuse))])"),
        ("both", "Mixture([(0.5, Burley(parametrization: Diffuse)), (0.5, Dipole(medium: Skin1))])"),
    ]
    .map(|(name, text)| (name.to_owned(), one(text)));
    published.chain(mixtures).chain([("hole".to_owned(), tabulated)]).collect()
}

fn bake(set: &MaterialSet, with_edges: bool) -> Curves {
    Curves::bake(set, with_edges).unwrap_or_else(|error| panic!("{error:?}"))
}

/// The values at the ends of the intervals: of a row itself, or of the one it holds as its next.
fn knots(row: &Row, next: bool) -> Vec<f32> {
    let first = if next { 2 } else { 0 };
    let starts = row.iter().map(|texel| texel[first]);
    let last = row[TEXELS - 1];
    starts.chain([last[first] + last[first + 1]]).collect()
}

/// The model's profile for a row of curves: of the node, or of the channel.
fn profile(model: &Model, node: usize) -> Box<dyn RadialProfile> {
    let node = u32::try_from(node).expect("few rows");
    let albedo = |node: u32| 1.0 - (1.0 - f64::from(node) / 15.0).powi(2);
    let (surface_albedo, channel, mean_free_path_mm) = match NodesOf::model(model) {
        NodesOf::SurfaceAlbedo => (albedo(node), Channel::Red, 1.0),
        NodesOf::Channel => (0.5, Channel::ALL[node as usize], 1.0),
        // The lengths of `material`.
        NodesOf::Both => (albedo(node % 16), Channel::ALL[node as usize / 16], f64::from(node / 16 + 1)),
    };
    let medium = Medium::new(surface_albedo.min(0.999), mean_free_path_mm).expect("a legal medium");
    model.profile(medium, channel).expect("a published model has a profile")
}

/// Rows of a model's curves.
fn rows_of(model: &Model) -> usize {
    match NodesOf::model(model) {
        NodesOf::SurfaceAlbedo => 16,
        NodesOf::Channel => 3,
        NodesOf::Both => 48,
    }
}

#[test]
fn radii_rise_within_a_row_and_hold_the_share_they_stand_for() {
    for (name, set) in sets() {
        let curves = bake(&set, false);
        let model = &set.materials[0].profile.model;
        assert_eq!(curves.rows.len(), rows_of(model), "{name}");
        for (node, row) in curves.rows.iter().enumerate() {
            assert!(row.iter().all(|texel| texel[1] > 0.0 && texel[3] > 0.0), "{name} {node}: a plateau");
            let radii = knots(row, false);
            assert_eq!(radii[0], 0.0, "{name} {node}");
            assert!(radii.windows(2).all(|pair| pair[1] > pair[0]), "{name} {node}: equal in f32");
            let profile = profile(model, node);
            for (index, radius) in radii.iter().enumerate().skip(1) {
                let beyond = (1.0 - index as f64 / 64.0).powi(2);
                let beyond = if index == 64 { 1e-4 } else { beyond };
                // Rounding to f32 (6e-8) moves a radius, and with it the share, by r·pdf(r) ≤ 1 times as much. A plateau
                // is moved by 1e-6 per texel, where the density is 0.
                let error = profile.radial_tail(f64::from(*radius)) - beyond;
                assert!(error.abs() < 1e-6, "{name} {node} {index}: {error}");
            }
        }
    }
}

#[test]
fn a_row_holds_the_next_one_and_the_last_itself() {
    for (name, set) in sets() {
        let run = if NodesOf::model(&set.materials[0].profile.model) == NodesOf::Channel { 1 } else { 16 };
        for with_edges in [false, true] {
            let curves = bake(&set, with_edges);
            for (number, row) in curves.rows.iter().enumerate() {
                let is_last = number % run == run - 1;
                let next = &curves.rows[if is_last { number } else { number + 1 }];
                let same = row.iter().zip(next).all(|(row, next)| row[2..] == next[..2]);
                assert!(same, "{name} {number}");
            }
        }
    }
}

#[test]
fn edges_rise_from_one_half_and_are_what_the_profile_says() {
    for (name, set) in sets() {
        let curves = bake(&set, true);
        let place = curves.places[0];
        let model = &set.materials[0].profile.model;
        assert_eq!(place.first_edge, place.curve_count, "{name}: edges follow the radii");
        let (radii, edges) = curves.rows.split_at(place.first_edge as usize);
        let (edges, lines) = edges.split_at(place.curve_count as usize);
        assert_eq!(lines.len(), edges.len(), "{name}");
        let widest = radii.iter().map(|row| knots(row, false)[TEXELS]).fold(0.0, f32::max);
        // The reach is kept in f64, and a row's last radius as a sum of two f32.
        assert!((place.edge_reach / f64::from(widest) - 1.0).abs() < 1e-6, "{name}");
        for (node, row) in edges.iter().enumerate() {
            let fractions = knots(row, false);
            assert_eq!(fractions[0], 0.5, "{name} {node}");
            assert!(fractions.windows(2).all(|pair| pair[1] >= pair[0]), "{name} {node}");
            let last = fractions[TEXELS];
            assert!(last > 0.999 && last <= 1.0, "{name} {node}: {last}");
            let profile = profile(model, node);
            for index in [1, 8, 23, 40, 63] {
                let x = place.edge_reach * (index as f64 / 64.0).powi(EDGE_POWER);
                // ESF(x) = 1 − (1/π) ∫ tail(x/sin φ) dφ over 0 to π/2, by the midpoint rule in s, φ = s² π/2, which
                // looks closest at the large radii: another way than the library's. 2,000 steps leave less than 1e-5
                // even where a table has a kink.
                let steps = 2_000;
                let integrand = |step: u32| {
                    let s = (f64::from(step) + 0.5) / f64::from(steps);
                    profile.radial_tail(x / (s * s * std::f64::consts::FRAC_PI_2).sin()) * s
                };
                let expected = 1.0 - (0..steps).map(integrand).sum::<f64>() / f64::from(steps);
                let error = f64::from(fractions[index]) - expected;
                assert!(error.abs() < 1e-5, "{name} {node} {index}: {error}");
            }
            let distances = knots(&lines[node], false);
            assert!(distances.windows(2).all(|pair| pair[1] >= pair[0]), "{name} {node}");
            assert_eq!(distances[0], 0.0, "{name} {node}");
            let spread = EdgeSpread::new(&*profile);
            for index in [4, 16, 32, 48, 60] {
                let outside = (1.0 - index as f64 / 64.0).powi(2);
                let error = 2.0 * (1.0 - spread.at(f64::from(distances[index]))) - outside;
                // The edge curve is straight between its 65 knots, of which narrow profiles have few.
                assert!(error.abs() < 2e-2, "{name} {node} {index}: {error}");
            }
        }
    }
}

#[test]
fn a_set_without_edges_has_none() {
    let curves = bake(&one("\"burley_diffuse\""), false);
    let expected = CurvePlace { first_curve: 0, curve_count: 16, first_edge: 0, edge_reach: 0.0 };
    assert_eq!(curves.places, [expected]);
    assert_eq!(curves.size(), [64, 16]);
}

#[test]
fn equal_models_share_their_rows_and_others_do_not() {
    let [burley, skin, dipole] =
        ["Burley(parametrization: Diffuse)", "\"gaussian_skin\"", "\"exponential_dipole_diffuse\""]
            .map(material);
    let files = [("a.ron", burley.as_str()), ("b.ron", &skin), ("c.ron", &burley), ("d.ron", &dipole)];
    for with_edges in [false, true] {
        let curves = bake(&set(&files), with_edges);
        let firsts: Vec<[u32; 2]> =
            curves.places.iter().map(|place| [place.first_curve, place.curve_count]).collect();
        assert_eq!(firsts, [[0, 16], [16, 3], [0, 16], [19, 16]]);
        let edges: Vec<u32> = curves.places.iter().map(|place| place.first_edge).collect();
        let (expected, height) = if with_edges { ([35, 67, 35, 73], 105) } else { ([0; 4], 35) };
        assert_eq!((edges, curves.size()), (expected.to_vec(), [64, height]));
    }
}

#[test]
fn the_bytes_are_the_rows_column_by_column() {
    let row = |value: f32| [[value, 1.0, 2.0, 3.0]; TEXELS];
    let of = |count: usize| Curves { places: Vec::new(), rows: (0..count).map(|i| row(i as f32)).collect() };
    let texel = |curves: &Curves, x: usize, y: usize| {
        let bytes = curves.bytes();
        let start = 16 * (y * curves.size()[0] as usize + x);
        let value = |i: usize| f32::from_le_bytes([0, 1, 2, 3].map(|byte| bytes[start + 4 * i + byte]));
        [value(0), value(1), value(2), value(3)]
    };
    let small = of(3);
    assert_eq!((small.size(), small.bytes().len()), ([64, 3], 64 * 3 * 16));
    assert_eq!(texel(&small, 63, 2), [2.0, 1.0, 2.0, 3.0]);
    // One row more than a column has.
    let large = of(LARGEST_HEIGHT + 1);
    assert_eq!(large.size(), [128, 8192]);
    assert_eq!(texel(&large, 0, 8191), [8191.0, 1.0, 2.0, 3.0]);
    assert_eq!(texel(&large, 64, 0), [8192.0, 1.0, 2.0, 3.0]);
    assert_eq!(texel(&large, 64, 1), [0.0; 4], "no row stands there");
}

#[test]
fn texels_behind_the_rows_begin_a_row_of_their_own() {
    let mut curves = bake(&one("\"gaussian_skin\""), false);
    let start = curves.texels();
    assert_eq!(start, 3 * 64);
    curves.append(&[[1.0, 2.0, 3.0, 4.0]; 65]);
    assert_eq!((curves.texels(), curves.size()), (5 * 64, [64, 5]));
    let filled = |row: usize| curves.rows[row].iter().filter(|texel| texel[3] == 4.0).count();
    assert_eq!([filled(3), filled(4)], [64, 1]);
    curves.append(&[]);
    assert_eq!(curves.texels(), 5 * 64);
}

#[test]
fn a_model_without_a_profile_at_a_node_is_refused() {
    // s(A) = 1000 |A - 29/225| - 0.01 is negative within 1e-5 of the second node, and nowhere else.
    let set =
        one("Burley(parametrization: Fit(length: MeanFreePath, constant: -0.01, slope: 0, amplitude: 1000, \
                   pivot: 0.12888888888888889, exponent: 1))");
    let error = Curves::bake(&set, false).expect_err("no profile at 29/225");
    assert!((error.surface_albedo - 29.0 / 225.0).abs() < 1e-15, "{}", error.surface_albedo);
    assert_eq!(error.material, 0);
}

/// Models that the loader accepts with coefficients of any size.
fn any_model() -> impl Strategy<Value = String> {
    let number = || (-3.0..3.0f64).prop_map(|exponent| 10f64.powf(exponent));
    let burley = prop::array::uniform5(number()).prop_map(|[a, b, c, d, e]| {
        format!("Burley(parametrization: Fit(length: MeanFreePath, constant: {a}, slope: -{b}, amplitude: {c}, pivot: {d}, exponent: {e}))")
    });
    let dipole = (prop::array::uniform3(0.0..0.3f64), prop::array::uniform9(number())).prop_map(|(w, c)| {
        let three = |at: usize| format!("({}, {}, {})", c[at], c[at + 1], c[at + 2]);
        let [w0, w1, w2] = w;
        let (d, z, s) = (three(0), three(3), three(6));
        format!("ExponentialDipole(exponential_weight: ({w0}, {w1}, {w2}), exponential_length: {d}, dipole_depth: {z}, dipole_attenuation: {s})")
    });
    let gaussian = prop::collection::vec((-30.0..30.0f64, 0.0..1.0f64), 1..4).prop_map(|terms| {
        let term = |(exponent, weight): &(f64, f64)| {
            format!("(variance_mm2: {:e}, weight: {weight})", 10f64.powf(*exponent))
        };
        format!("GaussianSum([{}])", terms.iter().map(term).collect::<Vec<_>>().join(", "))
    });
    prop_oneof![burley, dipole, gaussian]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn whatever_the_loader_accepts_has_finite_rising_curves(profile in any_model()) {
        let text = material(&profile);
        let Some(set) = load_memory([("a.ron", &text)]).set else { return Ok(()) };
        let Ok(curves) = Curves::bake(&set, true) else { return Ok(()) };
        let place = curves.places[0];
        let (radii, edges) = curves.rows.split_at(place.first_edge as usize);
        let (edges, lines) = edges.split_at(place.curve_count as usize);
        for row in radii {
            prop_assert!(row.iter().all(|texel| texel.iter().all(|value| value.is_finite())), "{}", profile);
            prop_assert!(row.iter().all(|texel| texel[1] > 0.0 && texel[3] > 0.0), "{}", profile);
        }
        for row in edges {
            prop_assert!(row.iter().flatten().all(|value| (0.0..=1.0).contains(value)), "{}", profile);
        }
        for row in lines {
            let distances = row.iter().flatten();
            prop_assert!(distances.into_iter().all(|value| value.is_finite() && *value >= 0.0), "{}", profile);
        }
    }
}
