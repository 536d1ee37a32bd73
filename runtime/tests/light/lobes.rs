//! Diffuse lobes that are not the medium's own.

use subsurface_profile::single_scattering_albedo::{Entry, from_surface_albedo};

use crate::gpu::Gpu;
use crate::scene::{SURFACE_ALBEDO, Scene, beside, medium, tilted};

/// Radiance over A of what is diffuse, without a boundary: in light from everywhere alike at a cosine of view, or from a
/// light at another.
fn lobe(gpu: &Gpu, fields: &str, view: f64, light: Option<f64>) -> [f64; 3] {
    let material = medium(&format!("specular: (reflectance_at_normal: 0), {fields}"));
    let mut scene = Scene::new(gpu, &material, &[tilted(view)]);
    let [diffuse, _] = scene.radiance(light.map(|light| beside(view, light)));
    [0, 1, 2].map(|channel: usize| diffuse[channel] / SURFACE_ALBEDO[channel])
}

#[test]
fn lobes_have_the_albedos_of_their_formulas() {
    let gpu = Gpu::open();
    // Oren and Nayar at σ = 0.5, Disney's at roughness 1: integrals by another program.
    for (fields, albedos, tolerance) in [
        ("diffuse: OrenNayar(sigma: 0.5)", [(1.0, 0.785), (0.7, 0.852), (0.3, 0.912)], 0.03),
        ("diffuse: OrenNayar(sigma: 0.0)", [(1.0, 1.0), (0.5, 1.0), (0.1, 1.0)], 2e-3),
        ("diffuse: Coupled", [(1.0, 1.0), (0.5, 1.0), (0.1, 1.0)], 2e-3),
    ] {
        for (view, albedo) in albedos {
            let found = lobe(&gpu, fields, view, None)[0];
            // Twelve directions stand for all.
            assert!((found / albedo - 1.0).abs() < tolerance, "{fields} at {view}: {found}, not {albedo}");
        }
    }
    let disney = |view: f64| {
        let rough = "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1, 1, 1), \
                     surface_albedo: (0.5, 0.5, 0.5), diffuse: Disney(subsurface: 0), \
                     specular: (reflectance_at_normal: 0, roughness: 1.0))";
        let mut scene = Scene::new(&gpu, rough, &[tilted(view)]);
        2.0 * scene.radiance(None)[0][0]
    };
    for (view, albedo) in [(1.0, 1.04), (0.05, 1.46)] {
        assert!((disney(view) / albedo - 1.0).abs() < 0.04, "Disney's at {view}: {}", disney(view));
    }
}

#[test]
fn a_mirror_and_what_it_lets_through_are_all_of_the_light() {
    let gpu = Gpu::open();
    for reflectance in [0.028, 0.2, 0.5_f64] {
        let white = format!(
            "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.0, 1.0, 1.0), \
             surface_albedo: (1.0, 1.0, 1.0), diffuse: Shirley, specular: (reflectance_at_normal: {reflectance:?}))"
        );
        for view in [1.0, 0.7, 0.4, 0.2_f64] {
            let mut scene = Scene::new(&gpu, &white, &[tilted(view)]);
            let mirrored = reflectance + (1.0 - reflectance) * (1.0 - view).powi(5);
            let found = scene.radiance(None)[0][0];
            // Half floats; the sum over directions is exact for fifth powers.
            assert!((found + mirrored - 1.0).abs() < 2e-3, "{reflectance} at {view}: {found} + {mirrored}");
        }
    }
}

#[test]
fn dust_without_opposition_is_the_half_space() {
    let gpu = Gpu::open();
    for (view, light) in [(1.0, 0.8), (0.5, 0.3), (0.3, 0.9), (0.8, 0.15)] {
        let hapke = lobe(&gpu, "diffuse: Hapke(opposition: 0, anisotropy: 0)", view, Some(light));
        let chandrasekhar = lobe(&gpu, "diffuse: Chandrasekhar(entry: Diffuse)", view, Some(light));
        for (hapke, chandrasekhar) in hapke.into_iter().zip(chandrasekhar) {
            // One writes its exit into a half float.
            assert!((hapke / chandrasekhar - 1.0).abs() < 4e-3, "{view}, {light}: {hapke}, {chandrasekhar}");
        }
        // Light that goes back the way it came is brighter by the opposition.
        let surge = lobe(&gpu, "diffuse: Hapke(opposition: 1, opposition_width: 0.1)", view, Some(view));
        let none = lobe(&gpu, "diffuse: Hapke(opposition: 0)", view, Some(view));
        assert!(surge.iter().zip(none).all(|(surge, none)| *surge >= none), "{surge:?}, {none:?}");
    }
}

