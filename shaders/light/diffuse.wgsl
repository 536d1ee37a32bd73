// uses: light/fresnel

// Diffuse light: what the surface does not reflect enters it.

/// Irradiance that enters of what arrives at this cosine: Lambert · (1 − F).
fn entering_irradiance(arriving: vec3f, cosine: f32, reflectance_at_normal: f32) -> vec3f {
    return arriving * cosine * (1.0 - fresnel_schlick(reflectance_at_normal, cosine));
}

/// The same of an irradiance that comes from everywhere alike: what the specular lobe takes on average stays outside.
fn entering_ambient_irradiance(arriving: vec3f, reflectance_at_normal: f32) -> vec3f {
    return arriving * (1.0 - fresnel_schlick_mean(reflectance_at_normal));
}
