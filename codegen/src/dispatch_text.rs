//! Functions whose body is chosen by the model of a profile.

use std::fmt::Write as _;

use subsurface_profile::ModelKind;
use subsurface_profile::description::Description;

use crate::model_row::{ModelsInUse, constant, has_shape, is_mixture};

/// A function whose body is chosen by model: a plain call where the set uses one model only. What `call` returns may have
/// lines, which are indented.
pub(crate) fn emit_switch(
    text: &mut String,
    head: &str,
    selector: &str,
    models: &[ModelKind],
    call: impl Fn(ModelKind) -> String,
) {
    let _ = writeln!(text, "{head} {{");
    if let [only] = models {
        let _ = writeln!(text, "    return {};", call(*only).replace('\n', "\n    "));
    } else {
        let _ = writeln!(text, "    switch {selector} {{");
        for (index, model) in models.iter().enumerate() {
            if index + 1 == models.len() {
                text.push_str("        default: {\n");
            } else {
                let _ = writeln!(text, "        case {}: {{", constant(*model));
            }
            let returned = call(*model).replace('\n', "\n            ");
            let _ = writeln!(text, "            return {returned};\n        }}");
        }
        text.push_str("    }\n");
    }
    text.push_str("}\n\n");
}

/// The call of a model's function that evaluates its coefficients, which are a member of `owner`.
pub(crate) fn profile_call(kind: ModelKind, owner: &str) -> String {
    let Description { stem, lengths, .. } = kind.description();
    let arguments = if lengths.is_empty() { "channel" } else { "surface_albedo, mean_free_path_mm" };
    format!("{stem}_profile({owner}.{stem}, {arguments})")
}

/// What every profile answers: name of the function, its argument, its documentation.
pub(crate) const FUNCTIONS: [(&str, &str, &str); 4] = [
    ("area_pdf", "radius_mm", "R(r) / A per unit area, mm⁻². May diverge at r = 0."),
    ("radial_pdf", "radius_mm", "2πr R(r) / A per unit radius, mm⁻¹."),
    ("radial_cdf", "radius_mm", "Fraction of the reflected energy that leaves within `radius_mm`."),
    ("sample_radius", "u", "Inverse of `profile_radial_cdf`: the radius, mm, for u in [0, 1)."),
];

pub(crate) fn emit_dispatch(text: &mut String, models: &ModelsInUse) {
    text.push_str("/// The profiles of the three channels of a material at a given surface albedo.\n");
    text.push_str(
        "fn material_profiles(row: SubsurfaceMaterial, surface_albedo: vec3f) -> ChannelProfiles {\n    \
         return ChannelProfiles(\n        material_profile(row, surface_albedo.r, row.surface.mean_free_path_mm.r, 0u),\n        \
         material_profile(row, surface_albedo.g, row.surface.mean_free_path_mm.g, 1u),\n        \
         material_profile(row, surface_albedo.b, row.surface.mean_free_path_mm.b, 2u),\n    );\n}\n\n",
    );
    let (kinds, has_parts) = (&models.of_materials, models.most_parts > 0);
    text.push_str("/// The profile of one channel (0 red, 1 green, 2 blue) of a material.\n");
    let head = "fn material_profile(\n    row: SubsurfaceMaterial,\n    surface_albedo: f32,\n    mean_free_path_mm: f32,\n    \
                channel: u32,\n) -> Profile";
    emit_switch(text, head, "row.surface.model", kinds, |kind| {
        let Description { stem, lengths, .. } = kind.description();
        let is_mixture = is_mixture(kind);
        let coefficients = if is_mixture { "vec4f()".to_owned() } else { profile_call(kind, "row") };
        let shape = match (is_mixture, has_shape(kind), has_parts) {
            (true, ..) => format!("{stem}_shape(row.{stem}, surface_albedo, mean_free_path_mm, channel)"),
            (_, true, true) => format!("ProfileShape(row.{stem}.shape, array<MixturePart, MIXTURE_PARTS>())"),
            (_, true, false) => format!("row.{stem}.shape"),
            (_, false, true) => "ProfileShape()".to_owned(),
            (_, false, false) => "vec4f()".to_owned(),
        };
        let curve = match (is_mixture, lengths) {
            (true, _) => "channel_albedo_curve(row.surface, channel, surface_albedo)",
            (_, []) => "channel_curve(row.surface, channel)",
            _ => "albedo_curve(row.surface, surface_albedo, mean_free_path_mm)",
        };
        format!("Profile(\n    {},\n    {coefficients},\n    {shape},\n    {curve},\n)", constant(kind))
    });
    let constants = if has_parts { "profile.shape.constants" } else { "profile.shape" };
    for (function, argument, docs) in FUNCTIONS {
        let _ = writeln!(text, "/// {docs}");
        let head = format!("fn profile_{function}(profile: Profile, {argument}: f32) -> f32");
        emit_switch(text, &head, "profile.model", kinds, |kind| {
            if is_mixture(kind) {
                return format!("{}_{function}(profile.shape, {argument})", kind.description().stem);
            }
            function_call(kind, function, ["profile.coefficients", constants, argument])
        });
    }
}

/// The call of one of a model's [`FUNCTIONS`].
pub(crate) fn function_call(
    kind: ModelKind,
    function: &str,
    [coefficients, shape, argument]: [&str; 3],
) -> String {
    let shape = if has_shape(kind) { format!("{shape}, ") } else { String::new() };
    format!("{}_{function}({coefficients}, {shape}{argument})", kind.description().stem)
}
