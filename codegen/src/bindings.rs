//! Rust bindings of a validated module: structs with layout asserts, bind groups, vertex layouts, entry points; and of
//! a material set: its enum, its table and its kernel.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use crate::compiler::PROFILE_TABLES_FILE;
use crate::docs::Docs;
use crate::identifier::camel_case;
use crate::layout::{Field, FieldType, Structure, structure};
use crate::material::MaterialSet;
use crate::reflect::{Bound, Reflection, Resource, Sample, Stage, VertexInput};
use crate::value::Value;

/// Paths under which the generated code finds what it needs.
#[derive(Clone, Debug)]
pub(crate) struct Paths {
    pub(crate) wgpu: TokenStream,
    pub(crate) bytemuck: TokenStream,
    pub(crate) runtime: TokenStream,
}

/// What the bindings of a material set are written from.
pub(crate) struct SetBindings<'a> {
    pub(crate) set: &'a MaterialSet,
    pub(crate) rows: &'a [Value],
    pub(crate) provenance: &'a str,
    /// Whether the kernel reads tables of profiles.
    pub(crate) has_tables: bool,
}

/// Docs of a generated item; `fallback` where the WGSL or RON has none, since generated code must not warn.
fn doc_attributes(lines: &[String], fallback: &str) -> TokenStream {
    let fallback = [fallback.to_owned()];
    let lines = if lines.iter().all(|line| line.is_empty()) { &fallback[..] } else { lines };
    let lines = lines.iter().map(|line| format!(" {}", without_links(line)));
    quote!(#(#[doc = #lines])*)
}

/// Escapes square brackets outside of code: a citation such as [CB15] is no link to an item.
fn without_links(line: &str) -> String {
    let mut escaped = String::with_capacity(line.len());
    let mut code = false;
    for character in line.chars() {
        code ^= character == '`';
        if !code && matches!(character, '[' | ']') {
            escaped.push('\\');
        }
        escaped.push(character);
    }
    escaped
}

/// Formats tokens; their own layout where they are no file (a defect that the consumer's compiler reports better).
pub(crate) fn format(header: &str, tokens: TokenStream) -> String {
    let body = match syn::parse2::<syn::File>(tokens.clone()) {
        Ok(file) => prettyplease::unparse(&file),
        Err(_) => tokens.to_string(),
    };
    format!("{header}\n{body}")
}

/// Structs, bind groups, vertex inputs and entry points; structs whose name is in `without` are left out.
pub(crate) fn module_tokens(
    module: &naga::Module,
    docs: &Docs,
    reflection: &Reflection,
    paths: &Paths,
    groups: impl Fn(u32) -> bool,
    without: &[&str],
) -> TokenStream {
    let mut tokens = TokenStream::new();
    for &handle in &reflection.structures {
        if let Some(structure) = structure(module, docs, handle)
            && !without.contains(&structure.name.as_str())
        {
            tokens.extend(structure_tokens(module, &structure, paths));
        }
    }
    for (number, group) in reflection.groups.iter().filter(|(number, _)| groups(**number)) {
        let bindings: Vec<_> = group.iter().map(|(binding, bound)| (*binding, bound)).collect();
        tokens.extend(bind_group_tokens(*number, &bindings, paths));
    }
    for input in &reflection.vertex_inputs {
        tokens.extend(vertex_tokens(input, paths));
    }
    for entry in &reflection.entry_points {
        let name = format_ident!("ENTRY_{}", entry.name.to_ascii_uppercase());
        let (text, fallback) = (&entry.name, format!("{:?} entry point `{}`.", entry.stage, entry.name));
        let docs = doc_attributes(&entry.docs, &fallback);
        tokens.extend(quote!(#docs #[allow(dead_code)] pub const #name: &str = #text;));
    }
    tokens
}

fn rust_type(module: &naga::Module, ty: &FieldType) -> TokenStream {
    match ty {
        FieldType::F32 => quote!(f32),
        FieldType::I32 => quote!(i32),
        FieldType::U32 => quote!(u32),
        FieldType::Vector { scalar, length } => {
            let scalar = Ident::new(scalar, Span::call_site());
            let length = Literal::usize_unsuffixed(*length);
            quote!([#scalar; #length])
        }
        FieldType::Matrix { columns, rows_padded } => {
            let columns = Literal::usize_unsuffixed(*columns);
            let rows = Literal::usize_unsuffixed(*rows_padded);
            quote!([[f32; #rows]; #columns])
        }
        FieldType::Array { element, length } => {
            let element = rust_type(module, element);
            let length = Literal::u32_unsuffixed(*length);
            quote!([#element; #length])
        }
        FieldType::Struct(handle) => {
            let name = module.types[*handle].name.clone().unwrap_or_default();
            let name = Ident::new(&name, Span::call_site());
            quote!(#name)
        }
    }
}

/// Fields with the gaps between them made visible: bytes that Rust would otherwise not place as WGSL does.
enum Slot<'a> {
    Field(&'a Field),
    Gap { offset: u32, size: u32 },
}

fn slots(structure: &Structure) -> Vec<Slot<'_>> {
    let mut slots = Vec::new();
    let mut end = 0;
    for field in &structure.fields {
        if field.offset > end {
            slots.push(Slot::Gap { offset: end, size: field.offset - end });
        }
        slots.push(Slot::Field(field));
        end = field.offset + field.size;
    }
    if structure.size > end {
        slots.push(Slot::Gap { offset: end, size: structure.size - end });
    }
    slots
}

fn gap_name(offset: u32) -> Ident {
    format_ident!("padding_{}", offset)
}

fn structure_tokens(module: &naga::Module, structure: &Structure, paths: &Paths) -> TokenStream {
    let bytemuck = &paths.bytemuck;
    let crate_path = bytemuck.to_string().replace(' ', "");
    let name = Ident::new(&structure.name, Span::call_site());
    let struct_docs = doc_attributes(&structure.docs, &format!("`{}` of the WGSL.", structure.name));
    let fields = slots(structure).into_iter().map(|slot| match slot {
        Slot::Field(field) => {
            let docs = doc_attributes(&field.docs, &format!("`{}` of the WGSL.", field.name));
            let name = Ident::new(&field.name, Span::call_site());
            let ty = rust_type(module, &field.ty);
            quote!(#docs pub #name: #ty)
        }
        Slot::Gap { offset, size } => {
            let name = gap_name(offset);
            let size = Literal::u32_unsuffixed(size);
            quote!(#[doc(hidden)] pub #name: [u8; #size])
        }
    });
    let size = Literal::u32_unsuffixed(structure.size);
    let size_message = format!("size of {} does not match WGSL", structure.name);
    let offsets = structure.fields.iter().map(|field| {
        let member = Ident::new(&field.name, Span::call_site());
        let offset = Literal::u32_unsuffixed(field.offset);
        let message = format!("offset of {}.{} does not match WGSL", structure.name, field.name);
        quote!(assert!(::core::mem::offset_of!(#name, #member) == #offset, #message);)
    });
    quote! {
        #struct_docs
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq, #bytemuck::Pod, #bytemuck::Zeroable)]
        #[bytemuck(crate = #crate_path)]
        #[allow(dead_code)]
        pub struct #name { #(#fields),* }
        const _: () = {
            assert!(::core::mem::size_of::<#name>() == #size, #size_message);
            #(#offsets)*
        };
    }
}

fn bind_group_tokens(number: u32, bindings: &[(u32, &Bound)], paths: &Paths) -> TokenStream {
    let wgpu = &paths.wgpu;
    let name = format_ident!("BindGroup{}", number);
    let names: Vec<_> =
        bindings.iter().map(|(_, bound)| Ident::new(&bound.name, Span::call_site())).collect();
    let fields = bindings.iter().zip(&names).map(|((binding, bound), name)| {
        let docs = doc_attributes(&bound.docs, &format!("`@group({number}) @binding({binding})`."));
        let ty = match bound.resource {
            Resource::Uniform { .. } | Resource::Storage { .. } => quote!(#wgpu::BufferBinding<'a>),
            Resource::Texture { .. } => quote!(&'a #wgpu::TextureView),
            Resource::Sampler { .. } => quote!(&'a #wgpu::Sampler),
        };
        quote!(#docs pub #name: #ty)
    });
    let layout_entries = bindings.iter().map(|(binding, bound)| layout_entry(*binding, bound, wgpu));
    let entries = bindings.iter().zip(&names).map(|((binding, bound), name)| {
        let binding = Literal::u32_unsuffixed(*binding);
        let resource = match bound.resource {
            Resource::Uniform { .. } | Resource::Storage { .. } => {
                quote!(#wgpu::BindingResource::Buffer(self.#name.clone()))
            }
            Resource::Texture { .. } => quote!(#wgpu::BindingResource::TextureView(self.#name)),
            Resource::Sampler { .. } => quote!(#wgpu::BindingResource::Sampler(self.#name)),
        };
        quote!(#wgpu::BindGroupEntry { binding: #binding, resource: #resource })
    });
    let count = Literal::usize_unsuffixed(bindings.len());
    let index = Literal::u32_unsuffixed(number);
    let list = bindings.iter().map(|(_, bound)| format!("`{}`", bound.name)).collect::<Vec<_>>().join(", ");
    let struct_doc = format!(" Resources of bind group {number}: {list}.");
    quote! {
        #[doc = #struct_doc]
        #[derive(Clone, Debug)]
        #[allow(dead_code)]
        pub struct #name<'a> { #(#fields),* }
        #[allow(dead_code)]
        impl #name<'_> {
            /// Number of the group in the WGSL.
            pub const INDEX: u32 = #index;
            /// Entries of the layout, by binding.
            pub const LAYOUT_ENTRIES: [#wgpu::BindGroupLayoutEntry; #count] = [#(#layout_entries),*];
            /// The group's layout.
            pub fn layout(device: &#wgpu::Device, label: &str) -> #wgpu::BindGroupLayout {
                device.create_bind_group_layout(&#wgpu::BindGroupLayoutDescriptor {
                    label: Some(label),
                    entries: &Self::LAYOUT_ENTRIES,
                })
            }
            /// The group itself.
            pub fn create(
                &self,
                device: &#wgpu::Device,
                layout: &#wgpu::BindGroupLayout,
                label: &str,
            ) -> #wgpu::BindGroup {
                device.create_bind_group(&#wgpu::BindGroupDescriptor {
                    label: Some(label),
                    layout,
                    entries: &[#(#entries),*],
                })
            }
        }
    }
}

fn layout_entry(binding: u32, bound: &Bound, wgpu: &TokenStream) -> TokenStream {
    let binding = Literal::u32_unsuffixed(binding);
    let stages = bound.stages.iter().map(|stage| match stage {
        Stage::Vertex => quote!(#wgpu::ShaderStages::VERTEX),
        Stage::Fragment => quote!(#wgpu::ShaderStages::FRAGMENT),
        Stage::Compute => quote!(#wgpu::ShaderStages::COMPUTE),
    });
    let mut visibility = quote!(#wgpu::ShaderStages::empty());
    for (index, stage) in stages.enumerate() {
        visibility = if index == 0 { stage } else { quote!(#visibility.union(#stage)) };
    }
    let buffer = |ty: TokenStream, size: u32| {
        let size = Literal::u64_unsuffixed(u64::from(size));
        quote!(#wgpu::BindingType::Buffer {
            ty: #ty,
            has_dynamic_offset: false,
            min_binding_size: #wgpu::BufferSize::new(#size),
        })
    };
    let ty = match &bound.resource {
        Resource::Uniform { size, .. } => buffer(quote!(#wgpu::BufferBindingType::Uniform), *size),
        Resource::Storage { size, read_only, .. } => {
            buffer(quote!(#wgpu::BufferBindingType::Storage { read_only: #read_only }), *size)
        }
        Resource::Texture { sample, dimension, multisampled } => {
            let sample = match sample {
                Sample::Float { filterable } => quote!(Float { filterable: #filterable }),
                Sample::Sint => quote!(Sint),
                Sample::Uint => quote!(Uint),
                Sample::Depth => quote!(Depth),
            };
            let dimension = Ident::new(dimension, Span::call_site());
            quote!(#wgpu::BindingType::Texture {
                sample_type: #wgpu::TextureSampleType::#sample,
                view_dimension: #wgpu::TextureViewDimension::#dimension,
                multisampled: #multisampled,
            })
        }
        Resource::Sampler { comparison } => {
            let ty = if *comparison { quote!(Comparison) } else { quote!(Filtering) };
            quote!(#wgpu::BindingType::Sampler(#wgpu::SamplerBindingType::#ty))
        }
    };
    quote!(#wgpu::BindGroupLayoutEntry { binding: #binding, visibility: #visibility, ty: #ty, count: None })
}

fn vertex_tokens(input: &VertexInput, paths: &Paths) -> TokenStream {
    let (wgpu, bytemuck) = (&paths.wgpu, &paths.bytemuck);
    let crate_path = bytemuck.to_string().replace(' ', "");
    let name = Ident::new(&input.name, Span::call_site());
    let struct_docs = doc_attributes(&input.docs, &format!("Vertex input `{}` of the WGSL.", input.name));
    let fields = input.attributes.iter().map(|(name, lines, location, components)| {
        let docs = doc_attributes(lines, &format!("`@location({location}) {name}`."));
        let name = Ident::new(name, Span::call_site());
        let components = Literal::usize_unsuffixed(*components);
        quote!(#docs pub #name: [f32; #components])
    });
    let mut offset = 0;
    let attributes: Vec<_> = input
        .attributes
        .iter()
        .map(|(_, _, location, components)| {
            let format = match components {
                1 => format_ident!("Float32"),
                count => format_ident!("Float32x{}", count),
            };
            let here = Literal::u64_unsuffixed(offset);
            offset += 4 * *components as u64;
            let location = Literal::u32_unsuffixed(*location);
            quote!(#wgpu::VertexAttribute {
                format: #wgpu::VertexFormat::#format,
                offset: #here,
                shader_location: #location,
            })
        })
        .collect();
    let stride = Literal::u64_unsuffixed(offset);
    quote! {
        #struct_docs
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq, #bytemuck::Pod, #bytemuck::Zeroable)]
        #[bytemuck(crate = #crate_path)]
        #[allow(dead_code)]
        pub struct #name { #(#fields),* }
        #[allow(dead_code)]
        impl #name {
            /// Layout of a vertex buffer of these.
            pub const LAYOUT: #wgpu::VertexBufferLayout<'static> = #wgpu::VertexBufferLayout {
                array_stride: #stride,
                step_mode: #wgpu::VertexStepMode::Vertex,
                attributes: &[#(#attributes),*],
            };
        }
    }
}

/// The enum of the materials, their table and their kernel.
pub(crate) fn set_tokens(
    module: &naga::Module,
    bindings: &SetBindings<'_>,
    row: &Structure,
    paths: &Paths,
) -> TokenStream {
    let runtime = &paths.runtime;
    let bytemuck = &paths.bytemuck;
    let count = Literal::usize_unsuffixed(bindings.set.materials.len());
    let names: Vec<_> = bindings.set.materials.iter().map(|material| material.name.as_str()).collect();
    let variants: Vec<_> =
        names.iter().map(|name| Ident::new(&camel_case(name), Span::call_site())).collect();
    let declarations =
        bindings.set.materials.iter().zip(&variants).enumerate().map(|(number, (material, variant))| {
            let docs = doc_attributes(&material.docs, &format!("The material `{}`.", material.name));
            let number = Literal::usize_unsuffixed(number);
            quote!(#docs #variant = #number)
        });
    let rows = bindings.rows.iter().map(|value| literal(module, row, value));
    let row_name = Ident::new(&row.name, Span::call_site());
    let provenance = bindings.provenance;
    let (tables, profile_tables) = if bindings.has_tables {
        let file = PROFILE_TABLES_FILE;
        let tables = quote! {
            /// The tables of tabulated profiles.
            #[allow(dead_code)]
            pub static PROFILE_TABLES: &[u8] = include_bytes!(#file);
        };
        (tables, quote!(PROFILE_TABLES))
    } else {
        (TokenStream::new(), quote!(&[]))
    };
    quote! {
        /// The materials of the set. `as u32` is the number that the G-buffer's surface target holds.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u32)]
        #[allow(dead_code)]
        pub enum Material { #(#declarations),* }
        #[allow(dead_code)]
        impl Material {
            /// Every material, by number.
            pub const ALL: [Self; #count] = [#(Self::#variants),*];
            /// Names as in the material files, by number.
            pub const NAMES: [&'static str; #count] = [#(#names),*];
            /// The number in the parameter table.
            pub const fn number(self) -> u32 {
                self as u32
            }
            /// The name as in the material files.
            pub const fn name(self) -> &'static str {
                Self::NAMES[self as usize]
            }
            /// The row of the parameter table.
            pub fn parameters(self) -> &'static #row_name {
                &MATERIALS[self as usize]
            }
            /// What the surface target holds where this material is: its surface albedo and its number.
            pub fn surface_texel(self) -> [f32; 4] {
                let [red, green, blue] = self.parameters().surface.surface_albedo;
                [red, green, blue, self.number() as f32]
            }
            /// The material of that name.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|material| material.name() == name)
            }
        }
        /// SHA-256 of what the kernel was generated from.
        #[allow(dead_code)]
        pub const PROVENANCE: &str = #provenance;
        /// The parameter table, by material number.
        pub static MATERIALS: [#row_name; #count] = [#(#rows),*];
        #tables
        /// The kernel module as WGSL.
        #[allow(dead_code)]
        pub const WGSL: &str = include_str!("subsurface.wgsl");
        /// The kernel of this set, for the passes of the runtime.
        #[allow(dead_code)]
        pub fn kernel() -> #runtime::SubsurfaceKernel {
            #runtime::SubsurfaceKernel::from_generated(
                WGSL,
                #bytemuck::cast_slice(&MATERIALS),
                &Material::NAMES,
                #profile_tables,
            )
        }
    }
}

/// `value` as a Rust expression of the struct's type; fields that the value does not name are zero.
fn literal(module: &naga::Module, structure: &Structure, value: &Value) -> TokenStream {
    let name = Ident::new(&structure.name, Span::call_site());
    let fields = slots(structure).into_iter().map(|slot| match slot {
        Slot::Gap { offset, size } => {
            let name = gap_name(offset);
            let size = Literal::u32_unsuffixed(size);
            quote!(#name: [0; #size])
        }
        Slot::Field(field) => {
            let name = Ident::new(&field.name, Span::call_site());
            let expression = match (&field.ty, value.field(&field.name)) {
                (FieldType::Struct(handle), inner) => {
                    let zero = Value::Struct(Vec::new());
                    let inner_structure = self::structure(module, &Docs::default(), *handle);
                    inner_structure.map(|s| literal(module, &s, inner.unwrap_or(&zero))).unwrap_or_default()
                }
                (_, Some(Value::F32(value))) => number(*value),
                (_, Some(Value::U32(value))) => {
                    let value = Literal::u32_unsuffixed(*value);
                    quote!(#value)
                }
                (_, Some(Value::Vector(components))) => {
                    let components = components.iter().map(|component| number(*component));
                    quote!([#(#components),*])
                }
                (FieldType::F32, _) => quote!(0.0),
                (FieldType::U32 | FieldType::I32, _) => quote!(0),
                (FieldType::Vector { scalar: "f32", length }, _) => {
                    let length = Literal::usize_unsuffixed(*length);
                    quote!([0.0; #length])
                }
                _ => unreachable!("rows hold scalars and f32 vectors: {}", field.name),
            };
            quote!(#name: #expression)
        }
    });
    quote!(#name { #(#fields),* })
}

/// A float literal; `proc_macro2` refuses negative ones, so the sign stands before it.
fn number(value: f32) -> TokenStream {
    let magnitude = Literal::f32_unsuffixed(value.abs());
    if value.is_sign_negative() { quote!(-#magnitude) } else { quote!(#magnitude) }
}