#[test]
fn every_lobe_is_reciprocal_and_has_its_mean() {
    let gpu = Gpu::open();
    for fields in [
        "diffuse: Shirley",
        "diffuse: LommelSeeliger",
        "diffuse: Hapke(opposition: 0.5, opposition_width: 0.2, anisotropy: -0.3)",
        "diffuse: OrenNayar(sigma: 0.4)",
        "diffuse: Disney(subsurface: 0.4)",
    ] {
        for (one, other) in [(1.0, 0.5), (0.8, 0.15), (0.3, 0.5)] {
            let seen =
                |view: f64, light: f64| lobe(&gpu, fields, view, Some(light)).map(|value| value / light);
            for (there, back) in seen(one, other).into_iter().zip(seen(other, one)) {
                // Half floats.
                assert!((there / back - 1.0).abs() < 4e-3, "{fields} {one}, {other}: {there}, {back}");
            }
        }
    }
    // Light from everywhere returns with A in the mean: 2 ∫ μ over Gauss's points of μ².
    let mean = |fields: &str| {
        let points = [(0.069_43, 0.173_93), (0.330_01, 0.326_07), (0.669_99, 0.326_07), (0.930_57, 0.173_93)];
        points
            .iter()
            .map(|(square, weight): &(f64, f64)| weight * lobe(&gpu, fields, square.sqrt(), None)[1])
            .sum::<f64>()
    };
    for fields in ["diffuse: LommelSeeliger", "diffuse: Hapke(opposition: 0)"] {
        let found = mean(fields);
        // Twelve directions stand for all, and four of view.
        assert!((found - 1.0).abs() < 0.02, "{fields}: {found}");
    }
}

#[test]
fn a_layer_below_a_boundary_has_refracted_angles() {
    let gpu = Gpu::open();
    const INDEX: f64 = 1.4;
    let reflectance = ((INDEX - 1.0) / (INDEX + 1.0)).powi(2);
    let seen = |fields: &str, index: f64, view: f64, light: f64| {
        let reflectance = if index > 1.0 { reflectance } else { 0.0 };
        // What the boundary lets in and out is the coupling's.
        let specular = format!("specular: (reflectance_at_normal: {reflectance:?}, coupling: None)");
        let mut scene = Scene::new(&gpu, &medium(&format!("{specular}, {fields}")), &[tilted(view)]);
        let [diffuse, _] = scene.radiance(Some(beside(view, light)));
        [0, 1, 2].map(|channel: usize| diffuse[channel] / SURFACE_ALBEDO[channel] / light)
    };
    let below = |cosine: f64| (1.0 - (1.0 - cosine * cosine) / (INDEX * INDEX)).sqrt();
    for (view, light) in [(1.0, 0.8), (0.5, 0.3), (0.3, 0.9)] {
        let cosines = below(view) + below(light);
        let layer = seen("diffuse: HanrahanKrueger", INDEX, view, light);
        for (channel, found) in layer.into_iter().enumerate() {
            let alpha = from_surface_albedo(Entry::Diffuse, SURFACE_ALBEDO[channel]);
            let expected = alpha / (4.0 * SURFACE_ALBEDO[channel] * cosines * INDEX * INDEX);
            // Half floats, and the fit of α.
            assert!((found / expected - 1.0).abs() < 5e-3, "{view}, {light}: {found}, not {expected}");
        }
        let dust = seen("diffuse: LommelSeeliger(refracted: true)", INDEX, view, light)[0];
        let expected = 1.0 / (8.0 / 3.0 * (1.0 - 2.0_f64.ln()) * cosines * INDEX * INDEX);
        assert!((dust / expected - 1.0).abs() < 3e-3, "{view}, {light}: {dust}, not {expected}");
        // Without a boundary nothing is refracted, and every lobe is reciprocal below one.
        for [plain, refracted] in [
            ["LommelSeeliger", "LommelSeeliger(refracted: true)"],
            [
                "Hapke(opposition: 0.7, anisotropy: -0.4)",
                "Hapke(opposition: 0.7, anisotropy: -0.4, refracted: true)",
            ],
        ] {
            let [plain, refracted] = [plain, refracted].map(|lobe| format!("diffuse: {lobe}"));
            let [one, other] = [&plain, &refracted].map(|fields| seen(fields, 1.0, view, light)[1]);
            assert!((one / other - 1.0).abs() < 2e-3, "{refracted}: {one}, {other}");
            let [there, back] =
                [(view, light), (light, view)].map(|(one, other)| seen(&refracted, INDEX, one, other)[2]);
            assert!((there / back - 1.0).abs() < 4e-3, "{refracted}: {there}, {back}");
        }
    }
}
