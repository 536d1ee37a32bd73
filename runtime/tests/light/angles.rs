//! Angles at which light enters a medium and leaves it.

use subsurface_profile::HalfSpace;
use subsurface_profile::single_scattering_albedo::Entry;

use crate::gpu::Gpu;
use crate::scene::{COSINES, REFLECTANCE_AT_NORMAL, SURFACE_ALBEDO, Scene, beside, medium, tilted};

#[test]
fn angles_are_those_of_the_half_space() {
    let gpu = Gpu::open();
    for (stem, entry) in
        [("two_exponential_dipole_searchlight", Entry::Searchlight), ("burley_diffuse", Entry::Diffuse)]
    {
        let [ar, ag, ab] = SURFACE_ALBEDO;
        let text = format!(
            "Material(profile: \"{stem}\", mean_free_path_mm: (1.0, 1.0, 1.0), \
             surface_albedo: ({ar:?}, {ag:?}, {ab:?}), specular: (reflectance_at_normal: 0, coupling: None))"
        );
        let media = SURFACE_ALBEDO.map(|albedo| HalfSpace::of(entry, albedo));
        for view in COSINES {
            let mut scene = Scene::new(&gpu, &text, &[tilted(view)]);
            let check = |radiance: [f64; 3], arriving: &dyn Fn(&HalfSpace) -> f64, what: &str| {
                for (channel, medium) in media.iter().enumerate() {
                    let expected = SURFACE_ALBEDO[channel] * arriving(medium) * medium.exit(view);
                    // Half floats: of light, and of the angle, where the albedo is steep.
                    let off = (radiance[channel] / expected - 1.0).abs();
                    assert!(off < 4e-3, "{stem}, {what}, seen at {view}: {radiance:?}, {expected}");
                }
            };
            check(scene.radiance(None)[0], &HalfSpace::diffuse_entry, "light from everywhere");
            for light in COSINES {
                let [radiance, _] = scene.radiance(Some(beside(view, light)));
                let arriving = |medium: &HalfSpace| light * medium.entry(light) * medium.pairing(light, view);
                check(radiance, &arriving, &format!("a light at {light}"));
            }
        }
    }
}

#[test]
fn a_boundary_makes_angles_alike() {
    let gpu = Gpu::open();
    let index = (1.0 + REFLECTANCE_AT_NORMAL.sqrt()) / (1.0 - REFLECTANCE_AT_NORMAL.sqrt());
    let below = |cosine: f64| (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
    let media = SURFACE_ALBEDO.map(|albedo| HalfSpace::below(Entry::Searchlight, index, albedo));
    // 2 ∫ A(μ′) μ dμ by many steps.
    let mean = |medium: &HalfSpace| {
        let cosines = (0..1000).map(|step| (f64::from(step) + 0.5) / 1000.0);
        cosines.map(|cosine| 2.0 * cosine * medium.entry(below(cosine))).sum::<f64>() / 1000.0
    };
    let shape = |cosine: f64| {
        media.iter().map(|medium| medium.entry(below(cosine)) / mean(medium)).sum::<f64>() / 3.0
    };
    for view in COSINES {
        let fields = format!("specular: (reflectance_at_normal: {REFLECTANCE_AT_NORMAL:?}, coupling: None)");
        let mut scene = Scene::new(&gpu, &medium(&fields), &[tilted(view)]);
        assert!((shape(view) - 1.0).abs() < 0.1, "{} at {view}", shape(view));
        for light in COSINES {
            let [radiance, _] = scene.radiance(Some(beside(view, light)));
            for (channel, medium) in media.iter().enumerate() {
                let entered = light * mean(medium) * shape(light);
                let expected = SURFACE_ALBEDO[channel] * entered * shape(view);
                // Half floats, and the two points of the mean.
                let off = (radiance[channel] / expected - 1.0).abs();
                assert!(off < 5e-3, "a light at {light}, seen at {view}: {radiance:?}, {expected}");
            }
        }
    }
}
