/// How the subsurface pass reads its inputs.
struct SubsurfaceView {
    /// (x, y, z, w): distance along the view axis in mm = (x·depth + y) / (z·depth + w).
    distance_from_depth: vec4f,
    /// (x, y): millimetres that one pixel spans = x + y·distance.
    millimetres_per_pixel: vec2f,
    /// Taps per pixel: the budget of the largest footprint.
    taps: u32,
    /// Moves the pattern of taps on. The same number gives the same picture.
    frame_index: u32,
    /// First pixel of the viewport in the textures of the inputs and of the output.
    viewport_origin: vec2i,
    /// Size of the viewport, pixels: positions count from its upper left.
    viewport_extent: vec2i,
    /// Debug view: one of the `DEBUG_…` constants.
    debug_view: u32,
}

/// Smallest length of a pixel, mm: the number of pixels in a radius stays a finite f32.
const SMALLEST_PIXEL_MM: f32 = 1e-12;

/// Millimetres that a pixel spans at a distance.
fn span_mm(view: SubsurfaceView, distance_mm: f32) -> f32 {
    let span = abs(view.millimetres_per_pixel.x + view.millimetres_per_pixel.y * distance_mm);
    return max(span, SMALLEST_PIXEL_MM);
}

/// Position in the viewport of a fragment of the output.
fn viewport_position(view: SubsurfaceView, fragment: vec4f) -> vec2i {
    return vec2i(fragment.xy) - view.viewport_origin;
}
