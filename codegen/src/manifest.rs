//! The reflection manifest: what a module offers and asks for, as JSON for other tools.

use naga::{Module, ScalarKind};
use serde_json::{Value, json};

use crate::docs::Docs;
use crate::emit::Choices;
use crate::file_names::{PROFILE_CURVES_FILE, PROFILE_TABLES_FILE};
use crate::layout::{FieldType, structure};
use crate::material::MaterialSet;
use crate::reflect::{Bound, Reflection, Resource, Sample};
use subsurface_quality::QualityReport;

/// Version of the manifest's own form.
const MANIFEST_VERSION: u32 = 2;

/// What the manifest says of a set, beside what the module says itself.
pub(crate) struct ManifestOf<'a> {
    pub(crate) set: &'a MaterialSet,
    pub(crate) choices: &'a Choices,
    /// What the kernel was chosen by.
    pub(crate) quality: Option<&'a QualityReport>,
    /// Width and height of the texture of curves, texels.
    pub(crate) curve_size: [u32; 2],
    /// Whether the kernel reads tables of profiles.
    pub(crate) has_tables: bool,
    pub(crate) provenance: &'a str,
}

pub(crate) fn manifest(of: &ManifestOf<'_>, module: &Module, reflection: &Reflection) -> String {
    let materials: Vec<Value> = of
        .set
        .materials
        .iter()
        .enumerate()
        .map(|(number, material)| {
            json!({
                "number": number,
                "name": material.name,
                "docs": material.docs,
                "profile": material.profile.stem,
                "mean_free_path_mm": material.mean_free_path_mm,
                "surface_albedo": material.surface_albedo,
                "surface_albedo_mix": material.surface_albedo_mix,
                "specular": {
                    "reflectance_at_normal": material.reflectance_at_normal,
                    "roughness": material.roughness,
                    "coupling": material.coupling.name(),
                    "second": material.second_lobe.map(|lobe| {
                        json!({ "roughness": lobe.roughness, "weight": lobe.weight })
                    }),
                },
                "diffuse": material.diffuse.name(),
                "diffuse_shape": material.diffuse.shape(),
                "refractive_index": material.refractive_index,
                "transmission_diffused": material.transmission_diffused,
                "transmission_strength": material.transmission_strength,
                "transmittance": material.transmittance.name(),
                "thin_thickness_mm": material.thin_thickness_mm,
            })
        })
        .collect();
    let clear = of.set.clear.iter().map(|clear| {
        json!({
            "name": clear.name,
            "docs": clear.docs,
            "absorption_per_mm": clear.absorption_per_mm,
            "refractive_index": clear.refractive_index,
            "roughness": clear.roughness,
            "shell_thickness_mm": clear.shell_thickness_mm,
        })
    });
    let clear: Vec<Value> = clear.collect();
    let entry_points: Vec<Value> = reflection
        .entry_points
        .iter()
        .map(|entry| {
            let stage = format!("{:?}", entry.stage).to_lowercase();
            let mut value = json!({ "name": entry.name, "stage": stage });
            if let Some(size) = entry.workgroup_size {
                value["workgroup_size"] = json!(size);
            }
            value
        })
        .collect();
    let groups: Vec<Value> = reflection
        .groups
        .iter()
        .map(|group| {
            let bindings = group.bindings.iter().map(|(number, bound)| binding(*number, bound));
            json!({
                "group": group.number,
                "entry_points": group.entry_points,
                "bindings": bindings.collect::<Vec<_>>(),
            })
        })
        .collect();
    let structures: Vec<Value> = reflection
        .structures
        .iter()
        .filter_map(|&handle| structure(module, &Docs::default(), handle))
        .map(|structure| {
            let fields: Vec<Value> = structure
                .fields
                .iter()
                .map(|field| {
                    let ty = type_name(module, &field.ty);
                    json!({ "name": field.name, "offset": field.offset, "size": field.size, "type": ty })
                })
                .collect();
            json!({ "name": structure.name, "size": structure.size, "fields": fields })
        })
        .collect();
    let overrides: Vec<Value> = module
        .overrides
        .iter()
        .map(|(_, constant)| {
            let ty = module.types[constant.ty].inner.scalar_kind();
            json!({ "name": constant.name, "type": ty.map_or("", scalar_name) })
        })
        .collect();
    let Choices { estimator, rejection, output_format } = of.choices;
    let mut manifest = json!({
        "version": MANIFEST_VERSION,
        "provenance": of.provenance,
        "wgsl": "subsurface.wgsl",
        "kernel": { "kind": estimator.name(), "taps": estimator.taps(), "rotated": estimator.is_rotated() },
        "rejection": {
            "by_material": rejection.by_material,
            "by_distance": rejection.by_distance,
            "by_normal": rejection.by_normal,
            "rejected": rejection.rejected.name(),
        },
        "output_format": output_format.wgsl(),
        "profile_curves": { "file": PROFILE_CURVES_FILE, "format": "rgba32float", "size": of.curve_size },
        "materials": materials,
        "clear_materials": clear,
        "entry_points": entry_points,
        // Constants that pipelines may set; the WGSL holds their defaults.
        "overrides": overrides,
        "bind_groups": groups,
        "structs": structures,
    });
    if let Some(report) = of.quality {
        manifest["quality"] = quality(report);
    }
    if of.has_tables {
        manifest["profile_tables"] = json!(PROFILE_TABLES_FILE);
    }
    format!("{manifest:#}\n")
}

