//! Loops, and how often they run.
//!
//! A compiler's estimate of a loop's cost assumes some number of rounds. To know the cost for the true number, a stage is
//! compiled with its loops written out: a short loop as all its rounds, which is what compilers make of it, and a loop
//! over taps as one copy of its body, or as two. The cost is linear in the rounds of each loop, so those two tell it for
//! any number.

use naga::{Arena, Block, Expression, Handle, Literal, Module, Statement, SwitchCase, SwitchValue};
use subsurface_kernel::Estimator;
use subsurface_kernel::constants::{PIXELS_OF_BLOCK, RING_TAPS};

use crate::Failure;
use crate::copy::Copier;
use crate::stage::{Reached, TILE_SIDE};

/// How often a loop runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rounds {
    /// A short loop, the same in every frame.
    Short(u32),
    /// A loop whose length is the set's or the workgroup's; in the mean, so that it may be no whole number.
    Long(f64),
}

impl Rounds {
    pub(crate) fn mean(self) -> f64 {
        match self {
            Self::Short(rounds) => f64::from(rounds),
            Self::Long(rounds) => rounds,
        }
    }
}

/// A loop: the function that it stands in, and how many loops stand before it there.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Loop {
    pub(crate) function: String,
    pub(crate) place: usize,
}

impl Loop {
    /// Rounds of the loop, for a filter that takes all taps of `estimator`; `None` where they have no bound that is known
    /// before the frame, as in `Dense`.
    pub(crate) fn rounds(&self, estimator: Estimator) -> Result<Option<Rounds>, Failure> {
        let taps = f64::from(estimator.taps());
        Ok(match (self.function.as_str(), self.place) {
            // A block's taps are those of its four pixels, less what the blocks around stand for.
            ("gather_far_field", 0) => {
                let ring = taps.min(f64::from(RING_TAPS));
                Some(Rounds::Long(f64::from(PIXELS_OF_BLOCK) * taps - ring))
            }
            ("with_block_ring", 0) => Some(Rounds::Long(8.0)),
            // What an invocation for each pixel of a tile loads: these and the pixels around them.
            ("load_tile", 0) => Some(Rounds::Long((f64::from(TILE_SIDE + 2) / f64::from(TILE_SIDE)).powi(2))),
            // Rows and columns of the blocks around, then the ring.
            ("subsurface_compute" | "subsurface_fragment", 0 | 1) => Some(Rounds::Short(3)),
            ("subsurface_compute" | "subsurface_fragment", 2) => Some(Rounds::Short(8)),
            ("gather_importance_sampled", 0) => Some(Rounds::Long(taps)),
            ("gather_line", 0) => Some(Rounds::Long((taps - 1.0) / 2.0)),
            // Both sides of the centre.
            ("gather_line", 1) => Some(Rounds::Short(2)),
            ("with_near" | "with_far" | "near_share" | "centre_share", _) => None,
            _ => return Err(Failure::UnknownLoop { function: self.function.clone(), place: self.place }),
        })
    }
}

/// The loops in what a stage reaches, in the order of their functions' names.
pub(crate) fn loops(module: &Module, reached: &Reached) -> Vec<Loop> {
    let mut found = Vec::new();
    for (name, body) in reached.bodies(module) {
        let mut count = 0;
        count_loops(body, &mut count);
        found.extend((0..count).map(|place| Loop { function: name.to_owned(), place }));
    }
    found.sort();
    found
}

fn count_loops(block: &Block, count: &mut usize) {
    for statement in block {
        if let Statement::Loop { body, continuing, .. } = statement {
            *count += 1;
            count_loops(body, count);
            count_loops(continuing, count);
        } else {
            for inner in blocks_of(statement) {
                count_loops(inner, count);
            }
        }
    }
}

/// The blocks within a statement that is no loop.
pub(crate) fn blocks_of(statement: &Statement) -> Vec<&Block> {
    match statement {
        Statement::Block(block) => vec![block],
        Statement::If { accept, reject, .. } => vec![accept, reject],
        Statement::Switch { cases, .. } => cases.iter().map(|case| &case.body).collect(),
        _ => Vec::new(),
    }
}

/// The module with each loop that `copies` knows written out as that many copies of its body.
pub(crate) fn written_out(module: &Module, copies: &[(Loop, u32)]) -> Result<Module, Failure> {
    let mut module = module.clone();
    for (_, function) in module.functions.iter_mut() {
        let name = function.name.clone().unwrap_or_default();
        write_out_function(function, &name, copies)?;
    }
    for entry_point in &mut module.entry_points {
        let name = entry_point.name.clone();
        write_out_function(&mut entry_point.function, &name, copies)?;
    }
    Ok(module)
}

fn write_out_function(
    function: &mut naga::Function,
    name: &str,
    copies: &[(Loop, u32)],
) -> Result<(), Failure> {
    let own: Vec<(usize, u32)> =
        copies.iter().filter(|(of, _)| of.function == name).map(|(of, count)| (of.place, *count)).collect();
    if own.is_empty() {
        return Ok(());
    }
    let zero = function.expressions.append(Expression::Literal(Literal::I32(0)), naga::Span::UNDEFINED);
    let body = std::mem::take(&mut function.body);
    let mut writer = Writer { expressions: &mut function.expressions, zero, copies: &own, place: 0 };
    function.body = writer.write_out(body)?;
    Ok(())
}

/// Writes the loops of one function out.
struct Writer<'f> {
    expressions: &'f mut Arena<Expression>,
    zero: Handle<Expression>,
    copies: &'f [(usize, u32)],
    /// Loops that were met.
    place: usize,
}

