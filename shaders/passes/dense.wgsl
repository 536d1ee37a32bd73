// uses: gather/{gathered, point}, kernels/dense, lib/angle, passes/subsurface

/// Light for the point that `pixel` shows, of every pixel in reach.
fn gather_at(point: SurfacePoint, pixel: vec2i) -> Gathered {
    return gather_dense(point, pixel, subsurface_view.viewport_extent);
}

/// Taps per pixel: all within the radius.
fn taps_at(point: SurfacePoint) -> f32 {
    let radius = f32(dense_radius(point));
    return 0.5 * TAU * radius * radius;
}
