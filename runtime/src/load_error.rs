//! Kernels that a device cannot hold.

/// A kernel that a device cannot hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The curves are larger than a texture may be.
    #[error(
        "the profiles' curves are a texture of {width}×{height} texels, and this device allows {limit} per side: give \
         the set fewer profiles, or ask for a larger `max_texture_dimension_2d`"
    )]
    Curves {
        /// Width, texels.
        width: u32,
        /// Height, texels.
        height: u32,
        /// Largest side on the device.
        limit: u32,
    },
    /// A table is larger than a buffer binding may be.
    #[error(
        "the kernel's {table} take {bytes} bytes, and this device binds {limit} at most: give the set fewer materials, \
         or ask for a larger `{limit_name}`"
    )]
    Table {
        /// What the table holds.
        table: &'static str,
        /// Bytes.
        bytes: u64,
        /// Largest binding on the device.
        limit: u64,
        /// Name of the limit in [`wgpu::Limits`](crate::wgpu::Limits).
        limit_name: &'static str,
    },
    /// Tables in storage buffers that the device does not have.
    #[error(
        "the kernel reads {needed} table{s} from storage buffers, and a shader of this device has {limit}: ask for a \
         larger `max_storage_buffers_per_shader_stage`, or give the set fewer materials and no tabulated profiles",
        s = if *needed == 1 { "" } else { "s" }
    )]
    StorageBuffers {
        /// Storage buffers that the kernel reads.
        needed: u32,
        /// What the device has.
        limit: u32,
    },
}