impl Writer<'_> {
    /// `block` with its loops written out. A copy is the only case of a switch, so that a break in it ends that copy.
    fn write_out(&mut self, block: Block) -> Result<Block, Failure> {
        let mut result = Block::new();
        for (statement, span) in block.span_into_iter() {
            match statement {
                Statement::Loop { body, continuing, break_if } => {
                    let own = self.place;
                    self.place += 1;
                    let body = self.write_out(body)?;
                    let mut continuing = self.write_out(continuing)?;
                    let Some((_, count)) = self.copies.iter().find(|(of, _)| *of == own) else {
                        result.push(Statement::Loop { body, continuing, break_if }, span);
                        continue;
                    };
                    let mut original = without_continue(without_guard(body));
                    original.append(&mut continuing);
                    for _ in 1..*count {
                        let copy = Copier::new(self.expressions).block(&original)?;
                        result.push(self.only_case(copy), span);
                    }
                    result.push(self.only_case(original), span);
                }
                Statement::Block(inner) => result.push(Statement::Block(self.write_out(inner)?), span),
                Statement::If { condition, accept, reject } => {
                    let (accept, reject) = (self.write_out(accept)?, self.write_out(reject)?);
                    result.push(Statement::If { condition, accept, reject }, span);
                }
                Statement::Switch { selector, cases } => {
                    let mut written = Vec::new();
                    for case in cases {
                        written.push(SwitchCase { body: self.write_out(case.body)?, ..case });
                    }
                    result.push(Statement::Switch { selector, cases: written }, span);
                }
                other => result.push(other, span),
            }
        }
        Ok(result)
    }

    fn only_case(&self, body: Block) -> Statement {
        let case = SwitchCase { value: SwitchValue::Default, body, fall_through: false };
        Statement::Switch { selector: self.zero, cases: vec![case] }
    }
}

/// A body without the `if !(condition) { break }` that a `for` begins with.
fn without_guard(body: Block) -> Block {
    let is_guard = |statement: &Statement| match statement {
        Statement::If { accept, reject, .. } => {
            let breaks = |block: &Block| matches!(block.iter().as_slice(), [Statement::Break]);
            (breaks(accept) && reject.is_empty()) || (breaks(reject) && accept.is_empty())
        }
        _ => false,
    };
    let mut is_first = true;
    let mut result = Block::new();
    for (statement, span) in body.span_into_iter() {
        if matches!(statement, Statement::If { .. }) && std::mem::take(&mut is_first) && is_guard(&statement)
        {
            continue;
        }
        result.push(statement, span);
    }
    result
}

/// A body whose `continue` ends the copy.
fn without_continue(block: Block) -> Block {
    let mut result = Block::new();
    for (statement, span) in block.span_into_iter() {
        let statement = match statement {
            Statement::Continue => Statement::Break,
            // Its own breaks and continues.
            inner @ Statement::Loop { .. } => inner,
            Statement::Block(block) => Statement::Block(without_continue(block)),
            Statement::If { condition, accept, reject } => {
                let (accept, reject) = (without_continue(accept), without_continue(reject));
                Statement::If { condition, accept, reject }
            }
            Statement::Switch { selector, cases } => {
                let within = |case: SwitchCase| SwitchCase { body: without_continue(case.body), ..case };
                Statement::Switch { selector, cases: cases.into_iter().map(within).collect() }
            }
            other => other,
        };
        result.push(statement, span);
    }
    result
}

/// The value for `rounds` of a function that is linear in the rounds of each long loop; `at` tells it for copies: of a
/// short loop all, of a long one two or one.
pub(crate) fn extrapolated<E>(
    rounds: &[Rounds],
    mut at: impl FnMut(&[u32]) -> Result<f64, E>,
) -> Result<f64, E> {
    let long: Vec<usize> =
        (0..rounds.len()).filter(|&place| matches!(rounds[place], Rounds::Long(_))).collect();
    let mut total = 0.0;
    for corner in 0..1u32 << long.len() {
        let mut weight = 1.0;
        let mut copies: Vec<u32> = rounds.iter().map(|rounds| rounds.mean() as u32).collect();
        for (bit, &place) in long.iter().enumerate() {
            copies[place] = 1 + (corner >> bit & 1);
            let own = rounds[place].mean();
            weight *= if copies[place] == 2 { own - 1.0 } else { 2.0 - own };
        }
        if weight != 0.0 {
            total += weight * at(&copies)?;
        }
    }
    Ok(total)
}

#[cfg(test)]
mod tests {
    use super::{Rounds, extrapolated};

    /// A stage of 10, a loop of 3 a round in which a short one of two costs 5 a round, and a loop of 7 a round.
    #[test]
    fn what_is_linear_in_each_loop_is_exact() {
        let cost = |outer: f64, inner: f64, other: f64| 10.0 + outer * (3.0 + 5.0 * inner) + 7.0 * other;
        let rounds = [Rounds::Long(8.0), Rounds::Short(2), Rounds::Long(1.25)];
        let found = extrapolated(&rounds, |copies| {
            assert!(copies[1] == 2 && copies[0] <= 2 && copies[2] <= 2, "{copies:?}");
            Ok::<f64, ()>(cost(f64::from(copies[0]), f64::from(copies[1]), f64::from(copies[2])))
        });
        assert!((found.expect("no copy fails") - cost(8.0, 2.0, 1.25)).abs() < 1e-12);
    }
}
