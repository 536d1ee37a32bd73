/// One point at which all functions of a profile are evaluated.
struct TwinQuery {
    material: u32,
    channel: u32,
    surface_albedo: f32,
    radius_mm: f32,
    u: f32,
}

struct TwinAnswer {
    area_pdf: f32,
    radial_pdf: f32,
    radial_cdf: f32,
    transmittance: f32,
    slab_transmittance: f32,
    slab_reflectance: f32,
    sample_radius: f32,
}

@group(1) @binding(0) var<storage, read> queries: array<TwinQuery>;
@group(1) @binding(1) var<storage, read_write> answers: array<TwinAnswer>;

@compute @workgroup_size(64)
fn twins(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&queries) {
        return;
    }
    let query = queries[id.x];
    let profiles = material_profiles(material_table[query.material], vec3f(query.surface_albedo));
    let profile = channel_profile(profiles, query.channel);
    let length = material_table[query.material].surface.mean_free_path_mm;
    let albedo = vec3f(query.surface_albedo);
    answers[id.x] = TwinAnswer(
        profile_area_pdf(profile, query.radius_mm),
        profile_radial_pdf(profile, query.radius_mm),
        profile_radial_cdf(profile, query.radius_mm),
        profile_transmittance(profiles, albedo, query.radius_mm)[query.channel],
        slab_transmittance(albedo, length, query.radius_mm)[query.channel],
        slab_reflectance(albedo, length, query.radius_mm)[query.channel],
        profile_sample_radius(profile, query.u),
    );
}
