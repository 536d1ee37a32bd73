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
    let profile = channel_profile(material_profiles(row, vec3f(query.surface_albedo)), query.channel);
    let quantile = curve_quantile(profile.curve, query.u);
    let beyond = curve_beyond_line(row.surface, profile.curve, query.offset_mm);
    answers[id.x] = CurveAnswer(quantile.x, quantile.y, beyond);
}
