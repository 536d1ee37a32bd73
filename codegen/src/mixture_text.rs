//! Mixtures in WGSL: the parts of a row, their evaluation, and sums over them, written out without loops to the longest
//! mixture of a set.
//!
//! WGSL has no recursion: mixtures within mixtures are lists of parts already.

use std::fmt::Write as _;

use crate::dispatch_text::{FUNCTIONS, emit_switch, function_call, profile_call};
use crate::model_row::{ModelsInUse, PARTS, constant, has_shape, structure};

/// What a profile has besides the coefficients that its model makes of a surface albedo.
pub(crate) fn emit_shape(text: &mut String, most_parts: usize) {
    if most_parts == 0 {
        text.push_str(
            "/// Constants of a model that are not functions of the surface albedo.\nalias ProfileShape = vec4f;\n\n",
        );
        return;
    }
    let _ = writeln!(
        text,
        "/// Parts of the longest mixture. Shorter ones end in parts without a share.\n\
         const MIXTURE_PARTS: u32 = {most_parts}u;\n"
    );
    text.push_str(SHAPE);
}

const SHAPE: &str = "\
/// A part of a mixture, its coefficients evaluated.
struct MixturePart {
    /// Share of the energy; those of a mixture sum to 1.
    weight: f32,
    model: u32,
    coefficients: vec4f,
    /// Constants of the model that are not functions of the surface albedo; 0 for models without any.
    shape: vec4f,
}

/// What a profile has besides its coefficients: constants of its model, or the parts of a mixture.
struct ProfileShape {
    constants: vec4f,
    parts: array<MixturePart, MIXTURE_PARTS>,
}

";

/// The mixtures of a set that has some.
pub(crate) fn emit_mixtures(text: &mut String, models: &ModelsInUse) {
    let parts = &PARTS[..models.most_parts];
    text.push_str("/// A part of a mixture.\nstruct MixturePartModel {\n");
    text.push_str("    /// Share of the energy; those of a mixture sum to 1.\n    weight: f32,\n");
    text.push_str("    /// One of the `MODEL_…` constants.\n    model: u32,\n");
    for &kind in &models.of_parts {
        let (stem, structure) = (kind.description().stem, structure(kind));
        let _ = writeln!(text, "    /// Coefficients, if `model` is {}.", constant(kind));
        let _ = writeln!(text, "    @align(16) {stem}: {structure},");
    }
    text.push_str("}\n\n/// The parts of a mixture.\nstruct MixtureModel {\n");
    for part in parts {
        let _ = writeln!(text, "    @align(16) {part}: MixturePartModel,");
    }
    text.push_str("}\n\n/// A part at a surface albedo, with lengths in mm.\n");
    let head = "fn mixture_part(\n    part: MixturePartModel,\n    surface_albedo: f32,\n    mean_free_path_mm: f32,\n    \
                channel: u32,\n) -> MixturePart";
    emit_switch(text, head, "part.model", &models.of_parts, |kind| {
        let shape = if has_shape(kind) {
            format!("part.{}.shape", kind.description().stem)
        } else {
            "vec4f()".to_owned()
        };
        let coefficients = profile_call(kind, "part");
        format!("MixturePart(\n    part.weight,\n    part.model,\n    {coefficients},\n    {shape},\n)")
    });
    text.push_str(
        "/// All parts at a surface albedo.\n\
         fn mixture_shape(model: MixtureModel, surface_albedo: f32, mean_free_path_mm: f32, channel: u32) -> ProfileShape {\n    \
         return ProfileShape(\n        vec4f(),\n        array<MixturePart, MIXTURE_PARTS>(\n",
    );
    for part in parts {
        let _ = writeln!(
            text,
            "            mixture_part(model.{part}, surface_albedo, mean_free_path_mm, channel),"
        );
    }
    text.push_str("        ),\n    );\n}\n\n");
    for (function, argument, docs) in FUNCTIONS {
        let _ = writeln!(text, "/// Of one part: {docs}");
        let head = format!("fn mixture_part_{function}(part: MixturePart, {argument}: f32) -> f32");
        emit_switch(text, &head, "part.model", &models.of_parts, |kind| {
            function_call(kind, function, ["part.coefficients", "part.shape", argument])
        });
    }
    for (function, argument, docs) in &FUNCTIONS[..3] {
        let _ = writeln!(text, "/// {docs}");
        let _ = writeln!(text, "fn mixture_{function}(shape: ProfileShape, {argument}: f32) -> f32 {{");
        text.push_str("    var sum = 0.0;\n");
        for part in 0..parts.len() {
            let of_part = format!("mixture_part_{function}(shape.parts[{part}], {argument})");
            let _ = writeln!(text, "    sum += shape.parts[{part}].weight * {of_part};");
        }
        text.push_str("    return sum;\n}\n\n");
    }
    text.push_str(
        "/// The least and the greatest of the parts' quantiles, mm: that of the mixture lies between.\n\
         fn mixture_radius_bounds(shape: ProfileShape, u: f32) -> vec2f {\n    \
         var bounds = vec2f(mixture_part_sample_radius(shape.parts[0], u));\n",
    );
    for part in 1..parts.len() {
        let radius = format!("mixture_part_sample_radius(shape.parts[{part}], u)");
        let _ = writeln!(text, "    bounds = mixture_widened(bounds, {radius});");
    }
    text.push_str("    return bounds;\n}\n\n");
}
