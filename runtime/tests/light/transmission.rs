//! What comes through a slab, a sphere and a sheet.

use std::f64::consts::PI;

use subsurface_profile::single_scattering_albedo::{Entry, to_surface_albedo};
use subsurface_profile::{Channel, HalfSpace, Medium, Model, Slab};
use subsurface_runtime::{Bounds, DirectionalLight, PointLight};

use crate::gpu::Gpu;
use crate::scene::{
    MEAN_FREE_PATH_MM, REFLECTANCE_AT_NORMAL, SURFACE_ALBEDO, Scene, Texel, block, medium, quad, skin, sphere,
};

/// Share of the light that a surface lets in at a cosine under `coupling: Entry`.
fn entering(cosine: f64) -> f64 {
    1.0 - REFLECTANCE_AT_NORMAL - (1.0 - REFLECTANCE_AT_NORMAL) * (1.0 - cosine).powi(5)
}

fn slabs() -> [Slab; 3] {
    [0, 1, 2].map(|channel: usize| {
        Slab::new(Medium::new(SURFACE_ALBEDO[channel], MEAN_FREE_PATH_MM[channel]).expect("in the domain"))
    })
}

fn slab_law(thickness_mm: f64) -> [f64; 3] {
    slabs().map(|slab| slab.transmittance(thickness_mm))
}

fn slab_reflection(thickness_mm: f64) -> [f64; 3] {
    slabs().map(|slab| slab.reflectance(thickness_mm))
}

fn profile_law(thickness_mm: f64) -> [f64; 3] {
    let model = Model::published("two_exponential_dipole_searchlight").expect("it is published");
    Channel::ALL.map(|channel| {
        let index = channel.index();
        let medium = Medium::new(SURFACE_ALBEDO[index], MEAN_FREE_PATH_MM[index]).expect("in the domain");
        model.profile(medium, channel).expect("in the domain").transmittance(thickness_mm)
    })
}

