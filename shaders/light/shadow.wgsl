// uses: kernel/constants, lib/{angle, vogel_disc}, light/{light, lit_surface}

// Shadows as soft as their light is large: percentage-closer soft shadows, Fernando 2005. What lies around a point lies
// on the plane of its surface, so that neither does it shade itself nor is its shadow moved off it.

/// Taps that look for what is in the way of a light that is no point.
const BLOCKER_TAPS: u32 = 16u;

/// Taps of its shadow filter.
const SOFT_SHADOW_TAPS: u32 = 32u;

/// Texels by which a point is lifted off its surface, under a light that is a point, and under a larger one: the first
/// is compared at the middles of texels, the other at taps, which read texels up to one beside.
const HARD_LIFT: f32 = 0.4;
const SOFT_LIFT: f32 = 1.5;

/// Smallest radius of a larger light's filter, in texels: a narrower one would show the map's steps.
const LEAST_SHADOW_TEXELS: f32 = 1.5;

/// Steepest slope of the plane in the map: beyond, the light grazes and enters no more.
const STEEPEST_PLANE: f32 = 32.0;

/// A surface as its light's map has it.
struct ShadowReceiver {
    coordinate: vec2f,
    depth: f32,
    /// How depth grows on its plane with both texture coordinates: steadily, in perspective too.
    slope: vec2f,
    /// World-space distance along the map's axis, and half of the map's width there.
    distance: f32,
    half_width: f32,
}

/// The plane at `position` with a normal that is turned to the light.
fn shadow_receiver(light: Light, position: vec3f, normal: vec3f, texels: f32) -> ShadowReceiver {
    let lifted_texels = select(HARD_LIFT, SOFT_LIFT, light.source > 0.0);
    let lift = lifted_texels * 2.0 * map_place(light, position).half_width / texels;
    let lifted = position + lift * normal;
    let place = map_place(light, lifted);
    // Of a plane n·x = c, z is (c − n_x x − n_y y)/n_z where rays are parallel, and 1/z is (n_x x/z + n_y y/z + n_z)/c
    // where they meet.
    let across = vec2f(dot(normal, light.right), -dot(normal, light.up));
    let range = light.far - light.near;
    let is_flat = light.spread <= 0.0;
    let offset = lifted - light.eye;
    let facing = select(
        min(dot(normal, offset), -length(offset) / STEEPEST_PLANE),
        min(dot(normal, light.forward), -1.0 / STEEPEST_PLANE),
        is_flat,
    );
    let growth = select(light.far * light.near * light.spread, light.half_width, is_flat);
    let slope = -2.0 * growth / (facing * range) * across;
    return ShadowReceiver(
        place.coordinate,
        map_depth(light, place.distance),
        slope,
        place.distance,
        place.half_width,
    );
}

/// Fraction of the light that reaches a point of a surface; `noise` in [0, 1) turns the taps of a soft one. Points
/// outside the map are lit.
fn shadow_visibility(
    maps: texture_depth_2d_array,
    comparison: sampler_comparison,
    light: Light,
    position: vec3f,
    normal: vec3f,
    noise: f32,
) -> f32 {
    let texels = f32(textureDimensions(maps).x);
    let receiver = shadow_receiver(light, position, normal, texels);
    let is_inside = all(receiver.coordinate >= vec2f(0.0)) && all(receiver.coordinate <= vec2f(1.0));
    let is_between = receiver.distance > light.near && receiver.distance < light.far;
    if light.layer == NO_SHADOW_MAP || !is_inside || !is_between {
        return 1.0;
    }
    // Software drivers run both sides of a branch, but no more of a loop than there is to do.
    let is_soft = light.source > 0.0;
    let hard = hard_shadow(maps, light, receiver, texels, select(4, 0, is_soft));
    let turn = vec2f(cos(TAU * noise), sin(TAU * noise));
    let penumbra = penumbra_radius(maps, light, receiver, texels, turn);
    let taps = select(0u, SOFT_SHADOW_TAPS, is_soft && penumbra >= 0.0);
    let radius = max(LEAST_SHADOW_TEXELS / texels, penumbra);
    var lit = 0.0;
    var direction = turn;
    for (var tap = 0u; tap < taps; tap += 1u) {
        let offset = radius * vogel_radius(tap, SOFT_SHADOW_TAPS) * direction;
        direction = next_vogel_direction(direction);
        // Where nothing is the map has 1, whatever the plane has.
        let depth = min(receiver.depth + dot(receiver.slope, offset), 1.0);
        lit += textureSampleCompareLevel(maps, comparison, receiver.coordinate + offset, light.layer, depth);
    }
    return select(hard, select(1.0, lit / f32(SOFT_SHADOW_TAPS), taps > 0u), is_soft);
}

