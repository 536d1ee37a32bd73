// uses: kernels/single_stage, passes/subsurface

// Kernels of one stage.

/// Diffused irradiance of translucent pixels; every other pixel keeps its irradiance.
@fragment
fn subsurface_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    return diffuse_single_stage(pixel, textureLoad(irradiance_texture, pixel, 0));
}
