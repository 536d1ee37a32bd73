// uses: gather/{input, material, mean_free_path_scale, point}, the material set; needs: subsurface_view, surface_texel_at

/// The point of `surface`, which the pixel at `position` shows.
fn surface_point_at(position: vec2i, surface: InputSurface) -> SurfacePoint {
    let row = material_table[surface.material];
    return surface_point(
        subsurface_view,
        position,
        vec2f(position),
        surface.material,
        row,
        surface.distance_mm,
        texel_surface_albedo(surface_texel_at(position), row.surface),
        mean_free_path_scale_at(position),
    );
}
