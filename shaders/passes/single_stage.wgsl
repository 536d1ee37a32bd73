// uses: gather/view, kernels/single_stage, passes/subsurface

// Kernels of one stage.

/// Diffused irradiance of translucent pixels; every other pixel keeps its irradiance.
@fragment
fn subsurface_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = viewport_position(subsurface_view, position);
    return diffuse_single_stage(pixel);
}