/// A law of transmittance, and the fields that choose it.
type Law = (&'static str, fn(f64) -> [f64; 3]);

const LAWS: [Law; 2] = [("", slab_law), ("transmittance: Profile", profile_law)];

/// Largest relative difference of what comes through from a law, over the channels that let some through.
fn off(found: Texel, cosine: f64, through: [f64; 3]) -> f64 {
    let expected = through.map(|through| cosine * entering(cosine) * through);
    let differences = expected.iter().zip(found).map(|(expected, found)| {
        // Of what half floats hold, and of what the eye does.
        (found - expected).abs() / expected.max(1e-3)
    });
    differences.fold(0.0, f64::max)
}

#[test]
fn a_slab_lets_through_what_its_law_says_whatever_the_angle_and_the_scene() {
    let gpu = Gpu::open();
    let mut worst = (0.0, String::new());
    for (fields, law) in LAWS {
        for thickness_mm in [0.3, 0.6, 1.0, 2.0, 4.0, 8.0] {
            let slab = block([0.15, 0.15, 0.5e-3 * thickness_mm as f32]);
            let mut scene = Scene::new(&gpu, &skin(fields), &[slab]);
            for radius in [0.22, 0.5, 3.0, 10.0] {
                for degrees in [0.0, 30.0, 45.0, 60.0, 75.0_f64] {
                    // Around the axis as well: no row of the map is along the slope.
                    let (sin, cos) = degrees.to_radians().sin_cos();
                    let towards_light = [0.8 * sin, 0.6 * sin, -cos];
                    let bounds = Bounds::new([0.3 * radius, -0.2 * radius, 0.1 * radius], radius);
                    let [_, found] = scene.middle(towards_light, bounds);
                    let off = off(found, cos, law(thickness_mm));
                    if off > worst.0 {
                        worst = (
                            off,
                            format!("{thickness_mm} mm at {degrees}°, {radius} m, {fields}: {found:?}"),
                        );
                    }
                }
            }
        }
    }
    println!("{:.4}: {}", worst.0, worst.1);
    // Half floats are good to 5e-4; depths of a map of 20 m to a micrometre, which is 0.3 % of the thinnest slab's loss.
    assert!(worst.0 < 0.02, "off by {:.4}: {}", worst.0, worst.1);
}

#[test]
fn a_sphere_lets_through_its_diameter_at_the_antipode() {
    let gpu = Gpu::open();
    for radius_mm in [1.0, 2.0, 4.0] {
        let mut scene = Scene::new(&gpu, &skin(""), &[sphere(1e-3 * radius_mm as f32)]);
        let bounds = Bounds::new([0.0; 3], 0.02);
        let [_, found] = scene.middle([0.0, 0.0, -1.0], bounds);
        let off = off(found, 1.0, slab_law(2.0 * radius_mm));
        println!("{radius_mm} mm: {off:.4}");
        // The mean over a disc of 0.3 mm, beside whose middle a sphere is thinner.
        assert!(off < 0.02, "{radius_mm} mm: {off:.4}");
    }
}

#[test]
fn what_stands_elsewhere_changes_nothing() {
    let gpu = Gpu::open();
    let slab = || block([0.05, 0.05, 1e-3]);
    let towards_light = [0.4, -0.3, -(1.0 - 0.25_f64).sqrt()];
    for (away, radius) in [(0.5, 0.4), (3.0, 1.7), (10.0, 5.2)] {
        let (mut other, indices) = block([0.02; 3]);
        for vertex in &mut other {
            vertex.position[0] += away;
        }
        let mut scene = Scene::new(&gpu, &skin(""), &[slab(), (other, indices)]);
        let [_, found] = scene.middle(towards_light, Bounds::new([0.5 * away, 0.0, 0.0], radius));
        let off = off(found, -towards_light[2], slab_law(2.0));
        assert!(off < 0.02, "another object {away} m away: {off:.4}");
    }
}

#[test]
fn what_stands_before_the_light_darkens() {
    let gpu = Gpu::open();
    let (mut screen, indices) = block([0.05, 0.05, 1e-3]);
    for vertex in &mut screen {
        vertex.position[2] -= 0.05;
    }
    let mut scene = Scene::new(&gpu, &skin(""), &[block([0.05, 0.05, 1e-3]), (screen, indices)]);
    let [_, found] = scene.middle([0.0, 0.0, -1.0], Bounds::new([0.0; 3], 0.2));
    // From the screen's lit face on, all counts as skin: 52 mm.
    let through = slab_law(52.0).map(|through| entering(1.0) * through);
    assert!((found[0] - through[0]).abs() < 1e-4 && found[0] < 5e-3, "{found:?}, {through:?}");
}

#[test]
fn a_sheet_sends_back_and_lets_through_what_a_slab_does() {
    let gpu = Gpu::open();
    const THICKNESS_MM: f64 = 0.25;
    let mut scene = Scene::new(&gpu, &skin(&format!("thin: (thickness_mm: {THICKNESS_MM})")), &[quad()]);
    let bounds = Bounds::new([0.0; 3], 0.1);
    for degrees in [0.0, 40.0, 70.0_f64] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        // As much from behind as through a slab, and nothing enters in front.
        let [irradiance, found] = scene.middle([sin, 0.0, -cos], bounds);
        let through = off(found, cos, slab_law(THICKNESS_MM));
        assert!(through < 2e-3 && irradiance[..3] == [0.0; 3], "{degrees}°: {through}, {irradiance:?}");
        // From in front, as much as a surface lets in; what is sent back of it stands in its surface albedo.
        let [irradiance, _] = scene.middle([sin, 0.0, cos], bounds);
        let entered = irradiance[0] / (PI * cos * entering(cos));
        assert!((entered - 1.0).abs() < 2e-3, "{degrees}°: {irradiance:?}");
        let targets = scene.renderer.targets().expect("resized");
        let sheet = scene.texel(&targets.surface);
        for (channel, sent_back) in slab_reflection(THICKNESS_MM).into_iter().enumerate() {
            assert!((sheet[channel] / sent_back - 1.0).abs() < 2e-3, "{sheet:?}, {sent_back} in {channel}");
        }
        // It has no material whose light diffuses.
        assert_eq!(sheet[3], -1.0);
    }
}

/// The direction of a light behind a slab, at an angle from its normal.
fn behind(degrees: f64) -> [f64; 3] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [sin, 0.0, -cos]
}

#[test]
fn light_that_comes_through_remembers_no_angle_but_how_it_entered_and_leaves() {
    let gpu = Gpu::open();
    let slab = block([0.15, 0.15, 2e-3]);
    let mut scene =
        Scene::new(&gpu, &medium("specular: (reflectance_at_normal: 0, coupling: None)"), &[slab]);
    for degrees in [0.0, 30.0, 60.0, 75.0_f64] {
        let cosine = degrees.to_radians().cos();
        let [_, found] = scene.middle(behind(degrees), Bounds::new([0.0; 3], 0.25));
        for (channel, through) in slab_law(4.0).into_iter().enumerate() {
            let half_space = HalfSpace::of(Entry::Searchlight, SURFACE_ALBEDO[channel]);
            let angles = half_space.through_entry(cosine) * half_space.through_exit(1.0);
            let expected = cosine * through * angles;
            // What the law itself is held to.
            assert!((found[channel] / expected - 1.0).abs() < 0.02, "{degrees}°: {found:?}, {expected}");
        }
    }
}

