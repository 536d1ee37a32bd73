// uses: lib/{angle, numeric_limits}; needs: tabulated_knot, tabulated_piece_start

// A table of 2πr R(r) / A by surface albedo and radius. The cdf is a monotone cubic between two radii.
// From the material set come `tabulated_knot(i)`, table by table, by surface albedo, by radius, and the search for the
// piece that holds a radius: `tabulated_piece_start(profile, radius)`, strides of `tabulated_stride`.

/// Where this model's knots stand among all knots of the set.
struct TabulatedModel {
    first_knot: u32,
    /// Knots of one surface albedo, 2 or more.
    knot_count: u32,
    /// Surface albedos, 1 or more.
    table_count: u32,
}

/// What a table says at one radius; lengths in mean free paths. The first radius is 0, and a table ends at its last.
struct TabulatedKnot {
    radius: f32,
    /// Fraction of the energy within.
    cdf: f32,
    /// 2πr R(r) / A here.
    density: f32,
    /// Its mean from here to the next knot. (The difference of two cdfs near 1 would have no digits left.)
    mean_density: f32,
    /// Of the table that the knot belongs to.
    surface_albedo: f32,
}

/// The first stride of a search among `count` sorted things for the last that is not too large. Strides are halved down
/// to 1, so that the number of steps depends on `count` alone: with loops that end by what they read, Mesa's lavapipe
/// returned wrong radii in blocks of pixels that a triangle covers in part.
fn tabulated_first_stride(count: u32) -> u32 {
    return select(0u, 1u << firstLeadingBit(max(count - 1u, 1u)), count > 1u);
}

/// (first knot of the table below the surface albedo, knots of a table, share of the table above, mean free path).
fn tabulated_profile(model: TabulatedModel, surface_albedo: f32, mean_free_path_mm: f32) -> vec4f {
    // The last table whose surface albedo is not above, or the first.
    var lower = 0u;
    for (var stride = tabulated_first_stride(model.table_count); stride > 0u; stride >>= 1u) {
        let next = min(lower + stride, model.table_count - 1u);
        let next_knot = tabulated_knot(model.first_knot + next * model.knot_count);
        lower = select(lower, next, next_knot.surface_albedo <= surface_albedo);
    }
    let first_knot = model.first_knot + lower * model.knot_count;
    var share = 0.0;
    if lower + 1u < model.table_count {
        let below = tabulated_knot(first_knot).surface_albedo;
        let above = tabulated_knot(first_knot + model.knot_count).surface_albedo;
        share = clamp((surface_albedo - below) / (above - below), 0.0, 1.0);
    }
    return vec4f(f32(first_knot), f32(model.knot_count), share, mean_free_path_mm);
}

/// Knot `index` of the profile: a mixture of two tables, which have their knots at the same radii.
fn tabulated_mixed_knot(profile: vec4f, index: u32) -> TabulatedKnot {
    let below = tabulated_knot(u32(profile.x) + index);
    if profile.z <= 0.0 {
        return below;
    }
    let above = tabulated_knot(u32(profile.x) + u32(profile.y) + index);
    return TabulatedKnot(
        below.radius,
        mix(below.cdf, above.cdf, profile.z),
        mix(below.density, above.density, profile.z),
        mix(below.mean_density, above.mean_density, profile.z),
        below.surface_albedo,
    );
}

/// Two neighbouring knots.
struct TabulatedPiece {
    from_knot: TabulatedKnot,
    to_knot: TabulatedKnot,
}

/// A step of the search for the piece that holds `radius`: `stride` pieces on, unless that one begins beyond it.
fn tabulated_stride(profile: vec4f, start: u32, stride: u32, radius: f32) -> u32 {
    // The last knot begins no piece.
    let next = min(start + stride, u32(profile.y) - 2u);
    return select(start, next, tabulated_knot(u32(profile.x) + next).radius <= radius);
}

/// The piece that holds a radius in mean free paths.
fn tabulated_piece(profile: vec4f, radius: f32) -> TabulatedPiece {
    let start = tabulated_piece_start(profile, radius);
    return TabulatedPiece(tabulated_mixed_knot(profile, start), tabulated_mixed_knot(profile, start + 1u));
}

