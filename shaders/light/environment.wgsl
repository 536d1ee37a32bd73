// uses: lib/angle

/// Light from far away all around: its irradiance as nine coefficients, its reflections as a texture.
struct Environment {
    /// Irradiance on a surface by its normal: coefficients of real spherical harmonics up to the second order, times
    /// the cosine's own (Ramamoorthi and Hanrahan 2001) and the harmonics' constants. Red, green, blue.
    irradiance: array<vec4f, 9>,
    /// Levels of the texture: from a mirror's to that of a roughness of 1.
    levels: f32,
    /// Turn about the y axis, in turns.
    turn: f32,
    /// Factor on all of it: 0 for none.
    intensity: f32,
}

/// Irradiance on a surface with this normal.
fn environment_irradiance(environment: Environment, normal: vec3f) -> vec3f {
    let angle = TAU * environment.turn;
    let n = vec3f(
        normal.x * cos(angle) + normal.z * sin(angle),
        normal.y,
        normal.z * cos(angle) - normal.x * sin(angle),
    );
    let c = environment.irradiance;
    let sum = c[0]
        + c[1] * n.y + c[2] * n.z + c[3] * n.x
        + c[4] * (n.x * n.y) + c[5] * (n.y * n.z) + c[6] * (3.0 * n.z * n.z - 1.0)
        + c[7] * (n.x * n.z) + c[8] * (n.x * n.x - n.y * n.y);
    // The coefficients keep it from falling below 0, but for rounding.
    return environment.intensity * max(sum.rgb, vec3f(0.0));
}

/// Radiance that a lobe of this roughness gathers about a direction, over what it sends back.
fn environment_reflection(
    radiance: texture_2d<f32>,
    linear: sampler,
    environment: Environment,
    direction: vec3f,
    roughness: f32,
) -> vec3f {
    // The middle of the image is towards −z, and its right towards +x.
    let longitude = atan2(direction.x, -direction.z) / TAU + 0.5 - environment.turn;
    let latitude = acos(clamp(direction.y, -1.0, 1.0)) / PI;
    let level = roughness * (environment.levels - 1.0);
    return environment.intensity * textureSampleLevel(radiance, linear, vec2f(longitude, latitude), level).rgb;
}
