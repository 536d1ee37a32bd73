// uses: gather/{curve, material, point}, kernel/constants

/// A strip beside the centre: lines at distances from `start` to `end`, pixels.
struct Strip {
    start: f32,
    end: f32,
    /// Whole distances of the two lines that stand for it, one for each half; the same if the strip has only one.
    near: f32,
    far: f32,
}

/// The curve of the distances within which a line keeps a share of its light, for the profile whose radii are on
/// `radii`: its rows follow those of the edge spread.
fn line_curve(surface: MaterialSurface, radii: Curve) -> Curve {
    let row = radii.row + i32(surface.first_edge + surface.curve_count) - i32(surface.first_curve);
    return Curve(row, radii.upper, radii.mean_free_path_mm);
}

/// Distance within which a line keeps the share `inside` of its light, pixels: of the widest channel.
fn line_reach_pixels(surface: MaterialSurface, point: SurfacePoint, inside: f32) -> f32 {
    let reach_mm = curve_quantile(line_curve(surface, point.widest.curve), inside).x;
    return min(reach_mm / point.pixel_mm, LARGEST_TAP_DISTANCE);
}

/// Strip number `strip` of `strips`, from 1 on; it begins at `start`. Of what lands beside the centre in the widest
/// channel, `beyond_centre`, the part (1 − k/n)^1.5 lies beyond strip k of n. But each strip has one pixel at least,
/// and all but the last end between pixels.
fn next_strip(
    surface: MaterialSurface,
    point: SurfacePoint,
    beyond_centre: f32,
    strip: u32,
    strips: u32,
    start: f32,
) -> Strip {
    // The last one has no end: its middle halves its light.
    let is_last = strip == strips;
    let left = f32(strips - strip) / f32(strips);
    let last = 1.0 / f32(strips);
    let beyond = select(left * sqrt(left), 0.5 * last * sqrt(last), is_last);
    let reach = line_reach_pixels(surface, point, 1.0 - beyond_centre * beyond);
    let end = max(select(floor(reach) + 0.5, 2.0 * reach - start, is_last), start + 1.0);
    let width = end - start;
    var places = select(EVEN_LINES, OPEN_LINES, is_last) * width;
    if width < 2.0 {
        places = vec2f(0.5 * width);
    }
    // Ties round away from the middle on both sides, so that the two lie evenly in the strip.
    return Strip(start, end, ceil(start + places.x - 0.5), floor(start + places.y + 0.5));
}
