//! The error of a kernel that was chosen by it, and the tap counts of other tiers.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use subsurface_quality::{QualityReport, TierReport};

/// The error as constants, and the tiers as an enum.
pub(crate) fn quality_tokens(report: &QualityReport) -> TokenStream {
    let [error, worst_pixel] = [report.error, report.worst_pixel].map(Literal::f64_unsuffixed);
    let variants: Vec<_> =
        report.tiers.iter().map(|tier| Ident::new(tier.tier.name(), Span::call_site())).collect();
    let declarations = report.tiers.iter().zip(&variants).map(|(tier, variant)| {
        let docs = format!(" {}", described(tier));
        quote!(#[doc = #docs] #variant)
    });
    let taps = report.tiers.iter().map(|tier| Literal::u32_unsuffixed(tier.taps));
    let errors = report.tiers.iter().map(|tier| Literal::f64_unsuffixed(tier.error));
    let count = Literal::usize_unsuffixed(report.tiers.len());
    let kernel = format!(" Tap counts of this set's kernel, `{}`, by quality.", report.estimator.name());
    quote! {
        /// Error of this set's kernel: the root mean square difference from the exact result over the pixels of a
        /// picture, as a fraction of the white level; the largest over edges, a line, discs, a crease, a ball and a
        /// frame, where the mean radius of the profile spans 1 to 100 pixels, over channels and materials.
        #[allow(dead_code)]
        pub const KERNEL_ERROR: f64 = #error;
        /// Largest difference of a single pixel in the same pictures.
        #[allow(dead_code)]
        pub const KERNEL_WORST_PIXEL: f64 = #worst_pixel;
        #[doc = #kernel]
        ///
        /// For views with a number of taps of their own.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[allow(dead_code)]
        pub enum Quality { #(#declarations),* }
        #[allow(dead_code)]
        impl Quality {
            /// Every tier, the worst first.
            pub const ALL: [Self; #count] = [#(Self::#variants),*];
            /// The fewest taps within the tier's error, or the best number of taps where none is.
            pub const fn taps(self) -> u32 {
                match self { #(Self::#variants => #taps),* }
            }
            /// The error with that many, measured as `KERNEL_ERROR` is.
            pub const fn error(self) -> f64 {
                match self { #(Self::#variants => #errors),* }
            }
        }
    }
}

fn described(tier: &TierReport) -> String {
    let target = tier.tier.target();
    if tier.error <= target {
        format!("An error of at most {target}.")
    } else {
        format!("An error of at most {target} is out of this kernel's reach: its least error.")
    }
}
