//! The half-space's albedo by angle against Chandrasekhar's H function.

use subsurface_profile::HalfSpace;
use subsurface_profile::single_scattering_albedo::{Entry, from_surface_albedo};
use subsurface_reference::chandrasekhar::h_function;

#[test]
fn albedos_by_angle_are_chandrasekhars() {
    for surface_albedo in (1..200).map(|step| f64::from(step) / 200.0) {
        let medium = HalfSpace::of(Entry::Searchlight, surface_albedo);
        // q = √(1 - α) of the very medium: what is tested is the angle, not the conversion.
        let q = (1.0 - from_surface_albedo(Entry::Searchlight, surface_albedo)).sqrt();
        for cosine in (0..=50).map(|step| 1e-3 + 0.999 * f64::from(step) / 50.0) {
            let exact = 1.0 - q * h_function(cosine, q);
            let off = (medium.albedo(cosine) / exact - 1.0).abs();
            // What `HalfSpace` says of itself.
            assert!(
                off < 3.1e-4,
                "A = {surface_albedo} at {cosine}: {} is not {exact}",
                medium.albedo(cosine)
            );
        }
    }
}
