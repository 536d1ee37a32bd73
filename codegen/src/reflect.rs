//! What a validated module offers and asks for: entry points, bind groups, host-shareable structs, vertex inputs.

use std::collections::{BTreeMap, BTreeSet};

use naga::valid::ModuleInfo;
use naga::{
    AddressSpace, Binding, GlobalVariable, Handle, ImageClass, ImageDimension, Module, Scalar, ScalarKind,
    ShaderStage, StorageAccess, Type, TypeInner,
};

use crate::compose::Linked;
use crate::docs::Docs;

mod groups;

/// Everything that bindings and the manifest are written from.
#[derive(Debug)]
pub(crate) struct Reflection {
    pub(crate) entry_points: Vec<EntryPoint>,
    /// Bind groups by number, then in the order of the text.
    pub(crate) groups: Vec<Group>,
    /// Structs that a buffer holds, inner ones before the ones that contain them.
    pub(crate) structures: Vec<Handle<Type>>,
    /// Structs that vertex shaders take as input.
    pub(crate) vertex_inputs: Vec<VertexInput>,
}

#[derive(Debug)]
pub(crate) struct EntryPoint {
    pub(crate) name: String,
    pub(crate) stage: ShaderStage,
    /// Invocations of a workgroup; `None` for a stage that has no workgroups.
    pub(crate) workgroup_size: Option<[u32; 3]>,
    pub(crate) docs: Vec<String>,
}

/// The resources of one bind group.
#[derive(Debug)]
pub(crate) struct Group {
    pub(crate) number: u32,
    /// The module that declares it, where another one declares a group of this number too.
    pub(crate) module: Option<String>,
    /// By binding number.
    pub(crate) bindings: BTreeMap<u32, Bound>,
    /// The entry points that use one of them.
    pub(crate) entry_points: Vec<String>,
}

/// One resource.
#[derive(Debug)]
pub(crate) struct Bound {
    pub(crate) name: String,
    pub(crate) docs: Vec<String>,
    pub(crate) stages: BTreeSet<Stage>,
    pub(crate) resource: Resource,
}

/// Shader stage, ordered as wgpu writes its flags.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Stage {
    Vertex,
    Fragment,
    Compute,
}

/// What is bound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Resource {
    /// `size`: bytes that must be bound at least (one element, if the array's length is open).
    Uniform {
        size: u32,
        /// The type that the buffer holds one or more of, as WGSL spells it.
        holds: String,
    },
    Storage {
        size: u32,
        holds: String,
        read_only: bool,
    },
    Texture {
        sample: Sample,
        dimension: &'static str,
        multisampled: bool,
    },
    /// A texture that is written to: names of `wgpu::StorageTextureAccess` and `wgpu::TextureFormat`.
    StorageTexture {
        access: &'static str,
        format: String,
        dimension: &'static str,
    },
    Sampler {
        comparison: bool,
    },
}

/// What a texture holds and how it is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sample {
    /// `filterable` only if some sampler reads it: a texture that is only loaded from may be of any float format.
    Float {
        filterable: bool,
    },
    Sint,
    Uint,
    Depth,
}

/// The struct of a vertex shader's inputs.
#[derive(Debug)]
pub(crate) struct VertexInput {
    pub(crate) name: String,
    pub(crate) docs: Vec<String>,
    /// Name, docs, location and number of f32 components.
    pub(crate) attributes: Vec<(String, Vec<String>, u32, usize)>,
}

/// A resource for which no typed binding can be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no typed binding can be written for {name}: {reason}")]
pub(crate) struct UnsupportedBinding {
    name: String,
    reason: &'static str,
}

/// Reflects what `linked` became.
pub(crate) fn reflect(
    module: &Module,
    info: &ModuleInfo,
    linked: &Linked,
) -> Result<Reflection, UnsupportedBinding> {
    let docs = &linked.docs;
    let mut structures = Vec::new();
    for (_, global) in module.global_variables.iter().filter(|(_, global)| global.binding.is_some()) {
        if matches!(global.space, AddressSpace::Uniform | AddressSpace::Storage { .. }) {
            collect_structures(module, global.ty, &mut structures);
        }
    }
    let entry_points = module.entry_points.iter().map(|entry| EntryPoint {
        name: entry.name.clone(),
        stage: entry.stage,
        workgroup_size: (entry.stage == ShaderStage::Compute).then_some(entry.workgroup_size),
        docs: docs.of(&entry.name),
    });
    Ok(Reflection {
        entry_points: entry_points.collect(),
        groups: groups::of(module, info, linked)?,
        structures,
        vertex_inputs: vertex_inputs(module, docs),
    })
}

/// True if any entry point reads `image` through a sampler that filters.
fn is_filtered(module: &Module, info: &ModuleInfo, image: Handle<GlobalVariable>) -> bool {
    let is_filtering = |sampler: Handle<GlobalVariable>| {
        let ty = module.global_variables[sampler].ty;
        matches!(module.types[ty].inner, TypeInner::Sampler { comparison: false })
    };
    (0..module.entry_points.len()).any(|index| {
        let sampled = &info.get_entry_point(index).sampling_set;
        sampled.iter().any(|key| key.image == image && is_filtering(key.sampler))
    })
}

