// Light that crosses a boundary.

/// Direction of a ray behind a boundary: t = (w − k) n − r l with w = r (n·l), k = √(1 + (w − r)(w + r)), for l =
/// `towards`, where it comes from, and r = n₁/n₂ (Real-Time Rendering 4, eq. 14.28): sin θ₁/sin θ₂ = n₂/n₁. All are unit
/// vectors. Where all light is reflected there is no such direction, and the result is 0.
fn refracted_direction(towards: vec3f, normal: vec3f, ratio: f32) -> vec3f {
    let w = ratio * dot(normal, towards);
    let square = 1.0 + (w - ratio) * (w + ratio);
    let direction = (w - sqrt(max(square, 0.0))) * normal - ratio * towards;
    return select(vec3f(0.0), direction, square >= 0.0);
}

/// F₀ = ((η − 1)/(η + 1))² of a boundary.
fn reflectance_of_index(refractive_index: f32) -> f32 {
    let root = (refractive_index - 1.0) / (refractive_index + 1.0);
    return root * root;
}
