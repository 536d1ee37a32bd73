// uses: gather/{input, view}, kernel/constants, the material set; needs: subsurface_view

// Squares of pixels as one pixel: blocks of 2×2 pixels, and four of these.

/// The first of four pixels that gives light, or the last where none does.
fn first_lit(a: InputPixel, b: InputPixel, c: InputPixel, d: InputPixel) -> InputPixel {
    if a.material != NO_MATERIAL {
        return a;
    }
    if b.material != NO_MATERIAL {
        return b;
    }
    if c.material != NO_MATERIAL {
        return c;
    }
    return d;
}

/// 1 for a pixel that lies on the surface of `first`, at most `reach_mm` in front of it or behind it; 0 for another.
fn is_on_surface(pixel: InputPixel, first: InputPixel, reach_mm: f32) -> f32 {
    let is_other = REJECT_BY_MATERIAL && pixel.material != first.material;
    let is_remote = REJECT_BY_DISTANCE && abs(pixel.distance_mm - first.distance_mm) > reach_mm;
    return select(1.0, 0.0, pixel.material == NO_MATERIAL || is_other || is_remote);
}

/// Four pixels or squares, which lie in two rows of two, as one that is `side` pixels wide: the mean of those that
/// lie on the first one's surface.
fn square_of(a: InputPixel, b: InputPixel, c: InputPixel, d: InputPixel, side: f32) -> InputPixel {
    let first = first_lit(a, b, c, d);
    let reach_mm = STEEPEST_SQUARE * side * span_mm(subsurface_view, first.distance_mm);
    let members = vec4f(
        is_on_surface(a, first, reach_mm),
        is_on_surface(b, first, reach_mm),
        is_on_surface(c, first, reach_mm),
        is_on_surface(d, first, reach_mm),
    );
    let shares = members / max(dot(members, vec4f(1.0)), 1.0);
    return InputPixel(
        (shares.x * a.irradiance + shares.y * b.irradiance) + (shares.z * c.irradiance + shares.w * d.irradiance),
        dot(shares, vec4f(a.distance_mm, b.distance_mm, c.distance_mm, d.distance_mm)),
        first.material,
    );
}
