// uses: lib/numeric_limits; needs: mean_free_path_scale_texture, texture_position

/// Scales of the mean free path are kept within these: enough for a factor of a thousand on any material.
const SMALLEST_MEAN_FREE_PATH_SCALE: f32 = 1e-3;

const LARGEST_MEAN_FREE_PATH_SCALE: f32 = 1e3;

/// Factor on the mean free path at `position`: 1 where the texture has no finite number.
fn mean_free_path_scale_at(position: vec2i) -> f32 {
    let last = vec2i(textureDimensions(mean_free_path_scale_texture)) - 1;
    let scale = textureLoad(mean_free_path_scale_texture, min(texture_position(position), last), 0).r;
    let limited = clamp(scale, SMALLEST_MEAN_FREE_PATH_SCALE, LARGEST_MEAN_FREE_PATH_SCALE);
    return select(1.0, limited, is_finite(scale));
}
