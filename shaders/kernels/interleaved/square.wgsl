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

/// Four pixels, which lie in two rows of two, as one: the mean of those that lie on the first one's surface. Two of
/// them count as all, and fewer give no light: along a silhouette that is right in the mean.
fn block_of_pixels(a: InputPixel, b: InputPixel, c: InputPixel, d: InputPixel) -> InputPixel {
    let first = first_lit(a, b, c, d);
    let reach_mm = STEEPEST_SQUARE * f32(BLOCK_SIDE) * span_mm(subsurface_view, first.distance_mm);
    let members = vec4f(
        is_on_surface(a, first, reach_mm),
        is_on_surface(b, first, reach_mm),
        is_on_surface(c, first, reach_mm),
        is_on_surface(d, first, reach_mm),
    );
    let count = dot(members, vec4f(1.0));
    let shares = members / max(count, 1.0);
    return InputPixel(
        (shares.x * a.irradiance + shares.y * b.irradiance) + (shares.z * c.irradiance + shares.w * d.irradiance),
        dot(shares, vec4f(a.distance_mm, b.distance_mm, c.distance_mm, d.distance_mm)),
        select(NO_MATERIAL, first.material, count > 1.0),
    );
}

/// Four blocks as one square of 4×4 pixels; without light unless all lie on one surface.
fn square_of_blocks(a: InputPixel, b: InputPixel, c: InputPixel, d: InputPixel) -> InputPixel {
    let reach_mm = 2.0 * STEEPEST_SQUARE * f32(BLOCK_SIDE) * span_mm(subsurface_view, a.distance_mm);
    let members = is_on_surface(b, a, reach_mm) * is_on_surface(c, a, reach_mm) * is_on_surface(d, a, reach_mm);
    return InputPixel(
        0.25 * ((a.irradiance + b.irradiance) + (c.irradiance + d.irradiance)),
        0.25 * ((a.distance_mm + b.distance_mm) + (c.distance_mm + d.distance_mm)),
        select(NO_MATERIAL, a.material, members > 0.0),
    );
}
