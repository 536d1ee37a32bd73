//! White furnaces, reciprocity, and highlights of one lobe and two.

use std::f64::consts::PI;

use crate::gpu::Gpu;
use crate::scene::{COSINES, Scene, beside, medium, tilted};

/// Share of the light that the specular lobe sends back, seen at a cosine: ∫ f μ_l dω_l over half vectors whose angle θ
/// to the normal is such that tan θ = α tan ψ with even steps of ψ.
fn specular_albedo(view: f64, roughness: f64, reflectance_at_normal: f64) -> f64 {
    const STEPS: [u32; 2] = [400, 200];
    let (alpha, k) = (roughness * roughness, (roughness + 1.0).powi(2) / 8.0);
    let masked = |cosine: f64| cosine * (1.0 - k) + k;
    let [psi_step, turn_step] = [PI / 2.0 / f64::from(STEPS[0]), PI / f64::from(STEPS[1])];
    let mut sum = 0.0;
    for place in 0..STEPS[0] * STEPS[1] {
        let psi = (f64::from(place / STEPS[1]) + 0.5) * psi_step;
        let turn = (f64::from(place % STEPS[1]) + 0.5) * turn_step;
        let theta = (alpha * psi.tan()).atan();
        let theta_by_psi = alpha / (psi.cos().powi(2) + (alpha * psi.sin()).powi(2));
        let (sin, cos) = theta.sin_cos();
        let view_half = view * cos + (1.0 - view * view).sqrt() * sin * turn.cos();
        let light = 2.0 * view_half * cos - view;
        if light <= 0.0 || view_half <= 0.0 {
            continue;
        }
        let narrowing = cos * cos * (alpha * alpha - 1.0) + 1.0;
        let distribution = alpha * alpha / (PI * narrowing * narrowing);
        let fresnel = reflectance_at_normal + (1.0 - reflectance_at_normal) * (1.0 - view_half).powi(5);
        let brdf = distribution * fresnel / (4.0 * masked(light) * masked(view));
        sum += brdf * light * 4.0 * view_half * sin * theta_by_psi;
    }
    // Both halves of the turn are alike.
    2.0 * sum * psi_step * turn_step
}

#[test]
fn a_white_furnace_is_white_under_two_lobes() {
    let gpu = Gpu::open();
    for (first, second, weight) in [(0.4, 0.2, 0.3), (0.9, 0.1, 0.5), (0.3, 1.0, 1.0)] {
        let white = format!(
            "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.0, 1.0, 1.0), \
             surface_albedo: (1.0, 1.0, 1.0), specular: (roughness: {first:?}, second: (roughness: {second:?}, \
             weight: {weight:?})))"
        );
        for view in COSINES {
            let mut scene = Scene::new(&gpu, &white, &[tilted(view)]);
            let [diffuse, unscattered] = scene.radiance(None);
            for (diffuse, unscattered) in diffuse.into_iter().zip(unscattered) {
                // As for one lobe.
                assert!((diffuse + unscattered - 1.0).abs() < 2e-3, "{view}: {diffuse} + {unscattered}");
            }
        }
    }
}

#[test]
fn a_white_furnace_is_white_at_every_roughness() {
    let gpu = Gpu::open();
    let mut worst = 0.0_f64;
    for (roughness, reflectance) in
        [(0.1, 0.2), (0.17, 0.028), (0.2, 0.028), (0.33, 1.0), (0.4, 0.028), (0.8, 0.028), (1.0, 0.5)]
    {
        let white = format!(
            "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.0, 1.0, 1.0), \
             surface_albedo: (1.0, 1.0, 1.0), specular: (reflectance_at_normal: {reflectance:?}, \
             roughness: {roughness:?}))"
        );
        for view in COSINES {
            let mut scene = Scene::new(&gpu, &white, &[tilted(view)]);
            let reflected = specular_albedo(view, roughness, reflectance);
            let [diffuse, unscattered] = scene.radiance(None);
            for (diffuse, unscattered) in diffuse.into_iter().zip(unscattered) {
                let case =
                    format!("{roughness}, {reflectance} at {view}: {diffuse} + {unscattered}, {reflected}");
                worst = worst.max((diffuse + unscattered - 1.0).abs());
                assert!((diffuse + unscattered - 1.0).abs() < 2e-3, "{case}");
                assert!((unscattered - reflected).abs() < 2e-3, "{case}");
            }
        }
    }
    println!("off by {worst:.1e} at most");
}

#[test]
fn light_that_goes_back_the_way_it_came_is_as_bright() {
    let gpu = Gpu::open();
    for fields in
        ["specular: (reflectance_at_normal: 0)", "diffuse: Lambert", "", "specular: (roughness: 0.9)"]
    {
        let seen = |view: f64, light: f64| {
            let mut scene = Scene::new(&gpu, &medium(fields), &[tilted(view)]);
            let [diffuse, _] = scene.radiance(Some(beside(view, light)));
            diffuse.map(|radiance| radiance / light)
        };
        for (one, other) in [(1.0, 0.5), (0.8, 0.15), (0.3, 0.5), (0.15, 1.0)] {
            for (there, back) in seen(one, other).into_iter().zip(seen(other, one)) {
                // Three half floats on the way: irradiance, the specular share and the angle.
                assert!((there / back - 1.0).abs() < 4e-3, "{fields} {one}, {other}: {there}, {back}");
            }
        }
    }
}

#[test]
fn without_a_boundary_nothing_shines() {
    let gpu = Gpu::open();
    let mut scene =
        Scene::new(&gpu, &medium("specular: (reflectance_at_normal: 0, roughness: 0.3)"), &[tilted(0.2)]);
    for light in [None, Some([0.0, 0.0, 1.0]), Some(beside(0.2, 0.1))] {
        let [_, unscattered] = scene.radiance(light);
        assert_eq!(unscattered, [0.0; 3], "{light:?}");
    }
}

#[test]
fn a_second_lobe_of_no_weight_or_of_the_same_roughness_changes_no_bit() {
    let gpu = Gpu::open();
    let seen = |fields: &str| {
        let mut scene = Scene::new(&gpu, &medium(fields), &[tilted(0.6)]);
        [Some([0.0, 0.0, 1.0]), Some(beside(0.6, 0.7)), None].map(|light| scene.radiance(light))
    };
    let one = seen("specular: (roughness: 0.4)");
    for second in ["roughness: 0.9, weight: 0.0", "roughness: 0.4, weight: 0.7"] {
        assert!(seen(&format!("specular: (roughness: 0.4, second: ({second}))")) == one, "{second}");
    }
    // A mixture lies between its parts, by their weights.
    let [other, both] = ["", ", second: (roughness: 0.9, weight: 0.25)"].map(|second| {
        seen(&format!("specular: (roughness: {}{second})", if second.is_empty() { 0.9 } else { 0.4 }))
    });
    for ((one, other), both) in one.iter().zip(&other).zip(&both) {
        let expected = 0.75 * one[1][0] + 0.25 * other[1][0];
        assert!((both[1][0] - expected).abs() < 1e-3 * expected + 1e-4, "{}: {expected}", both[1][0]);
    }
}
