//! What a stage loads: counted in naga's IR, whose loads are those of the SPIR-V one by one.
//!
//! Where a branch depends on data, the dearer side counts; where it does not, the side that is taken. A loop counts as
//! often as it runs with all taps of the estimator.

use naga::{
    AddressSpace, Block, Expression, Function, GlobalVariable, Handle, Literal, Module, Statement, TypeInner,
};
use subsurface_kernel::Estimator;

use crate::Failure;
use crate::loops::{Loop, blocks_of};
use crate::stage::Stage;

/// Loads of one invocation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Loads {
    /// Texels and elements of storage buffers.
    pub(crate) count: f64,
    /// Their bytes.
    pub(crate) bytes: f64,
}

impl Loads {
    fn plus(self, other: Self) -> Self {
        Self { count: self.count + other.count, bytes: self.bytes + other.bytes }
    }

    pub(crate) fn times(self, factor: f64) -> Self {
        Self { count: factor * self.count, bytes: factor * self.bytes }
    }

    fn dearer(self, other: Self) -> Self {
        if (other.bytes, other.count) > (self.bytes, self.count) { other } else { self }
    }

    /// Loads of one invocation of a stage; `None` if a loop has no known number of rounds.
    pub(crate) fn of(stage: &Stage) -> Result<Option<Self>, Failure> {
        let Some(function) = stage.function() else { return Ok(Some(Self::default())) };
        let counter = Counter { module: &stage.module, estimator: stage.estimator };
        counter.function(function, &stage.entry_point, &[])
    }
}

/// Bytes of a texel of the texture that is bound as `name`.
///
/// Of those whose format the caller chooses, that of the passes' own G-buffer.
fn texel_bytes(name: &str, estimator: Estimator) -> Option<f64> {
    Some(match name {
        "irradiance_texture" | "surface_texture" => 8.0,
        "depth_texture" | "mean_free_path_scale_texture" => 4.0,
        "material_id_texture" => 1.0,
        "profile_curves" => 16.0,
        "pixel_texture" | "pixel_source" => 8.0,
        "intermediate_texture" | "intermediate_source" => match estimator {
            Estimator::Interleaved { .. } => 16.0,
            _ => 8.0,
        },
        "coarse_texture" | "coarse_source" => 8.0,
        _ => return None,
    })
}

struct Counter<'m> {
    module: &'m Module,
    estimator: Estimator,
}

/// An argument that is known.
#[derive(Clone, Copy, Debug)]
enum Argument {
    Texture(Handle<GlobalVariable>),
    Bool(bool),
}

/// A function that is counted: its textures may be arguments.
struct Frame<'f> {
    function: &'f Function,
    name: &'f str,
    arguments: &'f [Option<Argument>],
    /// Loops that were met.
    loops: usize,
}

/// Loads of a block, `None` if they cannot be known, and whether control goes past its end.
struct Counted {
    loads: Option<Loads>,
    goes_on: bool,
}

