//! Copies of statements: naga lets every expression be evaluated once, so a second copy needs expressions of its own.

use std::collections::HashMap;

use naga::{Arena, Block, Expression, Handle, ImageQuery, Range, SampleLevel, Span, Statement, SwitchCase};

use crate::Failure;

/// Copies of statements within one function.
pub(crate) struct Copier<'f> {
    expressions: &'f mut Arena<Expression>,
    /// Expressions of the original that have one in the copy.
    fresh: HashMap<Handle<Expression>, Handle<Expression>>,
}

impl<'f> Copier<'f> {
    pub(crate) fn new(expressions: &'f mut Arena<Expression>) -> Self {
        Self { expressions, fresh: HashMap::new() }
    }

    /// A copy of the block that evaluates nothing that the block evaluates.
    pub(crate) fn block(&mut self, block: &Block) -> Result<Block, Failure> {
        let mut copy = Block::new();
        for (statement, span) in block.span_iter() {
            let statement = self.statement(statement)?;
            copy.push(statement, *span);
        }
        Ok(copy)
    }

    fn of(&self, handle: Handle<Expression>) -> Handle<Expression> {
        self.fresh.get(&handle).copied().unwrap_or(handle)
    }

    fn of_option(&self, handle: Option<Handle<Expression>>) -> Option<Handle<Expression>> {
        handle.map(|handle| self.of(handle))
    }

    /// A new expression for one that the original evaluates.
    fn renewed(&mut self, handle: Handle<Expression>) -> Result<Handle<Expression>, Failure> {
        let expression = self.expression(&self.expressions[handle].clone())?;
        let fresh = self.expressions.append(expression, Span::UNDEFINED);
        self.fresh.insert(handle, fresh);
        Ok(fresh)
    }

    fn statement(&mut self, statement: &Statement) -> Result<Statement, Failure> {
        Ok(match statement {
            Statement::Emit(range) => {
                let mut fresh = Vec::new();
                for handle in range.clone() {
                    fresh.push(self.renewed(handle)?);
                }
                match (fresh.first(), fresh.last()) {
                    (Some(&first), Some(&last)) => Statement::Emit(Range::new_from_bounds(first, last)),
                    _ => Statement::Emit(range.clone()),
                }
            }
            Statement::Block(block) => Statement::Block(self.block(block)?),
            Statement::If { condition, accept, reject } => Statement::If {
                condition: self.of(*condition),
                accept: self.block(accept)?,
                reject: self.block(reject)?,
            },
            Statement::Switch { selector, cases } => {
                let mut copies = Vec::new();
                for case in cases {
                    copies.push(SwitchCase { body: self.block(&case.body)?, ..case.clone() });
                }
                Statement::Switch { selector: self.of(*selector), cases: copies }
            }
            Statement::Loop { body, continuing, break_if } => Statement::Loop {
                body: self.block(body)?,
                continuing: self.block(continuing)?,
                break_if: self.of_option(*break_if),
            },
            Statement::Break => Statement::Break,
            Statement::Continue => Statement::Continue,
            Statement::Return { value } => Statement::Return { value: self.of_option(*value) },
            Statement::Store { pointer, value } => {
                Statement::Store { pointer: self.of(*pointer), value: self.of(*value) }
            }
            Statement::ImageStore { image, coordinate, array_index, value } => Statement::ImageStore {
                image: self.of(*image),
                coordinate: self.of(*coordinate),
                array_index: self.of_option(*array_index),
                value: self.of(*value),
            },
            Statement::Call { function, arguments, result } => Statement::Call {
                function: *function,
                arguments: arguments.iter().map(|&argument| self.of(argument)).collect(),
                result: result.map(|result| self.renewed(result)).transpose()?,
            },
            other => return Err(Failure::CannotCopy(kind(other))),
        })
    }

