// uses: kernel/constants, lib/half_space, profile/constants

// Diffuse light by the angles at which it enters and leaves a medium: a profile is for one way of entry, and light that
// enters at a slant returns more.

/// What the angles of a pixel share.
struct MediumAngles {
    /// One of the `DIFFUSE_…` constants.
    diffuse: u32,
    /// 1/η²: cosines are those below a boundary of that index.
    inverse_square: f32,
    /// γ per channel.
    root: vec3f,
    /// The cosine at which light leaves, below the boundary.
    leaving: f32,
    /// Of light from everywhere, over what the profile is normalized by.
    ambient_entry: vec3f,
    /// Without a boundary, what `medium_entry` divides by the sum of cosines and more; below one, what the albedos by
    /// angle are multiplied by for their mean: channels differ by some percent there, and all have the mean.
    numerator: vec3f,
    /// Radiance that leaves over Lambert's below a boundary.
    exit_share: f32,
    /// Radiance over Lambert's of light that came through, over H at perpendicular entry; 1 below a boundary.
    through: vec3f,
}

/// 1/η² of the boundary whose reflectance at normal incidence is F₀ = ((η − 1)/(η + 1))².
fn inverse_square_index(reflectance_at_normal: f32) -> f32 {
    let root = sqrt(clamp(reflectance_at_normal, 0.0, 1.0));
    let inverse = (1.0 - root) / (1.0 + root);
    return inverse * inverse;
}

/// The angles of a medium whose light leaves at a cosine, through a boundary that reflects F₀; `coefficients` are those
/// of its root below it.
fn medium_angles(
    diffuse: u32,
    coefficients: vec3f,
    surface_albedo: vec3f,
    reflectance_at_normal: f32,
    leaving: f32,
) -> MediumAngles {
    let inverse_square = inverse_square_index(reflectance_at_normal);
    let root = half_space_roots(coefficients, surface_albedo);
    let below = refracted_cosine(leaving, inverse_square);
    let u_at_normal = half_space_u(1.0, root);
    let at_normal = relative_half_space_albedo(u_at_normal, root);
    let everywhere = relative_diffuse_albedo_below(root, inverse_square);
    let of_profile = select(everywhere, at_normal, diffuse == DIFFUSE_SEARCHLIGHT);
    let u = half_space_u(below, root);
    let is_matched = inverse_square >= 1.0;
    let pairing = (1.0 + root) * everywhere / (4.0 * u);
    let numerator = select(1.0 / (3.0 * everywhere), pairing / of_profile, is_matched);
    let exit = dot(relative_half_space_albedo(u, root), numerator);
    let exit_share = select(exit, 1.0, is_matched || diffuse == DIFFUSE_LAMBERT);
    let through = half_space_h(u, root) * inverse_mean_h(root) / half_space_h(u_at_normal, root);
    let is_lambert = !is_matched || diffuse == DIFFUSE_LAMBERT;
    return MediumAngles(
        diffuse,
        inverse_square,
        root,
        below,
        everywhere / of_profile,
        numerator,
        exit_share,
        select(through, vec3f(1.0), is_lambert),
    );
}

/// A direction in which light enters.
struct EnteringAngles {
    /// Its cosine below the boundary.
    below: f32,
    /// u and H of the medium there.
    u: vec3f,
    h: vec3f,
}

/// Surface albedo of the medium without a boundary, under perpendicular light.
fn matched_albedo(medium: MediumAngles) -> vec3f {
    let u = half_space_u(1.0, medium.root);
    return (1.0 - medium.root) * relative_half_space_albedo(u, medium.root);
}

/// The angles of light that enters at a cosine.
fn entering_angles(medium: MediumAngles, cosine: f32) -> EnteringAngles {
    let below = refracted_cosine(cosine, medium.inverse_square);
    let u = half_space_u(below, medium.root);
    return EnteringAngles(below, u, half_space_h(u, medium.root));
}

