// uses: gather/{footprint, gathered, point}, kernels/importance_sampled, lib/{angle, noise}, passes/subsurface

/// Light for the point that `pixel` shows, by taps that are turned per pixel.
fn gather_at(point: SurfacePoint, pixel: vec2i) -> Gathered {
    let turn = TAU * interleaved_gradient_noise(pixel, subsurface_view.frame_index);
    return gather_importance_sampled(point, footprint_taps(point, subsurface_view.taps), turn);
}

/// Taps per pixel.
fn taps_at(point: SurfacePoint) -> f32 {
    return f32(footprint_taps(point, subsurface_view.taps));
}