impl Counter<'_> {
    fn function(
        &self,
        function: &Function,
        name: &str,
        arguments: &[Option<Argument>],
    ) -> Result<Option<Loads>, Failure> {
        let mut frame = Frame { function, name, arguments, loops: 0 };
        Ok(self.block(&mut frame, &function.body)?.loads)
    }

    fn block(&self, frame: &mut Frame<'_>, block: &Block) -> Result<Counted, Failure> {
        let mut loads = Some(Loads::default());
        for statement in block {
            let counted = self.statement(frame, statement)?;
            loads = sum(loads, counted.loads);
            if !counted.goes_on {
                return Ok(Counted { loads, goes_on: false });
            }
        }
        Ok(Counted { loads, goes_on: true })
    }

    fn statement(&self, frame: &mut Frame<'_>, statement: &Statement) -> Result<Counted, Failure> {
        let on = |loads| Ok(Counted { loads, goes_on: true });
        match statement {
            Statement::Emit(range) => {
                let mut loads = Loads::default();
                for handle in range.clone() {
                    loads = loads.plus(self.expression(frame, handle)?);
                }
                on(Some(loads))
            }
            Statement::Call { function, arguments, .. } => {
                let callee = &self.module.functions[*function];
                let arguments: Vec<_> =
                    arguments.iter().map(|&argument| self.argument(frame, argument)).collect();
                let name = callee.name.as_deref().unwrap_or_default();
                on(self.function(callee, name, &arguments)?)
            }
            Statement::Block(inner) => self.block(frame, inner),
            Statement::If { condition, accept, reject } => {
                let accepted = self.block(frame, accept)?;
                let rejected = self.block(frame, reject)?;
                Ok(match self.constant_bool(frame, *condition) {
                    Some(true) => accepted,
                    Some(false) => rejected,
                    None => dearer(accepted, rejected),
                })
            }
            Statement::Switch { cases, .. } => {
                let mut all: Option<Counted> = None;
                for case in cases {
                    let counted = self.block(frame, &case.body)?;
                    all = Some(match all {
                        Some(others) => dearer(others, counted),
                        None => counted,
                    });
                }
                on(all.map_or(Some(Loads::default()), |counted| counted.loads))
            }
            Statement::Loop { body, continuing, .. } => {
                let own = Loop { function: frame.name.to_owned(), place: frame.loops };
                frame.loops += 1;
                let round = sum(self.block(frame, body)?.loads, self.block(frame, continuing)?.loads);
                let rounds = own.rounds(self.estimator)?;
                on(round.zip(rounds).map(|(loads, rounds)| loads.times(rounds.mean())))
            }
            Statement::Return { .. } | Statement::Kill => {
                Ok(Counted { loads: Some(Loads::default()), goes_on: false })
            }
            other => {
                debug_assert!(blocks_of(other).is_empty(), "a statement with blocks is counted above");
                on(Some(Loads::default()))
            }
        }
    }

    fn expression(&self, frame: &Frame<'_>, handle: Handle<Expression>) -> Result<Loads, Failure> {
        match frame.function.expressions[handle] {
            Expression::ImageLoad { image, .. } | Expression::ImageSample { image, .. } => {
                let name = global(frame, image)
                    .and_then(|global| self.module.global_variables[global].name.as_deref())
                    .unwrap_or("a texture without a name");
                let bytes = texel_bytes(name, self.estimator);
                let bytes = bytes.ok_or_else(|| Failure::UnknownTexture(name.to_owned()))?;
                Ok(Loads { count: 1.0, bytes })
            }
            Expression::Load { pointer } if self.is_in_storage(frame.function, pointer) => {
                // One element: what a row or a tile is read by.
                Ok(Loads { count: 1.0, bytes: f64::from(self.pointed_bytes(frame.function, pointer)) })
            }
            _ => Ok(Loads::default()),
        }
    }

    /// The variable at the root of a pointer.
    fn root(&self, function: &Function, mut pointer: Handle<Expression>) -> Option<Handle<GlobalVariable>> {
        loop {
            match function.expressions[pointer] {
                Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => pointer = base,
                Expression::GlobalVariable(global) => return Some(global),
                _ => return None,
            }
        }
    }

    fn is_in_storage(&self, function: &Function, pointer: Handle<Expression>) -> bool {
        let root = self.root(function, pointer);
        root.is_some_and(|global| {
            matches!(self.module.global_variables[global].space, AddressSpace::Storage { .. })
        })
    }

    /// Bytes of what a pointer into a global points to.
    fn pointed_bytes(&self, function: &Function, pointer: Handle<Expression>) -> u32 {
        self.pointed_type(function, pointer).map_or(0, |inner| inner.size(self.module.to_ctx()))
    }

    fn pointed_type<'m>(&'m self, function: &Function, pointer: Handle<Expression>) -> Option<&'m TypeInner> {
        let member = |base: &'m TypeInner, index: u32| match base {
            TypeInner::Struct { members, .. } => {
                members.get(index as usize).map(|member| &self.module.types[member.ty].inner)
            }
            TypeInner::Array { base, .. } => Some(&self.module.types[*base].inner),
            // A component counts as its vector, which is loaded at once.
            other => Some(other),
        };
        match function.expressions[pointer] {
            Expression::GlobalVariable(global) => {
                Some(&self.module.types[self.module.global_variables[global].ty].inner)
            }
            Expression::AccessIndex { base, index } => member(self.pointed_type(function, base)?, index),
            Expression::Access { base, .. } => member(self.pointed_type(function, base)?, 0),
            _ => None,
        }
    }

    fn argument(&self, frame: &Frame<'_>, expression: Handle<Expression>) -> Option<Argument> {
        let texture = global(frame, expression).map(Argument::Texture);
        texture.or_else(|| self.constant_bool(frame, expression).map(Argument::Bool))
    }

    fn constant_bool(&self, frame: &Frame<'_>, condition: Handle<Expression>) -> Option<bool> {
        let literal = |expression: &Expression| match expression {
            Expression::Literal(Literal::Bool(value)) => Some(*value),
            _ => None,
        };
        match &frame.function.expressions[condition] {
            Expression::FunctionArgument(place) => match frame.arguments.get(*place as usize) {
                Some(Some(Argument::Bool(value))) => Some(*value),
                _ => None,
            },
            Expression::Constant(constant) => {
                literal(&self.module.global_expressions[self.module.constants[*constant].init])
            }
            Expression::Unary { op: naga::UnaryOperator::LogicalNot, expr } => {
                self.constant_bool(frame, *expr).map(|value| !value)
            }
            other => literal(other),
        }
    }
}

/// The texture that an expression names: a global, or the argument that stands for one.
fn global(frame: &Frame<'_>, expression: Handle<Expression>) -> Option<Handle<GlobalVariable>> {
    match frame.function.expressions[expression] {
        Expression::GlobalVariable(global) => Some(global),
        Expression::FunctionArgument(place) => match frame.arguments.get(place as usize) {
            Some(Some(Argument::Texture(global))) => Some(*global),
            _ => None,
        },
        _ => None,
    }
}

fn sum(a: Option<Loads>, b: Option<Loads>) -> Option<Loads> {
    a.zip(b).map(|(a, b)| a.plus(b))
}

fn dearer(a: Counted, b: Counted) -> Counted {
    let loads = a.loads.zip(b.loads).map(|(a, b)| a.dearer(b));
    Counted { loads, goes_on: a.goes_on || b.goes_on }
}