/// The four weights of a cubic B-spline at a place between the middle two.
fn spline_weights(part: f32) -> vec4f {
    let away = vec2f(part, 1.0 - part);
    let cubes = away * away * away;
    let inner = 4.0 - 6.0 * away * away + 3.0 * cubes;
    return vec4f(cubes.y, inner, cubes.x) / 6.0;
}

/// Share of sixteen texels around a point that are not before its plane, each at its own middle, weighted smoothly;
/// `rows` of them.
fn hard_shadow(
    maps: texture_depth_2d_array,
    light: Light,
    receiver: ShadowReceiver,
    texels: f32,
    rows: i32,
) -> f32 {
    let place = receiver.coordinate * texels - 0.5;
    let first = floor(place) - 1.0;
    let across = spline_weights(fract(place.x));
    let down = spline_weights(fract(place.y));
    let size = vec2i(i32(texels));
    let slope = receiver.slope / texels;
    // On the plane, at the middle of the first texel.
    let plane = receiver.depth + dot(slope, first - place);
    var lit = 0.0;
    for (var row = 0; row < rows; row += 1) {
        let texel = vec2i(first) + vec2i(0, row);
        let depths = vec4f(
            shadow_map_depth(maps, texel, size, light.layer),
            shadow_map_depth(maps, texel + vec2i(1, 0), size, light.layer),
            shadow_map_depth(maps, texel + vec2i(2, 0), size, light.layer),
            shadow_map_depth(maps, texel + vec2i(3, 0), size, light.layer),
        );
        let planes = plane + slope.y * f32(row) + slope.x * vec4f(0.0, 1.0, 2.0, 3.0);
        lit += down[row] * dot(across, select(vec4f(0.0), vec4f(1.0), depths >= min(planes, vec4f(1.0))));
    }
    return lit;
}

/// Radius of the penumbra at a point, in texture coordinates: 0 of a light that is a point, below 0 where nothing is in
/// the way of a larger one.
fn penumbra_radius(
    maps: texture_depth_2d_array,
    light: Light,
    receiver: ShadowReceiver,
    texels: f32,
    turn: vec2f,
) -> f32 {
    // The light's disc seen from the receiver, where the map begins; a lamp's map begins at a part of its distance.
    let is_lamp = light.is_lamp != 0u;
    let before = receiver.distance - light.near;
    let beside = light.source * select(before, before / light.near, is_lamp);
    let reach = clamp(0.5 * beside / receiver.half_width, LEAST_SHADOW_TEXELS / texels, LARGEST_SHADOW_RADIUS);
    var blockers = 0.0;
    var depths = 0.0;
    var direction = turn;
    let taps = select(0u, BLOCKER_TAPS, light.source > 0.0);
    for (var tap = 0u; tap < taps; tap += 1u) {
        let offset = reach * vogel_radius(tap, BLOCKER_TAPS) * direction;
        direction = next_vogel_direction(direction);
        let texel = vec2i(floor((receiver.coordinate + offset) * texels));
        let depth = shadow_map_depth(maps, texel, vec2i(i32(texels)), light.layer);
        let blocks = select(0.0, 1.0, depth < min(receiver.depth + dot(receiver.slope, offset), 1.0));
        blockers += blocks;
        depths += blocks * depth;
    }
    let blocker = map_distances(light, vec4f(depths / max(blockers, 1.0))).x;
    let between = max(receiver.distance - blocker, 0.0);
    let wide = light.source * select(between, between / max(blocker, 1e-6), is_lamp);
    let radius = min(0.5 * wide / receiver.half_width, LARGEST_SHADOW_RADIUS);
    return select(radius, -1.0, taps > 0u && blockers == 0.0);
}

/// Largest radius of a shadow's filter, in texture coordinates: beyond, its taps lie so far apart that they show.
const LARGEST_SHADOW_RADIUS: f32 = 0.1;
