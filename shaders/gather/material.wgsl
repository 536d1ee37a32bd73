// uses: lib/numeric_limits

/// What every material has, whichever profile model it uses.
struct MaterialSurface {
    /// Length that scales the profile, per channel (red, green, blue), mm: the mean free path ℓ, or the diffuse mean
    /// free path for models that are parametrized by it.
    mean_free_path_mm: vec3f,
    /// Profile model: one of the `MODEL_…` constants.
    model: u32,
    /// Surface albedo A per channel where no texture overrides it, 0 to 1.
    surface_albedo: vec3f,
    /// Specular reflectance at normal incidence F₀, 0 to 1.
    reflectance_at_normal: f32,
    /// Mean free path by which the light of a slab falls, mm; below 0 where the profile says what comes through, and 0
    /// where it has lengths of its own.
    slab_mean_free_path_mm: vec3f,
    /// Thickness of a material that is a sheet, mm; 0 for one that fills what it bounds.
    thin_thickness_mm: f32,
    /// Roughness of the specular lobe (square root of the GGX α), 0 to 1.
    roughness: f32,
    /// How diffuse light knows of the specular lobe: one of the `COUPLING_…` constants.
    coupling: u32,
    /// How diffuse light depends on its angles: one of the `DIFFUSE_…` constants.
    diffuse: u32,
    /// c₁, c₂, c₃ of the root of 1 − α by the surface albedo, of a medium below the material's boundary.
    albedo_coefficients: vec3f,
    /// 1: the medium was given by its coefficients, and the surface albedo is that below the boundary.
    is_medium: u32,
    /// Numbers of the diffuse lobe.
    diffuse_shape: vec3f,
    /// Roughness of a second specular lobe, 0 to 1.
    second_roughness: f32,
    /// Its share of both lobes, 0 to 1.
    second_weight: f32,
    /// Factor on the light that comes through from the far side, 0 for none.
    transmission_strength: f32,
    /// 1: what comes through diffuses below the surface that it leaves by; 0: it leaves where it arrives.
    transmission_diffused: u32,
    /// Power of the surface albedo by which light is multiplied where it enters, 0 to 1; the rest where it leaves.
    surface_albedo_mix: f32,
    /// First row of the quantile curves of its profile in `profile_curves`.
    first_curve: u32,
    /// Number of its curves: one per node of the surface albedo, or one per channel.
    curve_count: u32,
    /// First row of the edge curves of its profile, behind which stand as many line curves; 0 where the kernel reads
    /// none.
    first_edge: u32,
    /// Distance from an edge, in lengths of the material, at which the edge curves end; 0 where the kernel reads none.
    edge_reach: f32,
}

/// The surface albedo that a texel of the surface texture gives, or the material's own where it is none.
fn texel_surface_albedo(texel: vec4f, surface: MaterialSurface) -> vec3f {
    return select(
        surface.surface_albedo,
        clamp(texel.rgb, vec3f(0.0), vec3f(1.0)),
        is_finite_rgb(texel.rgb),
    );
}