fn resource(
    module: &Module,
    info: &ModuleInfo,
    handle: Handle<GlobalVariable>,
    global: &GlobalVariable,
) -> Result<Resource, UnsupportedBinding> {
    let unsupported = |reason| UnsupportedBinding { name: global.name.clone().unwrap_or_default(), reason };
    match global.space {
        AddressSpace::Uniform | AddressSpace::Storage { .. } => {
            let (holds, size) = element(module, global.ty)
                .ok_or_else(|| unsupported("a buffer must hold structs, vectors or numbers"))?;
            Ok(match global.space {
                AddressSpace::Storage { access } => {
                    let read_only = !access.contains(StorageAccess::STORE);
                    Resource::Storage { size, holds, read_only }
                }
                _ => Resource::Uniform { size, holds },
            })
        }
        _ => match module.types[global.ty].inner {
            TypeInner::Sampler { comparison } => Ok(Resource::Sampler { comparison }),
            TypeInner::Image { dim, arrayed, class: ImageClass::Storage { format, access } } => {
                let access =
                    match (access.contains(StorageAccess::LOAD), access.contains(StorageAccess::STORE)) {
                        _ if access.contains(StorageAccess::ATOMIC) => "Atomic",
                        (true, true) => "ReadWrite",
                        (true, false) => "ReadOnly",
                        (false, _) => "WriteOnly",
                    };
                // naga's formats have the names of wgpu's.
                let format = format!("{format:?}");
                Ok(Resource::StorageTexture { access, format, dimension: dimension(dim, arrayed) })
            }
            TypeInner::Image { dim, arrayed, class } => {
                let (sample, multisampled) = match class {
                    ImageClass::Depth { multi } => (Sample::Depth, multi),
                    ImageClass::Sampled { kind: ScalarKind::Float, multi } => {
                        (Sample::Float { filterable: is_filtered(module, info, handle) }, multi)
                    }
                    ImageClass::Sampled { kind: ScalarKind::Sint, multi } => (Sample::Sint, multi),
                    ImageClass::Sampled { kind: ScalarKind::Uint, multi } => (Sample::Uint, multi),
                    _ => return Err(unsupported("external textures have no typed binding yet")),
                };
                Ok(Resource::Texture { sample, dimension: dimension(dim, arrayed), multisampled })
            }
            _ => Err(unsupported("it is neither a buffer, a texture nor a sampler")),
        },
    }
}

/// Name of a `wgpu::TextureViewDimension`.
fn dimension(dim: ImageDimension, arrayed: bool) -> &'static str {
    match (dim, arrayed) {
        (ImageDimension::D1, _) => "D1",
        (ImageDimension::D2, false) => "D2",
        (ImageDimension::D2, true) => "D2Array",
        (ImageDimension::D3, _) => "D3",
        (ImageDimension::Cube, false) => "Cube",
        (ImageDimension::Cube, true) => "CubeArray",
    }
}

/// The type that a buffer of type `ty` holds, as WGSL spells it, and the bytes of one of them.
fn element(module: &Module, ty: Handle<Type>) -> Option<(String, u32)> {
    let scalar = |scalar: Scalar| match scalar {
        Scalar::F32 => Some("f32"),
        Scalar::I32 => Some("i32"),
        Scalar::U32 => Some("u32"),
        _ => None,
    };
    let inner = &module.types[ty].inner;
    let name = match inner {
        TypeInner::Struct { span, .. } => return Some((module.types[ty].name.clone()?, *span)),
        TypeInner::Array { base, size, stride } => {
            let (name, _) = element(module, *base)?;
            let length = match size {
                naga::ArraySize::Constant(length) => length.get(),
                _ => 1,
            };
            return Some((name, stride * length));
        }
        TypeInner::Scalar(of) => scalar(*of)?.to_owned(),
        TypeInner::Atomic(of) => format!("atomic<{}>", scalar(*of)?),
        TypeInner::Vector { size, scalar: of } => format!("vec{}<{}>", *size as u32, scalar(*of)?),
        _ => return None,
    };
    Some((name, inner.try_size(module.to_ctx())?))
}

fn collect_structures(module: &Module, ty: Handle<Type>, found: &mut Vec<Handle<Type>>) {
    match &module.types[ty].inner {
        TypeInner::Struct { members, .. } => {
            for member in members {
                collect_structures(module, member.ty, found);
            }
            if !found.contains(&ty) {
                found.push(ty);
            }
        }
        TypeInner::Array { base, .. } => collect_structures(module, *base, found),
        _ => {}
    }
}

fn vertex_inputs(module: &Module, docs: &Docs) -> Vec<VertexInput> {
    let mut inputs: Vec<VertexInput> = Vec::new();
    let vertex = module.entry_points.iter().filter(|entry| entry.stage == ShaderStage::Vertex);
    for argument in vertex.flat_map(|entry| &entry.function.arguments) {
        let ty = &module.types[argument.ty];
        let (TypeInner::Struct { members, .. }, Some(name)) = (&ty.inner, &ty.name) else { continue };
        let attributes = members.iter().filter_map(|member| {
            let Some(Binding::Location { location, .. }) = member.binding else { return None };
            let components = match module.types[member.ty].inner {
                TypeInner::Scalar(naga::Scalar::F32) => 1,
                TypeInner::Vector { size, scalar: naga::Scalar::F32 } => size as usize,
                _ => return None,
            };
            let member = member.name.clone()?;
            Some((member.clone(), docs.of_member(name, &member), location, components))
        });
        let attributes = attributes.collect();
        let docs = docs.of(name);
        if inputs.iter().all(|input| input.name != *name) {
            inputs.push(VertexInput { name: name.clone(), docs, attributes });
        }
    }
    inputs
}
