// uses: gather/{gathered, input, rejection}, kernel/constants, kernels/interleaved/receiver, the material set

/// The eight pixels around one: beside it, and across its corners. Members, not an array, for the reason that
/// `FarFields` gives.
struct Ring {
    left: InputPixel,
    right: InputPixel,
    above: InputPixel,
    below: InputPixel,
    above_left: InputPixel,
    above_right: InputPixel,
    below_left: InputPixel,
    below_right: InputPixel,
}

/// Light of a ring, with the shares that its pixels have on a flat surface.
fn ring_light(at: Receiver, ring: Ring, beside: vec3f, across: vec3f) -> Gathered {
    let left_right = together(
        pixel_light(at, ring.left, vec2i(-1, 0), beside),
        pixel_light(at, ring.right, vec2i(1, 0), beside),
    );
    let above_below = together(
        pixel_light(at, ring.above, vec2i(0, -1), beside),
        pixel_light(at, ring.below, vec2i(0, 1), beside),
    );
    let upper = together(
        pixel_light(at, ring.above_left, vec2i(-1, -1), across),
        pixel_light(at, ring.above_right, vec2i(1, -1), across),
    );
    let lower = together(
        pixel_light(at, ring.below_left, vec2i(-1, 1), across),
        pixel_light(at, ring.below_right, vec2i(1, 1), across),
    );
    return together(together(left_right, above_below), together(upper, lower));
}

/// Where pixel `neighbour` of the ring lies, 0 to 7 in rows, seen from the centre.
fn ring_place(neighbour: i32) -> vec2i {
    // Past the centre.
    let place = neighbour + neighbour / 4;
    return vec2i(place % 3, place / 3) - 1;
}

/// Share on a flat surface of a pixel that lies `apart` from the centre.
fn ring_share(apart: vec2i, beside: vec3f, across: vec3f) -> vec3f {
    return select(across, beside, dot(apart, apart) == 1);
}

/// Light of one pixel of the ring, `apart` from the centre, whose share on a flat surface is `share`.
fn pixel_light(at: Receiver, pixel: InputPixel, apart: vec2i, share: vec3f) -> Gathered {
    let is_other = REJECT_BY_MATERIAL && pixel.material != at.surface.material;
    let deeper = at.depth_scale * (pixel.distance_mm - at.surface.distance_mm);
    let squared = min(deeper * deeper, 1.0);
    // Close to the centre profiles fall about as r^-2 or slower: what depth leaves of the flat share.
    let by_radius = BLOCK_DEPTH_PIXELS * BLOCK_DEPTH_PIXELS / f32(dot(apart, apart));
    let by_depth = (1.0 - squared) / (1.0 + by_radius * squared);
    let by_normal = accepted_by_normal(at.normal, at.position + apart, at.span_mm);
    let weight = share * select(by_depth * by_normal, 0.0, is_other || pixel.material == NO_MATERIAL);
    return Gathered(weight * pixel.irradiance, weight);
}
