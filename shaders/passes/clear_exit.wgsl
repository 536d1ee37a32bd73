// uses: lib/object_transform

/// Where the clear objects are seen from.
struct ClearExitFrame {
    /// Clip space from world space.
    clip_from_world: mat4x4f,
    /// Position of the camera in world space.
    camera_position: vec3f,
}

@group(0) @binding(0) var<uniform> clear_exit_frame: ClearExitFrame;
@group(1) @binding(0) var<uniform> object_transform: ObjectTransform;

struct ClearExitInterpolated {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
}

@vertex
fn clear_exit_vertex(@location(0) position: vec3f) -> ClearExitInterpolated {
    let world = world_position(object_transform, position);
    return ClearExitInterpolated(clear_exit_frame.clip_from_world * vec4f(world, 1.0), world);
}

/// World-space distance along the ray at which it leaves the last clear object.
@fragment
fn clear_exit_fragment(interpolated: ClearExitInterpolated) -> @location(0) vec4f {
    return vec4f(distance(interpolated.world_position, clear_exit_frame.camera_position), 0.0, 0.0, 1.0);
}
