//! What a material set adds to its bindings: the enum, the table and the kernel.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use crate::clear::ClearMaterial;
use crate::docs::Docs;
use crate::file_names::{PROFILE_CURVES_FILE, PROFILE_TABLES_FILE};
use crate::identifier::{camel_case, screaming_case};
use crate::layout::{FieldType, Structure, structure};
use crate::material::MaterialSet;
use crate::value::Value;
use subsurface_kernel::{Estimator, KernelModule, KernelParts, RowBinding};

use super::{Paths, Slot, doc_attributes, gap_name, slots};

/// What the bindings of a material set are written from.
pub(crate) struct SetBindings<'a> {
    pub(crate) set: &'a MaterialSet,
    pub(crate) rows: &'a [Value],
    pub(crate) provenance: &'a str,
    /// What the generated `kernel()` returns.
    pub(crate) parts: &'a KernelParts,
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
    let (tables, profile_tables) = if bindings.parts.profile_tables().is_empty() {
        (TokenStream::new(), TokenStream::new())
    } else {
        let file = PROFILE_TABLES_FILE;
        let tables = quote! {
            /// The tables of tabulated profiles.
            #[allow(dead_code)]
            pub static PROFILE_TABLES: &[u8] = include_bytes!(#file);
        };
        (tables, quote!(.profile_tables(PROFILE_TABLES)))
    };
    let clear = clear_tokens(&bindings.set.clear, runtime);
    let curves = PROFILE_CURVES_FILE;
    let [curve_width, curve_height] = bindings.parts.curve_size().map(Literal::u32_unsuffixed);
    let kernel_module = kernel_module(bindings.parts.module(), runtime);
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
            /// The number in the parameter table of [`kernel`].
            pub const fn number(self) -> u32 {
                self as u32
            }
            /// The number in another kernel, such as one that was compiled from edited materials while the program runs;
            /// `None` if that holds no material of this name.
            pub fn number_in(self, kernel: &#runtime::LoadedKernel) -> Option<u32> {
                kernel.material_number(self.name())
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
        /// The name as in the material files.
        impl ::core::fmt::Display for Material {
            fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                f.pad(self.name())
            }
        }
        /// By the name as in the material files.
        impl ::core::str::FromStr for Material {
            type Err = #runtime::UnknownMaterial;
            fn from_str(name: &str) -> Result<Self, Self::Err> {
                Self::from_name(name).ok_or_else(|| #runtime::UnknownMaterial::Name(name.into()))
            }
        }
        /// By the number in the parameter table.
        impl TryFrom<u32> for Material {
            type Error = #runtime::UnknownMaterial;
            fn try_from(number: u32) -> Result<Self, Self::Error> {
                Self::ALL.get(number as usize).copied().ok_or(#runtime::UnknownMaterial::Number(number))
            }
        }
        /// SHA-256 of what the kernel was generated from.
        #[allow(dead_code)]
        pub const PROVENANCE: &str = #provenance;
        /// The parameter table, by material number.
        pub static MATERIALS: [#row_name; #count] = [#(#rows),*];
        #clear
        #tables
        /// The curves of all profiles: the bytes of an rgba32float texture, row by row.
        #[allow(dead_code)]
        pub static PROFILE_CURVES: &[u8] = include_bytes!(#curves);
        /// Width and height of the texture of curves, texels.
        #[allow(dead_code)]
        pub const CURVE_SIZE: [u32; 2] = [#curve_width, #curve_height];
        /// The kernel module as WGSL.
        #[allow(dead_code)]
        pub const WGSL: &str = include_str!("subsurface.wgsl");
        /// The kernel of this set, for the passes of the runtime.
        #[allow(dead_code)]
        pub fn kernel() -> #runtime::KernelParts {
            #runtime::KernelParts::builder(#kernel_module)
                .materials(
                    Material::NAMES,
                    #bytemuck::cast_slice::<_, u8>(&MATERIALS),
                    ::core::mem::size_of::<#row_name>() as u32,
                )
                .profile_curves(PROFILE_CURVES, CURVE_SIZE)
                #profile_tables
                .build()
                .expect("the parts of one compilation fit")
        }
    }
}

/// The clear materials as constants.
fn clear_tokens(materials: &[ClearMaterial], runtime: &TokenStream) -> TokenStream {
    if materials.is_empty() {
        return TokenStream::new();
    }
    let constants = materials.iter().map(|material| {
        let name = Ident::new(&screaming_case(&material.name), Span::call_site());
        let docs = doc_attributes(&material.docs, &format!("The clear material `{}`.", material.name));
        let absorption = material.absorption_per_mm.map(|value| number(value as f32));
        let [index, roughness] =
            [material.refractive_index, material.roughness].map(|value| number(value as f32));
        let shell = match material.shell_thickness_mm {
            Some(thickness) => {
                let thickness = number(thickness as f32);
                quote!(Some(#thickness))
            }
            None => quote!(None),
        };
        quote! {
            #docs
            pub const #name: #runtime::ClearMaterial = #runtime::ClearMaterial {
                absorption_per_mm: [#(#absorption),*],
                refractive_index: #index,
                roughness: #roughness,
                shell_thickness_mm: #shell,
            };
        }
    });
    quote! {
        /// Materials of the set that are clear: they absorb light, and do not scatter it.
        #[allow(dead_code)]
        pub mod clear { #(#constants)* }
    }
}

/// The module as an expression that makes it.
fn kernel_module(module: &KernelModule, runtime: &TokenStream) -> TokenStream {
    let variant = Ident::new(module.estimator().name(), Span::call_site());
    let taps = Literal::u32_unsuffixed(module.estimator().taps());
    let fields = match module.estimator() {
        Estimator::Interleaved { .. } | Estimator::ImportanceSampled { .. } => quote!({ taps: #taps }),
        Estimator::Separable { rotated, .. } => quote!({ taps: #taps, rotated: #rotated }),
        Estimator::Dense => TokenStream::new(),
    };
    let stride = Literal::u32_unsuffixed(module.row_stride());
    let binding = match module.row_binding() {
        RowBinding::Uniform => quote!(Uniform),
        RowBinding::Storage => quote!(Storage),
    };
    let entry_points = module.entry_points();
    let format = Ident::new(&format!("{:?}", module.output_format()), Span::call_site());
    let place = match module.output_format_place() {
        Some(place) => {
            let [start, end] = [place.start, place.end].map(Literal::usize_unsuffixed);
            quote!(Some(#start..#end))
        }
        None => quote!(None),
    };
    let tables = module.knot_stride().map(|stride| {
        let stride = Literal::u32_unsuffixed(stride);
        quote!(.with_profile_tables(#stride))
    });
    quote! {
        #runtime::KernelModule::new(
            #runtime::Estimator::#variant #fields,
            WGSL,
            #stride,
            #runtime::RowBinding::#binding,
        )
        .with_entry_points([#(#entry_points),*])
        .with_output_format(#runtime::OutputFormat::#format, #place)
        #tables
    }
}

/// `value`, which [`check`](crate::value_mismatch::check) accepts, as a Rust expression of the struct's type.
fn literal(module: &naga::Module, layout: &Structure, value: &Value) -> TokenStream {
    let name = Ident::new(&layout.name, Span::call_site());
    let fields = slots(layout).into_iter().map(|slot| match slot {
        Slot::Gap { offset, size } => {
            let name = gap_name(offset);
            let size = Literal::u32_unsuffixed(size);
            quote!(#name: [0; #size])
        }
        Slot::Field(field) => {
            let name = Ident::new(&field.name, Span::call_site());
            let expression = match (&field.ty, value.field(&field.name)) {
                (FieldType::Struct(handle), inner) => {
                    let inner_structure = structure(module, &Docs::default(), *handle);
                    inner_structure
                        .map(|s| literal(module, &s, inner.unwrap_or(&Value::Zero)))
                        .unwrap_or_default()
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
