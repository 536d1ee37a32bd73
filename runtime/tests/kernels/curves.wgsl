/// One place on the curves of a material.
struct CurveQuery {
    material: u32,
    channel: u32,
    surface_albedo: f32,
    u: f32,
    offset_mm: f32,
}

struct CurveAnswer {
    radius_mm: f32,
    slope_mm: f32,
    beyond_line: f32,
    line_reach_mm: f32,
}

@group(1) @binding(0) var<storage, read> queries: array<CurveQuery>;
@group(1) @binding(1) var<storage, read_write> answers: array<CurveAnswer>;

@compute @workgroup_size(64)
fn curves(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&queries) {
        return;
    }
    let query = queries[id.x];
    let row = material_table[query.material];
    let profiles = material_profiles(row, vec3f(query.surface_albedo));
    let quantile = curve_quantile(channel_profile(profiles, query.channel).curve, query.u);
    var beyond = vec3f(0.0);
    var line_reach_mm = 0.0;
    // Not every kernel has edge curves.
    if row.surface.edge_reach > 0.0 {
        beyond = beyond_line(edge_spread_of(row.surface, profiles), query.offset_mm);
        let radii = channel_profile(profiles, query.channel).curve;
        line_reach_mm = curve_quantile(line_curve(row.surface, radii), query.u).x;
    }
    answers[id.x] = CurveAnswer(quantile.x, quantile.y, beyond[query.channel], line_reach_mm);
}
