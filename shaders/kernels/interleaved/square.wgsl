// uses: gather/{input, view}, kernel/constants, the material set; needs: subsurface_view

// Squares of pixels as one pixel: blocks of 2×2 pixels, and four of these. Where more than one surface meets there is
// none, and pixels are read one by one.

/// Whether a pixel gives light and lies on the surface of `first`, at most `reach_mm` in front of it or behind it.
fn is_on_surface(pixel: InputPixel, first: InputPixel, reach_mm: f32) -> bool {
    let is_other = REJECT_BY_MATERIAL && pixel.material != first.material;
    let is_remote = REJECT_BY_DISTANCE && abs(pixel.distance_mm - first.distance_mm) > reach_mm;
    return pixel.material != NO_MATERIAL && !is_other && !is_remote;
}

/// Four pixels, which lie in two rows of two and are `side` wide, as one: their mean; without light unless all give
/// some and lie on one surface.
fn mean_pixel(a: InputPixel, b: InputPixel, c: InputPixel, d: InputPixel, side: f32) -> InputPixel {
    let reach_mm = 2.0 * side * STEEPEST_SQUARE * span_mm(subsurface_view, a.distance_mm);
    let is_whole = is_on_surface(b, a, reach_mm) && is_on_surface(c, a, reach_mm) && is_on_surface(d, a, reach_mm);
    return InputPixel(
        0.25 * ((a.irradiance + b.irradiance) + (c.irradiance + d.irradiance)),
        0.25 * ((a.distance_mm + b.distance_mm) + (c.distance_mm + d.distance_mm)),
        select(NO_MATERIAL, a.material, is_whole),
    );
}
