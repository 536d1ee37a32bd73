// uses: kernel/constants, lib/{angle, half_space, medium_angles}

// Diffuse BRDFs f as f π/A: by how much light that enters at one angle and leaves at another differs from Lambert's.
// Each stands in the irradiance, so that this depends on the viewer.

/// A lobe at a point.
struct DiffuseLobe {
    /// One of the `DIFFUSE_…` constants.
    diffuse: u32,
    /// Its numbers.
    shape: vec3f,
    /// A.
    surface_albedo: vec3f,
    /// F₀ and roughness of the boundary above.
    reflectance_at_normal: f32,
    roughness: f32,
}

/// Whether it is that of a layer below the boundary, with refracted cosines.
fn diffuse_lobe_is_below(lobe: DiffuseLobe) -> bool {
    return lobe.diffuse == DIFFUSE_HANRAHAN_KRUEGER || lobe.shape.y < 0.0;
}

/// f π/A of light that enters from `light` and leaves to `view`, unit vectors away from the surface.
fn diffuse_lobe(lobe: DiffuseLobe, normal: vec3f, light: vec3f, view: vec3f) -> vec3f {
    let entering = max(dot(normal, light), 0.0);
    let leaving = max(dot(normal, view), LEAST_VIEW_COSINE);
    let towards = dot(light, view);
    if lobe.diffuse == DIFFUSE_SHIRLEY {
        return vec3f(shirley_lobe(lobe.reflectance_at_normal, entering, leaving));
    }
    if lobe.diffuse == DIFFUSE_OREN_NAYAR {
        return vec3f(oren_nayar_lobe(lobe.shape.x, entering, leaving, towards));
    }
    if lobe.diffuse == DIFFUSE_DISNEY {
        let half_cosine = dot(light, normalize(light + view));
        return vec3f(disney_lobe(lobe.shape.x, lobe.roughness, entering, leaving, half_cosine));
    }
    // Below a boundary f(μ_l′, μ_v′)/η² of refracted cosines (Hanrahan and Krueger 1993): its transmittances are those
    // of the coupling, and what it reflects inside is lost. A sign among its numbers says whether a lobe is there.
    let inverse_square = select(1.0, inverse_square_index(lobe.reflectance_at_normal), diffuse_lobe_is_below(lobe));
    let inside = vec2f(refracted_cosine(entering, inverse_square), refracted_cosine(leaving, inverse_square));
    let towards_inside = inside.x * inside.y + inverse_square * (towards - entering * leaving);
    if lobe.diffuse == DIFFUSE_LOMMEL_SEELIGER {
        return vec3f(inverse_square * lommel_seeliger_lobe(inside.x, inside.y));
    }
    if lobe.diffuse == DIFFUSE_HAPKE || lobe.diffuse == DIFFUSE_HANRAHAN_KRUEGER {
        let is_once = lobe.diffuse == DIFFUSE_HANRAHAN_KRUEGER;
        let value = hapke_lobe(lobe.shape, lobe.surface_albedo, inside.x, inside.y, towards_inside, is_once);
        return inverse_square * value;
    }
    return vec3f(1.0);
}

/// Heights of directions, and weights, that give means over the hemisphere of what is a polynomial of the cosine up to
/// the fifth power, each weighted by its cosine (Gauss and Jacobi).
const HEIGHTS: vec3f = vec3f(0.21234054, 0.59053314, 0.91141204);
const HEIGHT_WEIGHTS: vec3f = vec3f(0.13965396, 0.45848221, 0.40186383);

/// The mean over light from everywhere alike: three heights, four ways around.
fn diffuse_lobe_ambient(lobe: DiffuseLobe, normal: vec3f, view: vec3f) -> vec3f {
    let axis = select(vec3f(0.0, 1.0, 0.0), vec3f(1.0, 0.0, 0.0), abs(normal.y) > 0.9);
    let across = normalize(cross(normal, axis));
    let along = cross(normal, across);
    var sum = vec3f(0.0);
    for (var index = 0u; index < 12u; index += 1u) {
        let cosine = HEIGHTS[index / 4u];
        let sine = sqrt(1.0 - cosine * cosine);
        let angle = TAU * (f32(index % 4u) + 0.5 * f32(index / 4u)) / 4.0;
        let direction = cosine * normal + sine * (cos(angle) * across + sin(angle) * along);
        sum += HEIGHT_WEIGHTS[index / 4u] / 4.0 * diffuse_lobe(lobe, normal, direction, view);
    }
    return sum;
}