/// 2πr R(r) / A at s, from 0 to 1, within a piece: the derivative of the cubic, per mean free path.
fn tabulated_density(piece: TabulatedPiece, s: f32) -> f32 {
    let rest = 1.0 - s;
    let at_ends = piece.from_knot.density * rest * (1.0 - 3.0 * s) + piece.to_knot.density * s * (1.0 - 3.0 * rest);
    return max(at_ends + 6.0 * piece.from_knot.mean_density * s * rest, 0.0);
}

/// The mean of the density up to s, times s: times the width of the piece, the energy in it.
fn tabulated_partial_mean(piece: TabulatedPiece, s: f32) -> f32 {
    let from_density = piece.from_knot.density;
    let to_density = piece.to_knot.density;
    let mean = piece.from_knot.mean_density;
    let square = 3.0 * mean - 2.0 * from_density - to_density;
    let cube = from_density + to_density - 2.0 * mean;
    return clamp(s * (from_density + s * (square + s * cube)), 0.0, mean);
}

/// R(r) / A per unit area, mm⁻². May diverge at r = 0; 0 beyond the last radius.
fn tabulated_area_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    return tabulated_radial_pdf(profile, radius_mm) / (TAU * max(radius_mm, SMALLEST_RADIUS_MM));
}

/// 2πr R(r) / A per unit radius, mm⁻¹; 0 beyond the last radius.
fn tabulated_radial_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    let radius = radius_mm / profile.w;
    let piece = tabulated_piece(profile, radius);
    if radius >= piece.to_knot.radius {
        return 0.0;
    }
    let s = (radius - piece.from_knot.radius) / (piece.to_knot.radius - piece.from_knot.radius);
    return tabulated_density(piece, s) / profile.w;
}

/// Fraction of the reflected energy that leaves within `radius_mm`.
fn tabulated_radial_cdf(profile: vec4f, radius_mm: f32) -> f32 {
    let radius = radius_mm / profile.w;
    let piece = tabulated_piece(profile, radius);
    if radius >= piece.to_knot.radius {
        return 1.0;
    }
    let width = piece.to_knot.radius - piece.from_knot.radius;
    let s = (radius - piece.from_knot.radius) / width;
    return min(piece.from_knot.cdf + width * tabulated_partial_mean(piece, s), 1.0);
}

/// Inverse of `tabulated_radial_cdf`.
///
/// The knots are searched by their cdf, and the cubic between two of them is solved by Newton's method within a
/// shrinking bracket: at its ends the cubic may be flat.
fn tabulated_sample_radius(profile: vec4f, u: f32) -> f32 {
    let v = min(u, LARGEST_BELOW_ONE);
    let pieces = u32(profile.y) - 1u;
    var lower = 0u;
    for (var stride = tabulated_first_stride(pieces); stride > 0u; stride >>= 1u) {
        let next = min(lower + stride, pieces - 1u);
        lower = select(lower, next, tabulated_mixed_knot(profile, next).cdf <= v);
    }
    let piece = TabulatedPiece(tabulated_mixed_knot(profile, lower), tabulated_mixed_knot(profile, lower + 1u));
    let width = piece.to_knot.radius - piece.from_knot.radius;
    let wanted = (v - piece.from_knot.cdf) / width;
    if wanted <= 0.0 {
        return piece.from_knot.radius * profile.w;
    }
    var below = 0.0;
    var above = 1.0;
    // The piece read as a straight line.
    var s = min(wanted / max(piece.from_knot.mean_density, wanted), 1.0);
    for (var step = 0; step < 16; step += 1) {
        let excess = tabulated_partial_mean(piece, s) - wanted;
        if excess < 0.0 {
            below = s;
        } else {
            above = s;
        }
        let newton = s - excess / tabulated_density(piece, s);
        // Not a comparison that a NaN could pass. The ends count: on a straight line the first step is the root.
        let next = select(0.5 * (below + above), newton, newton >= below && newton <= above);
        if abs(next - s) <= 1e-7 * s {
            break;
        }
        s = next;
    }
    return (piece.from_knot.radius + width * s) * profile.w;
}
