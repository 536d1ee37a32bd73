//! Bind groups as Rust: the resources by name, and their layout.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use crate::identifier::camel_case;
use crate::reflect::{Bound, Group, Resource, Sample, Stage};

use super::{Paths, doc_attributes};

/// The struct of a group: `BindGroup1`, or `GbufferBindGroup2` where other modules declare a group 2 too.
pub(super) fn tokens(group: &Group, paths: &Paths) -> TokenStream {
    let wgpu = &paths.wgpu;
    let number = group.number;
    let prefix = group.module.as_deref().map(prefix).unwrap_or_default();
    let name = format_ident!("{prefix}BindGroup{number}");
    let bindings: Vec<(u32, &Bound)> =
        group.bindings.iter().map(|(binding, bound)| (*binding, bound)).collect();
    let names: Vec<_> =
        bindings.iter().map(|(_, bound)| Ident::new(&bound.name, Span::call_site())).collect();
    let fields = bindings.iter().zip(&names).map(|((binding, bound), name)| {
        let docs = doc_attributes(&bound.docs, &format!("`@group({number}) @binding({binding})`."));
        let ty = match bound.resource {
            Resource::Uniform { .. } | Resource::Storage { .. } => quote!(#wgpu::BufferBinding<'a>),
            Resource::Texture { .. } | Resource::StorageTexture { .. } => quote!(&'a #wgpu::TextureView),
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
            Resource::Texture { .. } | Resource::StorageTexture { .. } => {
                quote!(#wgpu::BindingResource::TextureView(self.#name))
            }
            Resource::Sampler { .. } => quote!(#wgpu::BindingResource::Sampler(self.#name)),
        };
        quote!(#wgpu::BindGroupEntry { binding: #binding, resource: #resource })
    });
    let count = Literal::usize_unsuffixed(bindings.len());
    let index = Literal::u32_unsuffixed(number);
    let list = bindings.iter().map(|(_, bound)| format!("`{}`", bound.name)).collect::<Vec<_>>().join(", ");
    let of_module = group.module.as_ref().map(|module| format!(" of `{module}`")).unwrap_or_default();
    let struct_doc = format!(" Resources of bind group {number}{of_module}: {list}.");
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
        Resource::StorageTexture { access, format, dimension } => {
            let access = Ident::new(access, Span::call_site());
            let format = Ident::new(format, Span::call_site());
            let dimension = Ident::new(dimension, Span::call_site());
            quote!(#wgpu::BindingType::StorageTexture {
                access: #wgpu::StorageTextureAccess::#access,
                format: #wgpu::TextureFormat::#format,
                view_dimension: #wgpu::TextureViewDimension::#dimension,
            })
        }
        Resource::Sampler { comparison } => {
            let ty = if *comparison { quote!(Comparison) } else { quote!(Filtering) };
            quote!(#wgpu::BindingType::Sampler(#wgpu::SamplerBindingType::#ty))
        }
    };
    quote!(#wgpu::BindGroupLayoutEntry { binding: #binding, visibility: #visibility, ty: #ty, count: None })
}

/// A module as the beginning of a type's name: `passes/gbuffer` as `Gbuffer`. Callers name their passes as they like.
fn prefix(module: &str) -> String {
    let stem = module.rsplit('/').next().unwrap_or(module);
    let words: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    let name = camel_case(&words);
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("Pass{name}") }
}
