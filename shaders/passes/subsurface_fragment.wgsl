// uses: gather/view, lib/covering_triangle, passes/subsurface

/// What the first stage of the kernel left for the second, if it has two.
@group(2) @binding(0) var intermediate_texture: texture_2d<u32>;
/// Squares of pixels that an earlier stage packed.
@group(2) @binding(1) var coarse_texture: texture_2d<u32>;
/// Pixels that an earlier stage packed.
@group(2) @binding(2) var pixel_texture: texture_2d<u32>;

/// One triangle that covers the target.
@vertex
fn subsurface_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return covering_triangle(index);
}

/// Irradiance as it stands: for the pixels that the stencil leaves out.
@fragment
fn passthrough_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return irradiance_at(viewport_position(subsurface_view, position));
}
