//! The stored tables: isotropic scattering, matched and with a relative refractive index of 1.4.
//!
//! Made by `examples/truth.rs` with the command in the header of each file in `reference/truth/`. Profile models are
//! judged by these.

use std::sync::LazyLock;

use crate::TruthTable;

macro_rules! stored {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        pub fn $name() -> &'static TruthTable {
            static TABLE: LazyLock<TruthTable> = LazyLock::new(|| {
                let text = include_str!(concat!("../truth/", stringify!($name), ".csv"));
                TruthTable::from_csv(text).expect("a stored table was written by to_csv")
            });
            &TABLE
        }
    };
}

stored! {
    /// Perpendicular entry, index-matched.
    searchlight
}
stored! {
    /// Cosine-distributed entry, index-matched.
    diffuse
}
stored! {
    /// Perpendicular entry into a medium of refractive index 1.4. Energies are per energy that entered: 0.0278 of the
    /// light was reflected before.
    searchlight_eta_1_4
}
stored! {
    /// Cosine-distributed light outside a medium of refractive index 1.4, of which the transmitted part enters.
    /// Energies are per energy that entered.
    diffuse_eta_1_4
}
