// uses: kernel/constants, lib/angle, light/fresnel

// Torrance–Sparrow in the form of Karis 2013, "Real Shading in Unreal Engine 4": GGX, Smith with Schlick's
// approximation, Schlick's Fresnel term.

/// GGX distribution of normals, Walter et al. 2007 eq. (33), α = roughness².
fn ggx_distribution(normal_dot_half: f32, roughness: f32) -> f32 {
    let alpha2 = roughness * roughness * roughness * roughness;
    let t = normal_dot_half * normal_dot_half * (alpha2 - 1.0) + 1.0;
    return alpha2 / (PI * t * t);
}

/// Smith–Schlick shadowing and masking over 4 (n·l)(n·v), Karis 2013 eq. (4), with its k = (roughness + 1)² / 8.
fn smith_schlick_visibility(normal_dot_light: f32, normal_dot_view: f32, roughness: f32) -> f32 {
    let k = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    let light = normal_dot_light * (1.0 - k) + k;
    let view = normal_dot_view * (1.0 - k) + k;
    return 0.25 / (light * view);
}

/// Specular BRDF times n·l, sr⁻¹. Directions are unit vectors that leave the surface.
fn specular_reflection(normal: vec3f, light: vec3f, view: vec3f, reflectance_at_normal: f32, roughness: f32) -> f32 {
    let normal_dot_light = dot(normal, light);
    if normal_dot_light <= 0.0 {
        return 0.0;
    }
    let normal_dot_view = max(dot(normal, view), LEAST_VIEW_COSINE);
    let half_vector = normalize(light + view);
    let distribution = ggx_distribution(max(dot(normal, half_vector), 0.0), max(roughness, LEAST_ROUGHNESS));
    let visibility = smith_schlick_visibility(normal_dot_light, normal_dot_view, roughness);
    return distribution
        * visibility
        * fresnel_schlick(reflectance_at_normal, dot(view, half_vector))
        * normal_dot_light;
}
