// uses: gather/{channel, curve, gathered, input, point, rejection}, lib/angle; needs: input_pixel

// Every pixel within the radius of 99.9 % of the light, Liang et al. 2023 ([L23]) eq. (22) with a sum in place of an
// estimate: what the other kernels are scored against.

/// Share of the widest profile's light that the radius holds.
const DENSE_QUANTILE: f32 = 0.999;

/// Largest radius, pixels: beyond it light is renormalized, and the loops stay bounded.
///
/// Mesa's llvmpipe ends loops after 65536 rounds in all, inner loops and those of branches not taken included, and
/// counts neighbouring pixels together: their discs fit a square of 241² = 58081 pixels, and there are about 700 rounds
/// besides. So nothing that is called for each of them may loop; a Gaussian sum of more than 32 terms does, and may be
/// cut short.
const DENSE_LARGEST_RADIUS: f32 = 120.0;

/// Pixels around the centre, along each axis, whose share is integrated over their area.
const DENSE_INTEGRATED: i32 = 2;

/// Points per axis of that integral.
const DENSE_POINTS: i32 = 4;

/// Radius of the sum, pixels.
fn dense_radius(point: SurfacePoint) -> i32 {
    let radius_mm = curve_quantile(point.widest.curve, DENSE_QUANTILE).x;
    return i32(ceil(min(radius_mm / point.pixel_mm, DENSE_LARGEST_RADIUS)));
}

/// Light of all pixels within `dense_radius` of the pixel `centre`, in a target of `size` pixels.
fn gather_dense(point: SurfacePoint, centre: vec2i, size: vec2i) -> Gathered {
    let radius = dense_radius(point);
    let near = with_near(centre_light(point, centre), point, centre, size, radius);
    return with_far(near, point, centre, size, radius);
}

/// Light of the centre itself.
fn centre_light(point: SurfacePoint, centre: vec2i) -> Gathered {
    let own = input_pixel(centre);
    if !accepts_material(point, own.material) {
        return Gathered(vec3f(0.0), vec3f(0.0));
    }
    return sent_light(point, own, centre, centre_share(point));
}

/// Light that was gathered, and that of the pixels around the centre whose share is integrated. One sum goes through
/// all loops: two would need twice the registers.
fn with_near(begun: Gathered, point: SurfacePoint, centre: vec2i, size: vec2i, radius: i32) -> Gathered {
    let first = max(centre - DENSE_INTEGRATED, vec2i(0));
    let last = min(centre + DENSE_INTEGRATED, size - 1);
    var gathered = begun;
    for (var y = first.y; y <= last.y; y += 1) {
        for (var x = first.x; x <= last.x; x += 1) {
            let apart = vec2i(x, y) - centre;
            let squared_distance = dot(apart, apart);
            let pixel = input_pixel(vec2i(x, y));
            if squared_distance > 0 && squared_distance <= radius * radius && accepts_material(point, pixel.material) {
                let share = near_share(point, apart, depth_difference_mm(point, pixel.distance_mm));
                gathered = together(gathered, sent_light(point, pixel, vec2i(x, y), share));
            }
        }
    }
    return gathered;
}

/// Light that was gathered, and that of the pixels beyond those that are integrated.
fn with_far(begun: Gathered, point: SurfacePoint, centre: vec2i, size: vec2i, radius: i32) -> Gathered {
    let first_row = max(centre.y - radius, 0);
    let last_row = min(centre.y + radius, size.y - 1);
    var gathered = begun;
    for (var y = first_row; y <= last_row; y += 1) {
        let row = y - centre.y;
        // Half a unit more than the whole number under the root: its rounding cannot pass a whole number.
        let half_width = i32(sqrt(f32(radius * radius - row * row) + 0.5));
        let last = min(centre.x + half_width, size.x - 1);
        for (var x = max(centre.x - half_width, 0); x <= last; x += 1) {
            let apart = vec2i(x, y) - centre;
            let pixel = input_pixel(vec2i(x, y));
            if any(abs(apart) > vec2i(DENSE_INTEGRATED)) && accepts_material(point, pixel.material) {
                let share = far_share(point, apart, depth_difference_mm(point, pixel.distance_mm));
                gathered = together(gathered, sent_light(point, pixel, vec2i(x, y), share));
            }
        }
    }
    return gathered;
}

/// Light of an accepted pixel whose share is known.
fn sent_light(point: SurfacePoint, pixel: InputPixel, position: vec2i, share: vec3f) -> Gathered {
    let weight = accepted_by_normal(point.normal, position, point.span_mm) * share;
    return Gathered(weight * pixel.irradiance, weight);
}

/// Share of the light that a pixel far from the centre, `apart` from it and `depth_mm` away in depth, sends there.
fn far_share(point: SurfacePoint, apart: vec2i, depth_mm: f32) -> vec3f {
    let area = point.pixel_mm * point.pixel_mm;
    let squared_mm = area * f32(dot(apart, apart)) + depth_mm * depth_mm;
    return area * channel_area_pdf(point.profiles, sqrt(squared_mm));
}

/// Share that a pixel near the centre sends, integrated over its area.
fn near_share(point: SurfacePoint, apart: vec2i, depth_mm: f32) -> vec3f {
    let area = point.pixel_mm * point.pixel_mm;
    var share = vec3f(0.0);
    for (var place = 0; place < DENSE_POINTS * DENSE_POINTS; place += 1) {
        let within = vec2f(vec2i(place % DENSE_POINTS, place / DENSE_POINTS)) + 0.5;
        let offset = vec2f(apart) + within / f32(DENSE_POINTS) - 0.5;
        let squared_mm = area * dot(offset, offset) + depth_mm * depth_mm;
        share += channel_area_pdf(point.profiles, sqrt(squared_mm));
    }
    return share * (area / f32(DENSE_POINTS * DENSE_POINTS));
}

/// Share of the centre's own pixel, a square: profiles diverge there, so it is summed over angles, where the integral
/// over the radius is the CDF at the square's border: (4/π) ∫ cdf(½ / cos θ) dθ over θ in [0, π/4].
fn centre_share(point: SurfacePoint) -> vec3f {
    // Gauss–Legendre with four points: the CDF is smooth away from r = 0.
    let nodes = vec4f(0.06943184, 0.33000948, 0.66999052, 0.93056816);
    let weights = vec4f(0.17392742, 0.32607258, 0.32607258, 0.17392742);
    let radii = 0.5 * point.pixel_mm / cos(nodes * (0.125 * TAU));
    // A loop, since there is a driver (SwiftShader) that compiles twelve CDFs in a row for minutes.
    var share = vec3f(0.0);
    for (var node = 0; node < 4; node += 1) {
        share += weights[node] * channel_radial_cdf(point.profiles, radii[node]);
    }
    return share;
}