/// 21 (1 − F₀)/20 (1 − (1 − μ_l)⁵)(1 − (1 − μ_v)⁵): with the mirror of that F₀, as much leaves as arrives (Shirley et
/// al. 1997; Real-Time Rendering 4, eq. 9.64, corrected).
fn shirley_lobe(reflectance_at_normal: f32, entering: f32, leaving: f32) -> f32 {
    let grazing = vec2f(1.0 - entering, 1.0 - leaving);
    let square = grazing * grazing;
    let passed = 1.0 - square * square * grazing;
    return 21.0 / 20.0 * (1.0 - reflectance_at_normal) * passed.x * passed.y;
}

/// c/(μ_l + μ_v), c such that light from everywhere alike returns with the share A: 1/c = 4 ∫ μ (1 − μ ln(1 + 1/μ)) dμ
/// = 8/3 (1 − ln 2).
fn lommel_seeliger_lobe(entering: f32, leaving: f32) -> f32 {
    const MEAN: f32 = 0.81827415;
    return 1.0 / (MEAN * (entering + leaving));
}

/// α/(4 A (μ_l + μ_v)) [(1 + B) P + H(μ_l) H(μ_v) − 1], B = B₀/(1 + tan(g/2)/h) (Hapke 1981), with the half-space's own
/// H. `towards` is cos g. Of light that was scattered once without H H − 1.
fn hapke_lobe(
    shape: vec3f,
    surface_albedo: vec3f,
    entering: f32,
    leaving: f32,
    towards: f32,
    is_once: bool,
) -> vec3f {
    let root = diffuse_half_space_roots(surface_albedo);
    let h = half_space_h(half_space_u(entering, root), root) * half_space_h(half_space_u(leaving, root), root);
    // tan²(g/2) = (1 − cos g)/(1 + cos g).
    let tangent = sqrt(max(1.0 - towards, 0.0) / max(1.0 + towards, 1e-6));
    let surge = 1.0 + shape.x / (1.0 + tangent / abs(shape.y));
    // Henyey and Greenstein; the light turns by π − g.
    let g = shape.z;
    let below = 1.0 + g * g + 2.0 * g * towards;
    let phase = (1.0 - g * g) / (below * sqrt(below));
    // α/A, which has an end at A = 0.
    let per_albedo = (1.0 + root) / relative_diffuse_albedo(root);
    let often = select(h - 1.0, vec3f(0.0), is_once);
    return per_albedo / (4.0 * max(entering + leaving, LEAST_COSINE)) * (surge * phase + often);
}

/// a + b (cos Δφ)⁺ sin α tan β, the qualitative model of Oren and Nayar 1994; `towards` is l·v.
fn oren_nayar_lobe(sigma: f32, entering: f32, leaving: f32, towards: f32) -> f32 {
    let square = sigma * sigma;
    let a = 1.0 - 0.5 * square / (square + 0.33);
    let b = 0.45 * square / (square + 0.09);
    // sin α tan β cos Δφ = (l·v − μ_l μ_v)/max(μ_l, μ_v).
    let across = max(towards - entering * leaving, 0.0) / max(max(entering, leaving), LEAST_COSINE);
    return a + b * across;
}

/// Burley 2012: (1 − k)(1 + (F₉₀ − 1) s_l)(1 + (F₉₀ − 1) s_v) + 1.25 k ((1/(μ_l + μ_v) − ½) F_ss + ½), s = (1 − μ)⁵,
/// F₉₀ = ½ + 2 r cos²θ_d, F_ss with r cos²θ_d in its place.
fn disney_lobe(subsurface: f32, roughness: f32, entering: f32, leaving: f32, half_cosine: f32) -> f32 {
    let grazing = vec2f(1.0 - entering, 1.0 - leaving);
    let square = grazing * grazing;
    let schlick = square * square * grazing;
    let back = roughness * half_cosine * half_cosine;
    let rough = 1.0 + (2.0 * back - 0.5) * schlick;
    let flat_rise = 1.0 + (back - 1.0) * schlick;
    let flattened =
        1.25 * ((1.0 / max(entering + leaving, LEAST_COSINE) - 0.5) * flat_rise.x * flat_rise.y + 0.5);
    return mix(rough.x * rough.y, flattened, subsurface);
}