#[test]
fn diffusing_what_comes_through_changes_nothing_where_all_is_alike() {
    let gpu = Gpu::open();
    for fields in
        ["specular: (reflectance_at_normal: 0)", "", "diffuse: Lambert", "surface_albedo: (0.5, 0.3, 0.0)"]
    {
        let fields = |more: &str| {
            let (own, others) =
                if fields.starts_with("surface_albedo") { (fields, "") } else { ("", fields) };
            let text = medium(&format!("{others}{}{more}", if others.is_empty() { "" } else { ", " }));
            if own.is_empty() { text } else { text.replace("surface_albedo: (0.83, 0.64, 0.55)", own) }
        };
        let picture = |text: &str| {
            let mut scene = Scene::new(&gpu, text, &[block([0.15, 0.15, 2e-3])]);
            let light = DirectionalLight { direction: behind(40.0).map(|x| -x as f32), ..Default::default() };
            let [irradiance, _, picture] = scene.lit(&[light.into()], 0.0, Bounds::new([0.0; 3], 0.25));
            (irradiance[0], picture)
        };
        let (_, direct) = picture(&fields(""));
        let (entered, diffused) = picture(&fields("transmission: (diffused: true)"));
        assert!(entered > 0.01, "nothing went into the irradiance");
        for (channel, (direct, diffused)) in direct.into_iter().zip(diffused).take(3).enumerate() {
            // Half floats on both ways.
            assert!((direct - diffused).abs() < 3e-3 * direct + 1e-4, "{channel}: {direct}, {diffused}");
        }
    }
}

#[test]
fn a_medium_given_by_its_coefficients_lets_through_what_they_say() {
    let gpu = Gpu::open();
    let material = "Material(profile: \"two_exponential_dipole_searchlight\", transmittance: Slab, diffuse: Lambert, \
                    specular: (coupling: None), medium: (reduced_scattering_per_mm: (1.09, 1.59, 1.79), \
                    absorption_per_mm: (0.013, 0.07, 0.145), refractive_index: 1.3))";
    let mut scene = Scene::new(&gpu, material, &[block([0.15, 0.15, 1e-3])]);
    let [_, found] = scene.middle(behind(0.0), Bounds::new([0.0; 3], 0.25));
    for (channel, (scattering, absorption)) in
        [(1.09, 0.013), (1.59, 0.07), (1.79, 0.145_f64)].into_iter().enumerate()
    {
        let (extinction, alpha) = (scattering + absorption, scattering / (scattering + absorption));
        // The slab's law is for a medium without a boundary.
        let matched = to_surface_albedo(Entry::Searchlight, alpha);
        let law =
            Slab::new(Medium::new(matched, 1.0 / extinction).expect("in the domain")).transmittance(2.0);
        assert!((found[channel] / law - 1.0).abs() < 0.02, "{channel}: {found:?}, not {law}");
    }
}

#[test]
fn a_lamp_behind_a_slab_is_as_near_as_the_face_that_it_lights() {
    let gpu = Gpu::open();
    let mut scene = Scene::new(&gpu, &skin(""), &[block([0.05, 0.05, 2e-3])]);
    // 18 mm from the face behind, 22 from the one in view.
    let lamp = PointLight { position: [0.0, 0.0, -0.02], intensity: [1e-3; 3], radius_mm: 0.0 };
    let [_, found, _] = scene.lit(&[lamp.into()], 0.0, Bounds::new([0.0; 3], 0.08));
    for (channel, through) in slab_law(4.0).into_iter().enumerate() {
        let expected = 1e-3 / 0.018_f64.powi(2) * through * entering(1.0) / PI;
        // The mean over a disc, beside whose middle the way is longer.
        assert!((found[channel] / expected - 1.0).abs() < 0.03, "{channel}: {found:?}, not {expected}");
    }
}

#[test]
fn a_rim_lets_in_light_by_the_face_that_is_turned_to_it() {
    let gpu = Gpu::open();
    let (mut vertices, indices) = block([0.03, 0.03, 5e-3]);
    // The middle of the frame is 3 mm from the face towards −x.
    for vertex in &mut vertices {
        vertex.position[0] += 0.027;
    }
    for degrees in [60.0, 70.0, 80.0_f64] {
        let mut scene = Scene::new(&gpu, &skin(""), &[(vertices.clone(), indices.clone())]);
        let (sin, cos) = degrees.to_radians().sin_cos();
        let [_, found] = scene.middle([-sin, 0.0, -cos], Bounds::new([0.027, 0.0, 0.0], 0.05));
        // Perpendicular faces: along the light, and by the mean of both cosines.
        let cosine = (sin * cos).sqrt();
        for (channel, through) in slab_law(3.0 / sin).into_iter().enumerate() {
            let expected = cosine * entering(cosine) * through;
            // The mean over a disc of 0.3 mm, moved in by half of it: a tenth of the way.
            assert!((found[channel] / expected - 1.0).abs() < 0.05, "{degrees}°: {found:?}, not {expected}");
        }
    }
}
