//! The reflection manifest: what a module offers and asks for, as JSON for other tools.

use naga::Module;
use serde_json::{Value, json};

use crate::compiler::PROFILE_TABLES_FILE;
use crate::docs::Docs;
use crate::layout::{FieldType, structure};
use crate::material::MaterialSet;
use crate::reflect::{Bound, Reflection, Resource, Sample};

/// Version of the manifest's own form.
const MANIFEST_VERSION: u32 = 1;

pub(crate) fn manifest(
    set: &MaterialSet,
    module: &Module,
    reflection: &Reflection,
    provenance: &str,
    has_tables: bool,
) -> String {
    let materials: Vec<Value> = set
        .materials
        .iter()
        .enumerate()
        .map(|(number, material)| {
            json!({
                "number": number,
                "name": material.name,
                "docs": material.docs,
                "profile": material.profile.stem,
                "length_mm": material.length_mm,
                "surface_albedo": material.surface_albedo,
                "specular": {
                    "reflectance_at_normal": material.reflectance_at_normal,
                    "roughness": material.roughness,
                },
                "transmission_strength": material.transmission_strength,
            })
        })
        .collect();
    let entry_points: Vec<Value> = reflection
        .entry_points
        .iter()
        .map(|entry| json!({ "name": entry.name, "stage": format!("{:?}", entry.stage).to_lowercase() }))
        .collect();
    let groups: Vec<Value> = reflection
        .groups
        .iter()
        .map(|(number, group)| {
            let bindings: Vec<Value> = group.iter().map(|(number, bound)| binding(*number, bound)).collect();
            json!({ "group": number, "bindings": bindings })
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
    let mut manifest = json!({
        "version": MANIFEST_VERSION,
        "provenance": provenance,
        "wgsl": "subsurface.wgsl",
        "materials": materials,
        "entry_points": entry_points,
        "bind_groups": groups,
        "structs": structures,
    });
    if has_tables {
        manifest["profile_tables"] = json!(PROFILE_TABLES_FILE);
    }
    format!("{manifest:#}\n")
}

fn binding(number: u32, bound: &Bound) -> Value {
    let stages: Vec<String> = bound.stages.iter().map(|stage| format!("{stage:?}").to_lowercase()).collect();
    let mut value = json!({ "binding": number, "name": bound.name, "stages": stages });
    let what = match &bound.resource {
        Resource::Uniform { size, structure } => {
            json!({ "kind": "uniform", "min_binding_size": size, "struct": structure })
        }
        Resource::Storage { size, structure, read_only } => {
            json!({ "kind": "storage", "min_binding_size": size, "struct": structure, "read_only": read_only })
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
