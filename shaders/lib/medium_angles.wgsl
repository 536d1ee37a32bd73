// uses: kernel/constants, lib/half_space

// Diffuse light by the angles at which it enters and leaves a medium: a profile is for one way of entry, and light that
// enters at a slant returns more.

/// What the angles of a pixel share, of its material's `diffuse`, surface albedo and the cosine at which light leaves.
struct MediumAngles {
    /// One of the `DIFFUSE_…` constants.
    diffuse: u32,
    /// γ per channel.
    root: vec3f,
    /// Cosine at which light leaves, and u there.
    leaving: f32,
    leaving_u: vec3f,
}

/// The angles of a medium whose light leaves at a cosine.
fn medium_angles(diffuse: u32, surface_albedo: vec3f, leaving: f32) -> MediumAngles {
    let root = half_space_roots(diffuse == DIFFUSE_EVERYWHERE, surface_albedo);
    return MediumAngles(diffuse, root, leaving, half_space_u(leaving, root));
}

/// Albedo/(1 − γ) that the profile is normalized by.
fn relative_albedo_of_profile(medium: MediumAngles) -> vec3f {
    if medium.diffuse == DIFFUSE_SEARCHLIGHT {
        return relative_half_space_albedo(half_space_u(1.0, medium.root), medium.root);
    }
    return relative_diffuse_albedo(medium.root);
}

/// Light that enters at this cosine and leaves at the medium's, over what the profile and `medium_exit` say:
/// A(μ)/A(1), or A(μ)/Ā, and of pairs of angles what lies in no product of the two,
///
///     α H(μ) H(μᵥ)/(4π (μ + μᵥ)) over A(μ) A(μᵥ)/(π Ā)
///
/// which is light that was scattered once: Chandrasekhar 1960, "Radiative Transfer".
fn medium_entry(medium: MediumAngles, cosine: f32) -> vec3f {
    if medium.diffuse == DIFFUSE_LAMBERT {
        return vec3f(1.0);
    }
    let u = half_space_u(cosine, medium.root);
    let entry = relative_half_space_albedo(u, medium.root) / relative_albedo_of_profile(medium);
    let spread = 4.0 * (max(cosine, LEAST_COSINE) + medium.leaving) * u * medium.leaving_u;
    return entry * (1.0 + medium.root) * relative_diffuse_albedo(medium.root) / spread;
}

/// The same of light that enters from everywhere alike.
fn medium_ambient_entry(medium: MediumAngles) -> vec3f {
    if medium.diffuse == DIFFUSE_LAMBERT {
        return vec3f(1.0);
    }
    return relative_diffuse_albedo(medium.root) / relative_albedo_of_profile(medium);
}

/// Radiance that leaves over Lambert's: A(μᵥ)/Ā.
fn medium_exit(medium: MediumAngles) -> vec3f {
    if medium.diffuse == DIFFUSE_LAMBERT {
        return vec3f(1.0);
    }
    return relative_half_space_albedo(medium.leaving_u, medium.root) / relative_diffuse_albedo(medium.root);
}

// A pixel's `diffuse` and the cosine at which its light leaves, as one number that a half float holds: 1 for Lambert's,
// else the number of the lobe and the cosine.

/// Least cosine that the number holds.
const LEAST_EXIT_COSINE: f32 = 1.0 / 256.0;

/// The number of a lobe and a cosine.
fn pack_exit(diffuse: u32, cosine: f32) -> f32 {
    if diffuse == DIFFUSE_LAMBERT {
        return 1.0;
    }
    return f32(diffuse) + clamp(cosine, LEAST_EXIT_COSINE, 1.0);
}

/// Radiance over Lambert's of a pixel with that number.
fn exit_of(packed: f32, surface_albedo: vec3f) -> vec3f {
    if packed <= 1.0 {
        return vec3f(1.0);
    }
    let diffuse = u32(ceil(packed)) - 1u;
    return medium_exit(medium_angles(diffuse, surface_albedo, packed - f32(diffuse)));
}
