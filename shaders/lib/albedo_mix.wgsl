// Texture and blur: light may be multiplied by a part of the surface albedo before it diffuses, and by the rest
// afterwards (d'Eon and Luebke 2007, "Advanced Techniques for Realistic Real-Time Skin Rendering").

/// A^mix, by which light is multiplied where it enters; 1 where the mix is 0.
fn albedo_before(surface_albedo: vec3f, mix: f32) -> vec3f {
    // The logarithm of 0 is none.
    let power = exp2(mix * log2(max(surface_albedo, vec3f(1e-30))));
    return select(select(power, vec3f(0.0), surface_albedo <= vec3f(0.0)), vec3f(1.0), mix <= 0.0);
}

/// A^(1 − mix), by which it is multiplied where it leaves.
fn albedo_after(surface_albedo: vec3f, mix: f32) -> vec3f {
    // A itself, to the last bit, where nothing came before.
    return select(albedo_before(surface_albedo, 1.0 - mix), surface_albedo, mix <= 0.0);
}
