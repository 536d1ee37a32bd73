// uses: gather/{input, packed_pixel, view}, kernel/constants, kernels/interleaved/agreement; needs: is_inside, subsurface_view

// The squares in a texture, packed as pixels are:
//
//     ┌───────────────┐
//     │               │
//     │  2×2 pixels   │   a texel for each block
//     │               │
//     ├───────┬───────┘
//     │ 4×4   │           a texel for each four of them
//     └───────┘

/// Rows of blocks: below them lie the squares of 4×4 pixels.
fn block_rows() -> i32 {
    return (subsurface_view.viewport_extent.y + BLOCK_SIDE - 1) / BLOCK_SIDE;
}

/// Texel of the square of 4×4 pixels at `place`.
fn coarse_texel(place: vec2i) -> vec2i {
    return vec2i(place.x, place.y + block_rows());
}

/// The words of a square.
fn pack_square(square: InputPixel) -> vec2u {
    if square.material == NO_MATERIAL {
        return vec2u(NO_LIGHT, 0u);
    }
    return pack_lit_surface(InputSurface(square.distance_mm, square.material), square.irradiance);
}

/// The words of a block whose pixels make `square`, and show `surface`: a block that gives no light takes some.
fn pack_block(surface: InputSurface, square: InputPixel) -> vec2u {
    if square.material != surface.material {
        return vec2u(NO_LIGHT, pack_surface(surface));
    }
    return pack_square(square);
}

/// The nearest of four surfaces; none where none has a material.
fn nearest_surface(a: InputSurface, b: InputSurface, c: InputSurface, d: InputSurface) -> InputSurface {
    var nearest = a;
    if !hides(nearest, b) {
        nearest = b;
    }
    if !hides(nearest, c) {
        nearest = c;
    }
    if !hides(nearest, d) {
        nearest = d;
    }
    return nearest;
}

/// The surface of a block's pixels `a` to `d`, none where none has a material: of the nearest one's material, and as
/// deep as those that belong to that are in the mean. What lies behind goes on into the blocks around.
fn surface_of_block(a: InputSurface, b: InputSurface, c: InputSurface, d: InputSurface) -> InputSurface {
    let nearest = nearest_surface(a, b, c, d);
    let reach_mm = BLOCK_DEPTH_PIXELS * span_mm(subsurface_view, nearest.distance_mm);
    let members = vec4f(
        membership(a, nearest, reach_mm),
        membership(b, nearest, reach_mm),
        membership(c, nearest, reach_mm),
        membership(d, nearest, reach_mm),
    );
    let distances = vec4f(a.distance_mm, b.distance_mm, c.distance_mm, d.distance_mm);
    return InputSurface(dot(members, distances) / dot(members, vec4f(1.0)), nearest.material);
}

/// The surface of a block; none outside of the target.
fn block_surface(coarse: texture_2d<u32>, block: vec2i) -> InputSurface {
    if !is_inside(BLOCK_SIDE * block) {
        return InputSurface(0.0, NO_MATERIAL);
    }
    return unpack_surface(textureLoad(coarse, block, 0).y);
}

/// What a tap at `position` reads: the square of 4×4 pixels around that if `is_sparse`, else the one of 2×2; the pixel
/// itself where the square is not whole; nothing outside of the target.
fn coarse_pixel_at(
    pixels: texture_2d<u32>,
    coarse: texture_2d<u32>,
    is_sparse: bool,
    position: vec2i,
) -> InputPixel {
    if !is_inside(position) {
        return InputPixel(vec3f(0.0), 0.0, NO_MATERIAL);
    }
    let texel = select(position >> vec2u(1u), coarse_texel(position >> vec2u(2u)), is_sparse);
    var words = textureLoad(coarse, texel, 0).rg;
    if words.x == NO_LIGHT {
        words = textureLoad(pixels, position, 0).rg;
    }
    return unpack_pixel(words);
}
