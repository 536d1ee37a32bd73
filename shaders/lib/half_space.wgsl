// uses: profile/constants

// A flat medium without end that scatters isotropically, by the angle at which light enters or leaves: Chandrasekhar's
// A(μ) = 1 − γ H(μ), γ = √(1 − α), with
//
//     1/H(μ) = γ + (1 − γ) u,   u = 1 − μ (p₀ + (p₁ + p₂ μ) ln(1 + 1/μ)),   A(μ) = (1 − γ) u/(γ + (1 − γ) u)
//
// the form of Hapke 2002 with coefficients of our own fit. Shares are over 1 − γ, which leaves them finite at A = 0.

/// Least cosine: there ln(1 + 1/μ) is 9, and μ times it less than what half floats hold.
const LEAST_COSINE: f32 = 1e-4;

/// γ of media with these surface albedos: (1 − A)(1 + c₁A)/(1 + c₂A + c₃A²).
fn half_space_roots(coefficients: vec3f, surface_albedo: vec3f) -> vec3f {
    let c = coefficients;
    let a = clamp(surface_albedo, vec3f(0.0), vec3f(1.0));
    return (1.0 - a) * (1.0 + c.x * a) / (1.0 + (c.y + c.z * a) * a);
}

/// γ of media without a boundary with these surface albedos in light from everywhere.
fn diffuse_half_space_roots(surface_albedo: vec3f) -> vec3f {
    return half_space_roots(DIFFUSE_ALBEDO, surface_albedo);
}

/// u.
fn half_space_u(cosine: f32, root: vec3f) -> vec3f {
    let mu = max(cosine, LEAST_COSINE);
    let lost = 1.0 - root;
    let p0 = lost * (HALF_SPACE_ANGLES.x + (HALF_SPACE_SLOPES.x + HALF_SPACE_BENDS.x * root) * root);
    let p1 = lost * (HALF_SPACE_ANGLES.y + (HALF_SPACE_SLOPES.y + HALF_SPACE_BENDS.y * root) * root) + 1.0;
    let p2 = lost * (HALF_SPACE_ANGLES.z + (HALF_SPACE_SLOPES.z + HALF_SPACE_BENDS.z * root) * root);
    return 1.0 - mu * (p0 + (p1 + mu * p2) * log(1.0 + 1.0 / mu));
}

/// A(μ)/(1 − γ) for that u.
fn relative_half_space_albedo(u: vec3f, root: vec3f) -> vec3f {
    return u / (root + (1.0 - root) * u);
}

/// Ā/(1 − γ), of light that enters from everywhere alike.
fn relative_diffuse_albedo(root: vec3f) -> vec3f {
    let c = DIFFUSE_ALBEDO;
    let linear = 1.0 - c.x + c.y * root;
    return 2.0 / (linear + sqrt(linear * linear + 4.0 * (c.x + c.z * root) * (1.0 - root)));
}

/// H(μ) for that u.
fn half_space_h(u: vec3f, root: vec3f) -> vec3f {
    return 1.0 / (root + (1.0 - root) * u);
}

/// Light from everywhere alike that a convex body returns, over what a flat one does: in a ball of radius 1/H diffusion
/// has for γ what a half-space has for γ (coth x − 1/x), x = 1/(H ℓ_d), ℓ_d = ℓ √((1 + γ²)/3)/γ. Below a boundary total
/// reflection returns 1 − 1/η² of what would leave. Light that was scattered once knows nothing of that: the gain
/// counts by α. `curvature` is H ℓ, 0 and less for what is flat.
fn convex_gain(root: vec3f, inverse_square: f32, curvature: vec3f) -> vec3f {
    let x = root * sqrt(3.0) / (max(curvature, vec3f(1e-6)) * sqrt(1.0 + root * root));
    // coth x − 1/x; x/3 where their difference would round.
    let far = clamp(x, vec3f(0.05), vec3f(1e6));
    let langevin = select(1.0 / tanh(min(far, vec3f(20.0))) - 1.0 / far, x / 3.0, x < vec3f(0.05));
    let curved = root * langevin;
    let flat_albedo = relative_diffuse_albedo(root);
    let curved_albedo = (1.0 - curved) * relative_diffuse_albedo(curved);
    let kept = 1.0 - inverse_square;
    let flat_leaving = max(1.0 - kept * (1.0 - root) * flat_albedo, vec3f(1e-6));
    let leaving = flat_leaving / max(1.0 - kept * curved_albedo, vec3f(1e-6));
    let gain = root * root + (1.0 + root) * curved_albedo / flat_albedo * leaving;
    return select(vec3f(1.0), gain, curvature > vec3f(1e-6));
}

/// Cosine of the light where what leaves a convex body at a point has entered it, by channel. Light goes on for a mean
/// free path as it came (Wang and Jacques 1995), and as far towards the viewer before it leaves; in between the normal
/// turns by the curvature,
///
///     μ + H ℓ (|l_t|² − l_t·v_t)/η,
///
/// l_t and v_t the parts of both directions along the surface. `curvature` is H ℓ, `towards` l·v.
fn convex_cosine(curvature: vec3f, inverse_square: f32, cosine: f32, view_cosine: f32, towards: f32) -> vec3f {
    let turn = 1.0 - cosine * cosine - (towards - cosine * view_cosine);
    let shift = sqrt(inverse_square) * curvature;
    // It sets in at the terminator, where no light has entered yet.
    let set_in = clamp(cosine / max(shift, vec3f(1e-6)), vec3f(0.0), vec3f(1.0));
    return max(vec3f(cosine) + set_in * shift * turn, vec3f(0.0));
}

/// 1/⟨H⟩, ⟨H⟩ = 2 ∫ H(μ) μ dμ.
fn inverse_mean_h(root: vec3f) -> vec3f {
    let c = HALF_SPACE_MEAN;
    return root + (1.0 - root) * (c.x + (c.y + c.z * root) * root);
}

/// Cosine below a boundary of light that crosses it at a cosine; `inverse_square` is 1/η².
fn refracted_cosine(cosine: f32, inverse_square: f32) -> f32 {
    return sqrt(1.0 - (1.0 - cosine * cosine) * inverse_square);
}

/// Ā/(1 − γ) of light from everywhere that crosses a boundary: 2 ∫ A(μ′) μ dμ, an integral over μ² by two points. Below
/// a boundary angles are few, and these are within 3e-3 from η = 1.1 on.
fn relative_diffuse_albedo_below(root: vec3f, inverse_square: f32) -> vec3f {
    if inverse_square >= 1.0 {
        return relative_diffuse_albedo(root);
    }
    let steep = refracted_cosine(sqrt(0.5 + 0.5 / sqrt(3.0)), inverse_square);
    let slant = refracted_cosine(sqrt(0.5 - 0.5 / sqrt(3.0)), inverse_square);
    return 0.5
        * (relative_half_space_albedo(half_space_u(steep, root), root)
            + relative_half_space_albedo(half_space_u(slant, root), root));
}
