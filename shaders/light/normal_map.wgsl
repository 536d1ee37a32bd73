/// Rounding of the length of a normal that is stored in eight bits, and a little more: shorter ones are means.
const NORMAL_ROUNDING: f32 = 0.01;

/// Roughness of a surface whose normal map, seen from afar, is a mean of normals: its length has shrunk by their
/// spread, which widens the lobe (Toksvig 2005, "Mipmapping Normal Maps"). With slopes' variance σ² per axis the length
/// of a mean is about 1 − σ², and α² of a lobe is twice the variance of its slopes: α′² = α² + 2 (1 − |n|).
fn roughness_of_normals(roughness: f32, texel: vec3f, scale: f32) -> f32 {
    let lost = max(1.0 - length(2.0 * texel - 1.0) - NORMAL_ROUNDING, 0.0);
    let alpha = roughness * roughness;
    let widened = sqrt(min(sqrt(alpha * alpha + 2.0 * lost * scale * scale), 1.0));
    return select(roughness, widened, lost > 0.0 && scale > 0.0);
}

/// Normal of the normal map in world space, with the tangent frame from screen-space derivatives
/// (Schüler 2006, "Normal Mapping without Precomputed Tangents", ShaderX5).
///
/// `texel` holds the map's value in [0, 1], x towards increasing u and y towards decreasing v as in glTF.
fn mapped_normal(normal: vec3f, world_position: vec3f, texture_coordinate: vec2f, texel: vec3f, scale: f32) -> vec3f {
    let position_dx = dpdx(world_position);
    let position_dy = dpdy(world_position);
    let coordinate_dx = dpdx(texture_coordinate);
    let coordinate_dy = dpdy(texture_coordinate);
    // The paper's screen has y up; here it runs down, and a back face mirrors it once more. The sign says which.
    let orientation = sign(dot(cross(position_dx, position_dy), normal));
    let across_dy = orientation * cross(position_dy, normal);
    let across_dx = orientation * cross(normal, position_dx);
    let tangent = across_dy * coordinate_dx.x + across_dx * coordinate_dy.x;
    let bitangent = -(across_dy * coordinate_dx.y + across_dx * coordinate_dy.y);
    let longest = max(dot(tangent, tangent), dot(bitangent, bitangent));
    // (World length × texture coordinate per pixel)²: nothing this small is a frame, only a mesh without coordinates.
    if longest < 1e-30 {
        return normal;
    }
    let slope = (2.0 * texel.xy - 1.0) * scale;
    // A map that points below the surface would turn the normal inside out.
    let height = max(2.0 * texel.z - 1.0, 0.05);
    return normalize((tangent * slope.x + bitangent * slope.y) * inverseSqrt(longest) + normal * height);
}
