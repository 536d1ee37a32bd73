//! A stage: one entry point of a kernel module, for one kind of device.

use std::collections::BTreeSet;

use naga::back::pipeline_constants::process_overrides;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Block, Function, Handle, Module, ShaderStage, Statement};
use subsurface_kernel::Estimator;
use subsurface_kernel::constants::PIXELS_OF_BLOCK;

use crate::Failure;
use crate::loops::blocks_of;

/// Pixels along each side of the tiles that the compute path lists: a workgroup takes one.
pub(crate) const TILE_SIDE: u32 = 16;

/// An entry point, with a module in which nothing is left to be overridden.
#[derive(Clone, Debug)]
pub(crate) struct Stage {
    pub(crate) estimator: Estimator,
    pub(crate) entry_point: String,
    pub(crate) kind: ShaderStage,
    /// Pixels of the frame that one invocation stands for; 0 where stages do not run per pixel, as vertices do not.
    pub(crate) pixels: f64,
    pub(crate) module: Module,
}

impl Stage {
    /// The stages of the subsurface pass in `wgsl`, those of the compute path first.
    pub(crate) fn all(estimator: Estimator, wgsl: &str) -> Result<Vec<Self>, Failure> {
        let failed = |error: String| Failure::Naga(estimator.to_string(), error);
        let parsed =
            naga::front::wgsl::parse_str(wgsl).map_err(|error| failed(error.emit_to_string(wgsl)))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::all())
            .validate(&parsed)
            .map_err(|error| failed(error.emit_to_string(wgsl)))?;
        let mut stages = Vec::new();
        for entry_point in estimator.entry_points() {
            let found = parsed.entry_points.iter().find(|found| found.name == entry_point);
            let Some(found) = found else {
                return Err(failed(format!("there is no entry point `{entry_point}`")));
            };
            let (module, _) =
                process_overrides(&parsed, &info, Some((found.stage, entry_point)), &Default::default())
                    .map_err(|error| failed(error.to_string()))?;
            let pixels = match found.stage {
                ShaderStage::Compute => {
                    let invocations = found.workgroup_size.iter().product::<u32>().max(1);
                    f64::from(TILE_SIDE * TILE_SIDE) / f64::from(invocations)
                }
                ShaderStage::Fragment if estimator.packs_pixels() => match entry_point {
                    "first_fragment" | "block_fragment" => f64::from(PIXELS_OF_BLOCK),
                    "square_fragment" => f64::from(4 * PIXELS_OF_BLOCK),
                    _ => 1.0,
                },
                ShaderStage::Fragment => 1.0,
                _ => 0.0,
            };
            stages.push(Self {
                estimator,
                entry_point: entry_point.to_owned(),
                kind: found.stage,
                pixels,
                module: module.into_owned(),
            });
        }
        stages.sort_by_key(|stage| (stage.kind != ShaderStage::Compute, stage.entry_point.clone()));
        Ok(stages)
    }

    /// The function of the entry point.
    pub(crate) fn function(&self) -> Option<&Function> {
        let own = self.module.entry_points.iter().find(|found| found.name == self.entry_point);
        own.map(|found| &found.function)
    }
}

/// The functions that an entry point reaches.
#[derive(Clone, Debug)]
pub(crate) struct Reached {
    entry_point: String,
    functions: BTreeSet<Handle<Function>>,
}

impl Reached {
    pub(crate) fn of(stage: &Stage) -> Self {
        let mut reached = Self { entry_point: stage.entry_point.clone(), functions: BTreeSet::new() };
        if let Some(function) = stage.function() {
            reached.visit(&stage.module, &function.body);
        }
        reached
    }

    fn visit(&mut self, module: &Module, block: &Block) {
        for statement in block {
            match statement {
                Statement::Call { function, .. } => {
                    if self.functions.insert(*function) {
                        self.visit(module, &module.functions[*function].body);
                    }
                }
                Statement::Loop { body, continuing, .. } => {
                    self.visit(module, body);
                    self.visit(module, continuing);
                }
                other => {
                    for inner in blocks_of(other) {
                        self.visit(module, inner);
                    }
                }
            }
        }
    }

    /// Names and bodies, the entry point's included.
    pub(crate) fn bodies<'m>(&self, module: &'m Module) -> Vec<(&'m str, &'m Block)> {
        let entry_point = module.entry_points.iter().find(|found| found.name == self.entry_point);
        let mut bodies: Vec<_> =
            entry_point.into_iter().map(|found| (found.name.as_str(), &found.function.body)).collect();
        for &handle in &self.functions {
            let function = &module.functions[handle];
            bodies.push((function.name.as_deref().unwrap_or_default(), &function.body));
        }
        bodies
    }
}