    fn expression(&self, expression: &Expression) -> Result<Expression, Failure> {
        let of = |handle: &Handle<Expression>| self.of(*handle);
        let of_option = |handle: &Option<Handle<Expression>>| self.of_option(*handle);
        Ok(match expression {
            Expression::Literal(_)
            | Expression::Constant(_)
            | Expression::Override(_)
            | Expression::ZeroValue(_)
            | Expression::FunctionArgument(_)
            | Expression::GlobalVariable(_)
            | Expression::LocalVariable(_)
            | Expression::CallResult(_) => expression.clone(),
            Expression::Compose { ty, components } => {
                Expression::Compose { ty: *ty, components: components.iter().map(of).collect() }
            }
            Expression::Access { base, index } => Expression::Access { base: of(base), index: of(index) },
            Expression::AccessIndex { base, index } => {
                Expression::AccessIndex { base: of(base), index: *index }
            }
            Expression::Splat { size, value } => Expression::Splat { size: *size, value: of(value) },
            Expression::Swizzle { size, vector, pattern } => {
                Expression::Swizzle { size: *size, vector: of(vector), pattern: *pattern }
            }
            Expression::Load { pointer } => Expression::Load { pointer: of(pointer) },
            Expression::ImageSample {
                image,
                sampler,
                gather,
                coordinate,
                array_index,
                offset,
                level,
                depth_ref,
                clamp_to_edge,
            } => Expression::ImageSample {
                image: of(image),
                sampler: of(sampler),
                gather: *gather,
                coordinate: of(coordinate),
                array_index: of_option(array_index),
                offset: of_option(offset),
                level: match level {
                    SampleLevel::Exact(level) => SampleLevel::Exact(of(level)),
                    SampleLevel::Bias(bias) => SampleLevel::Bias(of(bias)),
                    SampleLevel::Gradient { x, y } => SampleLevel::Gradient { x: of(x), y: of(y) },
                    other => *other,
                },
                depth_ref: of_option(depth_ref),
                clamp_to_edge: *clamp_to_edge,
            },
            Expression::ImageLoad { image, coordinate, array_index, sample, level } => {
                Expression::ImageLoad {
                    image: of(image),
                    coordinate: of(coordinate),
                    array_index: of_option(array_index),
                    sample: of_option(sample),
                    level: of_option(level),
                }
            }
            Expression::ImageQuery { image, query } => Expression::ImageQuery {
                image: of(image),
                query: match query {
                    ImageQuery::Size { level } => ImageQuery::Size { level: of_option(level) },
                    other => *other,
                },
            },
            Expression::Unary { op, expr } => Expression::Unary { op: *op, expr: of(expr) },
            Expression::Binary { op, left, right } => {
                Expression::Binary { op: *op, left: of(left), right: of(right) }
            }
            Expression::Select { condition, accept, reject } => {
                Expression::Select { condition: of(condition), accept: of(accept), reject: of(reject) }
            }
            Expression::Derivative { axis, ctrl, expr } => {
                Expression::Derivative { axis: *axis, ctrl: *ctrl, expr: of(expr) }
            }
            Expression::Relational { fun, argument } => {
                Expression::Relational { fun: *fun, argument: of(argument) }
            }
            Expression::Math { fun, arg, arg1, arg2, arg3 } => Expression::Math {
                fun: *fun,
                arg: of(arg),
                arg1: of_option(arg1),
                arg2: of_option(arg2),
                arg3: of_option(arg3),
            },
            Expression::As { expr, kind, convert } => {
                Expression::As { expr: of(expr), kind: *kind, convert: *convert }
            }
            Expression::ArrayLength(array) => Expression::ArrayLength(of(array)),
            other => return Err(Failure::CannotCopy(kind(other))),
        })
    }
}

/// The name of a variant.
fn kind(of: &impl std::fmt::Debug) -> String {
    let text = format!("{of:?}");
    text.split([' ', '(', '{']).next().unwrap_or_default().to_owned()
}
