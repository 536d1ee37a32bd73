//! Rust bindings of a validated module: structs with layout asserts, bind groups, vertex layouts, entry points; and of
//! a material set: its enum, its table and its kernel.

mod bind_group;
mod quality;
mod set;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use crate::docs::Docs;
use crate::layout::{Field, FieldType, Structure, structure};
use crate::reflect::{Reflection, VertexInput};

pub(crate) use quality::quality_tokens;
pub(crate) use set::{SetBindings, set_tokens};

/// Paths under which the generated code finds what it needs.
#[derive(Clone, Debug)]
pub(crate) struct Paths {
    pub(crate) wgpu: TokenStream,
    pub(crate) bytemuck: TokenStream,
    pub(crate) runtime: TokenStream,
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
    for group in reflection.groups.iter().filter(|group| groups(group.number)) {
        tokens.extend(bind_group::tokens(group, paths));
    }
    for input in &reflection.vertex_inputs {
        tokens.extend(vertex_tokens(input, paths));
    }
    for entry in &reflection.entry_points {
        let name = format_ident!("ENTRY_{}", entry.name.to_ascii_uppercase());
        let (text, fallback) = (&entry.name, format!("{:?} entry point `{}`.", entry.stage, entry.name));
        let docs = doc_attributes(&entry.docs, &fallback);
        tokens.extend(quote!(#docs #[allow(dead_code)] pub const #name: &str = #text;));
        if let Some([x, y, z]) = entry.workgroup_size.map(|size| size.map(Literal::u32_unsuffixed)) {
            let name = format_ident!("WORKGROUP_{}", entry.name.to_ascii_uppercase());
            let doc = format!(" Invocations of a workgroup of `{text}`.");
            tokens
                .extend(quote!(#[doc = #doc] #[allow(dead_code)] pub const #name: [u32; 3] = [#x, #y, #z];));
        }
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
        #[derive(Clone, Copy, Debug, Default, PartialEq, #bytemuck::Pod, #bytemuck::Zeroable)]
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
