// uses: lib/{covering_triangle, distance}

/// How a depth value becomes a distance.
struct DistanceView {
    /// (x, y, z, w): distance along the view axis in mm = (x·depth + y) / (z·depth + w).
    distance_from_depth: vec4f,
}

@group(0) @binding(0) var<uniform> distance_view: DistanceView;
/// Depth of the frame; 1 is the background.
@group(0) @binding(1) var distance_depth_texture: texture_2d<f32>;

@vertex
fn distance_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return covering_triangle(index);
}

/// Distance along the view axis, mm; 0 where the frame shows the background.
@fragment
fn distance_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let depth = textureLoad(distance_depth_texture, vec2i(position.xy), 0).r;
    let distance_mm = distance_from_depth_mm(depth, distance_view.distance_from_depth);
    return vec4f(select(distance_mm, 0.0, depth == 1.0), 0.0, 0.0, 1.0);
}
