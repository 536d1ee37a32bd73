// uses: gather/{input, material, mean_free_path_scale, packed_pixel, view}, kernel/constants, kernels/interleaved/agreement, the material set; needs: subsurface_view, surface_texel_at

// Blocks of 2×2 pixels share one far field.

/// The pixels of a block that are of its nearest translucent pixel's material and depth, as one surface.
struct Block {
    /// The nearest of them.
    nearest_pixel: vec2i,
    /// Mean position, pixels.
    position: vec2f,
    /// Material number, or NO_MATERIAL where no pixel of the block is translucent.
    material: i32,
    /// Mean distance, mm.
    distance_mm: f32,
    /// Mean surface albedo.
    surface_albedo: vec3f,
    /// Mean factor on the mean free path.
    mean_free_path_scale: f32,
}

/// A pixel of a block.
struct BlockPixel {
    position: vec2i,
    surface: InputSurface,
    /// Its texel of the surface target: surface albedo and material number.
    surface_texel: vec4f,
    /// Factor on the mean free path.
    mean_free_path_scale: f32,
}

/// The pixel at `position` of packed `pixels`, which may lie outside of the target.
fn block_pixel(pixels: texture_2d<u32>, position: vec2i) -> BlockPixel {
    let surface = unpack_surface(load_packed_pixel(pixels, position).y);
    if surface.material == NO_MATERIAL {
        return BlockPixel(position, surface, vec4f(0.0), 1.0);
    }
    let surface_texel = surface_texel_at(position);
    return BlockPixel(position, surface, surface_texel, mean_free_path_scale_at(position));
}

/// The pixels of a block, from left to right and from the top.
struct BlockPixels {
    a: BlockPixel,
    b: BlockPixel,
    c: BlockPixel,
    d: BlockPixel,
}

/// The pixels of `block`.
fn pixels_of_block(pixels: texture_2d<u32>, block: vec2i) -> BlockPixels {
    let first = BLOCK_SIDE * block;
    return BlockPixels(
        block_pixel(pixels, first),
        block_pixel(pixels, first + vec2i(1, 0)),
        block_pixel(pixels, first + vec2i(0, 1)),
        block_pixel(pixels, first + vec2i(1, 1)),
    );
}

/// The nearest translucent pixel of four; any where none is.
fn nearest_translucent(pixels: BlockPixels) -> BlockPixel {
    var nearest = pixels.a;
    if !hides(nearest.surface, pixels.b.surface) {
        nearest = pixels.b;
    }
    if !hides(nearest.surface, pixels.c.surface) {
        nearest = pixels.c;
    }
    if !hides(nearest.surface, pixels.d.surface) {
        nearest = pixels.d;
    }
    return nearest;
}

/// The pixels of a block that are of its nearest translucent pixel's material and depth, as one surface.
fn block_of(block: vec2i, pixels: BlockPixels) -> Block {
    let nearest_pixel = nearest_translucent(pixels);
    let nearest = nearest_pixel.surface;
    if nearest.material == NO_MATERIAL {
        return Block(vec2i(0), vec2f(0.0), NO_MATERIAL, 0.0, vec3f(0.0), 1.0);
    }
    let reach_mm = BLOCK_DEPTH_PIXELS * span_mm(subsurface_view, nearest.distance_mm);
    let members = vec4f(
        membership(pixels.a.surface, nearest, reach_mm),
        membership(pixels.b.surface, nearest, reach_mm),
        membership(pixels.c.surface, nearest, reach_mm),
        membership(pixels.d.surface, nearest, reach_mm),
    );
    let shares = members / dot(members, vec4f(1.0));
    let surface = material_table[nearest.material].surface;
    let surface_albedo = shares.x * texel_surface_albedo(pixels.a.surface_texel, surface)
        + shares.y * texel_surface_albedo(pixels.b.surface_texel, surface)
        + shares.z * texel_surface_albedo(pixels.c.surface_texel, surface)
        + shares.w * texel_surface_albedo(pixels.d.surface_texel, surface);
    return Block(
        nearest_pixel.position,
        vec2f(BLOCK_SIDE * block) + vec2f(shares.y + shares.w, shares.z + shares.w),
        nearest.material,
        dot(
            shares,
            vec4f(
                pixels.a.surface.distance_mm,
                pixels.b.surface.distance_mm,
                pixels.c.surface.distance_mm,
                pixels.d.surface.distance_mm,
            ),
        ),
        surface_albedo,
        dot(
            shares,
            vec4f(
                pixels.a.mean_free_path_scale,
                pixels.b.mean_free_path_scale,
                pixels.c.mean_free_path_scale,
                pixels.d.mean_free_path_scale,
            ),
        ),
    );
}