/// Light that enters so and leaves at the medium's cosine, over what the profile and `exit_of` say: A(μ)/A(1), or
/// A(μ)/Ā. Without a boundary, of pairs of angles also what lies in no product of the two,
///
///     α H(μ) H(μᵥ)/(4π (μ + μᵥ)) over A(μ) A(μᵥ)/(π Ā)
///
/// of which light that was scattered once has the most (Chandrasekhar 1960, "Radiative Transfer"). It stands in the
/// irradiance, so that this depends on the viewer. Below a boundary cosines are close to 1, and pairs alike.
fn medium_entry(medium: MediumAngles, entering: EnteringAngles) -> vec3f {
    if medium.diffuse == DIFFUSE_LAMBERT {
        return vec3f(1.0);
    }
    if medium.inverse_square >= 1.0 {
        return medium.numerator * entering.h / (max(entering.below, LEAST_COSINE) + medium.leaving);
    }
    return medium.ambient_entry * dot(entering.u * entering.h, medium.numerator);
}

/// Light that enters so on the far side and comes through, over what does at perpendicular entry and leaves as
/// Lambert's: H(μ)/H(1) · H(μᵥ)/⟨H⟩, as of light that was scattered often (the Milne problem; Chandrasekhar 1960).
/// Below a boundary 1.
fn medium_through(medium: MediumAngles, entering: EnteringAngles) -> vec3f {
    let is_lambert = medium.inverse_square < 1.0 || medium.diffuse == DIFFUSE_LAMBERT;
    return medium.through * select(entering.h, vec3f(1.0), is_lambert);
}

/// `medium_through` of light that enters from everywhere alike: the mean of H is ⟨H⟩.
fn medium_ambient_through(medium: MediumAngles) -> vec3f {
    let is_lambert = medium.inverse_square < 1.0 || medium.diffuse == DIFFUSE_LAMBERT;
    return medium.through / select(inverse_mean_h(medium.root), vec3f(1.0), is_lambert);
}

/// `medium_entry` of light that enters from everywhere alike.
fn medium_ambient_entry(medium: MediumAngles) -> vec3f {
    return select(medium.ambient_entry, vec3f(1.0), medium.diffuse == DIFFUSE_LAMBERT);
}

/// Radiance that leaves over Lambert's of what entered on this side: what the composite multiplies by, `exit_of` and
/// `exit_share` together.
fn medium_exit(medium: MediumAngles) -> vec3f {
    if medium.diffuse == DIFFUSE_LAMBERT || medium.inverse_square < 1.0 {
        return vec3f(medium.exit_share);
    }
    let u = half_space_u(medium.leaving, medium.root);
    return relative_half_space_albedo(u, medium.root) / relative_diffuse_albedo(medium.root);
}

// A pixel's `diffuse` and the cosine at which its light leaves, as one number that a half float holds: 1 for Lambert's,
// else the number of the lobe and the cosine. What leaves through a boundary is Lambert's times `exit_share`.

/// Least cosine that the number holds.
const LEAST_EXIT_COSINE: f32 = 1.0 / 256.0;

/// The number of a medium.
fn pack_exit(medium: MediumAngles) -> f32 {
    if medium.diffuse == DIFFUSE_LAMBERT || medium.inverse_square < 1.0 {
        return 1.0;
    }
    return f32(medium.diffuse) + clamp(medium.leaving, LEAST_EXIT_COSINE, 1.0);
}

/// Radiance over Lambert's of a pixel with that number: A(μᵥ)/Ā.
fn exit_of(packed: f32, surface_albedo: vec3f) -> vec3f {
    if packed <= 1.0 {
        return vec3f(1.0);
    }
    let diffuse = u32(ceil(packed)) - 1u;
    let c = select(SEARCHLIGHT_ALBEDO, DIFFUSE_ALBEDO, diffuse == DIFFUSE_EVERYWHERE);
    let root = half_space_roots(c, surface_albedo);
    let u = half_space_u(packed - f32(diffuse), root);
    return relative_half_space_albedo(u, root) / relative_diffuse_albedo(root);
}