fn quality(report: &QualityReport) -> Value {
    let tiers = report.tiers.iter().map(|tier| {
        let name = tier.tier.name().to_lowercase();
        json!({ "tier": name, "max_error": tier.tier.target(), "taps": tier.taps, "error": tier.error })
    });
    let pictures = report.pictures.iter().map(|picture| {
        json!({
            "name": picture.name,
            "mean_radius_pixels": picture.mean_radius_pixels,
            "error": picture.error,
            "worst_pixel": picture.worst_pixel,
        })
    });
    json!({
        "error": report.error,
        "worst_pixel": report.worst_pixel,
        "tiers": tiers.collect::<Vec<_>>(),
        "pictures": pictures.collect::<Vec<_>>(),
    })
}

fn binding(number: u32, bound: &Bound) -> Value {
    let stages: Vec<String> = bound.stages.iter().map(|stage| format!("{stage:?}").to_lowercase()).collect();
    let mut value = json!({ "binding": number, "name": bound.name, "stages": stages });
    let what = match &bound.resource {
        Resource::Uniform { size, holds } => {
            json!({ "kind": "uniform", "min_binding_size": size, "type": holds })
        }
        Resource::Storage { size, holds, read_only } => {
            json!({ "kind": "storage", "min_binding_size": size, "type": holds, "read_only": read_only })
        }
        Resource::Texture { sample, dimension, multisampled } => {
            let sample = match sample {
                Sample::Float { filterable: true } => "float",
                Sample::Float { filterable: false } => "unfilterable-float",
                Sample::Sint => "sint",
                Sample::Uint => "uint",
                Sample::Depth => "depth",
            };
            json!({ "kind": "texture", "sample_type": sample, "dimension": dimension, "multisampled": multisampled })
        }
        Resource::StorageTexture { access, format, dimension } => {
            let access = match *access {
                "WriteOnly" => "write",
                "ReadOnly" => "read",
                "ReadWrite" => "read_write",
                _ => "atomic",
            };
            let format = format.to_lowercase();
            json!({ "kind": "storage-texture", "access": access, "format": format, "dimension": dimension })
        }
        Resource::Sampler { comparison } => json!({ "kind": "sampler", "comparison": comparison }),
    };
    if let (Value::Object(value), Value::Object(what)) = (&mut value, what) {
        value.extend(what);
    }
    value
}

fn type_name(module: &Module, ty: &FieldType) -> String {
    match ty {
        FieldType::F32 => "f32".to_owned(),
        FieldType::I32 => "i32".to_owned(),
        FieldType::U32 => "u32".to_owned(),
        FieldType::Vector { scalar, length } => format!("vec{length}<{scalar}>"),
        FieldType::Matrix { columns, rows_padded } => format!("mat{columns}x{rows_padded}<f32>"),
        FieldType::Array { element, length } => format!("array<{}, {length}>", type_name(module, element)),
        FieldType::Struct(handle) => module.types[*handle].name.clone().unwrap_or_default(),
    }
}

fn scalar_name(kind: ScalarKind) -> &'static str {
    match kind {
        ScalarKind::Bool => "bool",
        ScalarKind::Sint => "i32",
        ScalarKind::Uint => "u32",
        _ => "f32",
    }
}
