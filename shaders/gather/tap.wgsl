// uses: gather/{channel, gathered, input, point, rejection}, kernel/constants, lib/angle; needs: input_pixel

/// Pixel that a tap reads, `radius_mm` from the point.
fn tap_position(point: SurfacePoint, radius_mm: f32, direction: vec2f) -> vec2i {
    let radius_pixels = min(radius_mm / point.pixel_mm, LARGEST_TAP_DISTANCE);
    return vec2i(round(point.position + radius_pixels * direction));
}

/// Light of one tap that found `pixel` at `position`.
fn light_of_tap(point: SurfacePoint, quantile: vec2f, position: vec2i, pixel: InputPixel) -> Gathered {
    if !accepts_material(point, pixel.material) {
        return Gathered(vec3f(0.0), vec3f(0.0));
    }
    let radius_mm = quantile.x;
    let depth_mm = depth_difference_mm(point, pixel.distance_mm);
    let path_mm = sqrt(radius_mm * radius_mm + depth_mm * depth_mm);
    // 1 / p(r) = 2πr · dr/du.
    let ratio = channel_area_pdf(point.profiles, path_mm) * (TAU * radius_mm * quantile.y);
    let normal_share = accepted_by_normal(point.normal, position, point.span_mm);
    let weight = min(ratio, vec3f(LARGEST_WEIGHT)) * normal_share;
    return Gathered(weight * pixel.irradiance, weight);
}

/// Light of one tap whose radius was drawn from `quantile`: (radius in mm, dr/du).
fn tap_light(point: SurfacePoint, quantile: vec2f, direction: vec2f) -> Gathered {
    let position = tap_position(point, quantile.x, direction);
    return light_of_tap(point, quantile, position, input_pixel(position));
}
