// uses: kernel/constants, lib/half_space

// Diffuse light by the angles at which it enters and leaves a medium: a profile is for one way of entry, and light that
// enters at a slant returns more.

/// What the angles of a pixel share, of its material's `diffuse` and surface albedo.
struct MediumAngles {
    /// One of the `DIFFUSE_…` constants.
    diffuse: u32,
    /// γ per channel.
    root: vec3f,
}

/// The angles of a medium.
fn medium_angles(diffuse: u32, surface_albedo: vec3f) -> MediumAngles {
    return MediumAngles(diffuse, half_space_roots(diffuse == DIFFUSE_EVERYWHERE, surface_albedo));
}

/// Albedo/(1 − γ) that the profile is normalized by.
fn relative_albedo_of_profile(medium: MediumAngles) -> vec3f {
    if medium.diffuse == DIFFUSE_SEARCHLIGHT {
        return relative_half_space_albedo(1.0, medium.root);
    }
    return relative_diffuse_albedo(medium.root);
}

/// Light that returns where it enters at this cosine, over what the profile is normalized by: A(μ)/A(1), or A(μ)/Ā.
fn medium_entry(medium: MediumAngles, cosine: f32) -> vec3f {
    if medium.diffuse == DIFFUSE_LAMBERT {
        return vec3f(1.0);
    }
    return relative_half_space_albedo(cosine, medium.root) / relative_albedo_of_profile(medium);
}

/// The same of light that enters from everywhere alike.
fn medium_ambient_entry(medium: MediumAngles) -> vec3f {
    if medium.diffuse == DIFFUSE_LAMBERT {
        return vec3f(1.0);
    }
    return relative_diffuse_albedo(medium.root) / relative_albedo_of_profile(medium);
}

/// Radiance that leaves at this cosine over Lambert's: A(μ)/Ā.
fn medium_exit(medium: MediumAngles, cosine: f32) -> vec3f {
    if medium.diffuse == DIFFUSE_LAMBERT {
        return vec3f(1.0);
    }
    return relative_half_space_albedo(cosine, medium.root) / relative_diffuse_albedo(medium.root);
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
    return medium_exit(medium_angles(diffuse, surface_albedo), packed - f32(diffuse));
}
