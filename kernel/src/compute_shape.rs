//! How the compute path shares its work.

/// How the last compute stage of a kernel shares its work between invocations. Both give the same picture.
///
/// Only a kernel whose estimator [has a software shape](crate::Estimator::has_software_shape) has both; another has one
/// that serves every device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ComputeShape {
    /// For GPUs: an invocation takes a pixel, and a workgroup loads what its pixels share into workgroup memory. Few
    /// registers, so that many waves hide the time of a load.
    Hardware,
    /// For drivers that run on a CPU: an invocation takes four pixels and keeps what they share in registers. There,
    /// workgroup memory is slow, and registers that spill are not.
    Software,
}

impl ComputeShape {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Hardware, Self::Software];
}
