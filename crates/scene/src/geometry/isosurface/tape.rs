//! An expression as a list of operations on registers, evaluated for up to sixteen rays at once.
//!
//! A tape runs over any [`Quantity`]: values with derivatives ([`super::jet::Jet`]) or affine forms over a segment of a
//! ray ([`super::affine_form::AffineForm`]).
use fearless_simd_macros::simd;

use super::{
    graph::{Graph, Id, Node, Op},
    parse_error::ParseError,
};
use noisefall_base::math::Lanes;

/// Number of registers. The first three hold x, y and z.
pub(super) const REGISTERS: usize = 32;
/// Maximum number of operations.
const LONGEST: usize = 256;

/// A type that a tape can compute with.
pub(super) trait Quantity<L: Lanes>: Copy {
    fn constant(l: L, value: f32) -> Self;
    fn add_constant(&self, by: f32) -> Self;
    fn scale(&self, by: f32) -> Self;
    fn add(&self, b: &Self) -> Self;
    fn subtract(&self, b: &Self) -> Self;
    fn multiply(&self, b: &Self) -> Self;
    fn square(&self) -> Self;
    fn reciprocal(&self) -> Self;
    fn square_root(&self) -> Self;
    fn absolute(&self) -> Self;
    fn minimum(&self, b: &Self) -> Self;
    fn maximum(&self, b: &Self) -> Self;
    fn exponential(&self) -> Self;
    fn logarithm(&self) -> Self;
    fn sine(&self) -> Self;
    fn cosine(&self) -> Self;
}

#[derive(Clone, Copy, Debug)]
struct Instruction {
    op: Op,
    to: u8,
    operands: [u8; 2],
    constant: f32,
}

#[derive(Clone, Debug)]
pub(super) struct Tape {
    instructions: Vec<Instruction>,
    result: u8,
}

impl Tape {
    /// Compiles the operations that the node `root` needs. `text` is for messages only.
    pub fn new(graph: &Graph, root: Id, text: &str) -> Result<Tape, ParseError> {
        let whole = |message: &str, label: &str| ParseError::new(0..text.len(), message, label);
        if graph.value(root).is_some() {
            return Err(whole("the expression is the same number everywhere", "it must depend on x, y or z"));
        }
        let last_uses = last_uses(graph, root);
        let mut registers = Registers { free: (3..REGISTERS as u8).rev().collect(), of: vec![0; graph.nodes().len()] };
        let mut instructions = Vec::new();
        for (id, node) in graph.nodes().iter().enumerate() {
            let Some(_) = last_uses[id] else { continue };
            if let Some(axis) = axis(node.op) {
                registers.of[id] = axis;
                continue;
            }
            let instruction = registers.allocate(node, id, &last_uses).ok_or_else(|| {
                whole("the expression is too complex", "needs more intermediate results than there are registers")
            })?;
            instructions.push(instruction);
        }
        if instructions.len() > LONGEST {
            return Err(whole("the expression is too long", "more than 256 operations"));
        }
        Ok(Tape { instructions, result: registers.of[root.0] })
    }

    #[cfg(test)]
    pub fn len(&self) -> usize {
        self.instructions.len()
    }
}

/// The register of a variable.
fn axis(op: Op) -> Option<u8> {
    match op {
        Op::X => Some(0),
        Op::Y => Some(1),
        Op::Z => Some(2),
        _ => None,
    }
}

/// For each node, the last one that uses it; `None` if `root` does not need it.
fn last_uses(graph: &Graph, root: Id) -> Vec<Option<usize>> {
    let mut last = vec![None; graph.nodes().len()];
    last[root.0] = Some(usize::MAX);
    for id in (0..=root.0).rev() {
        if last[id].is_some() {
            let node = &graph.nodes()[id];
            for operand in &node.operands[..node.op.operands()] {
                last[operand.0] = last[operand.0].or(Some(id));
            }
        }
    }
    last
}

/// The free registers, and the register of each node.
struct Registers {
    free: Vec<u8>,
    of: Vec<u8>,
}

impl Registers {
    /// Allocates a register for a node; `None` if there is none left.
    fn allocate(&mut self, node: &Node, id: usize, last_uses: &[Option<usize>]) -> Option<Instruction> {
        let operands = node.operands.map(|operand| self.of[operand.0]);
        let used = &node.operands[..node.op.operands()];
        for (place, operand) in used.iter().enumerate() {
            let register = self.of[operand.0];
            if last_uses[operand.0] == Some(id) && register > 2 && !used[..place].contains(operand) {
                self.free.push(register);
            }
        }
        let to = self.free.pop()?;
        self.of[id] = to;
        Some(Instruction { op: node.op, to, operands, constant: node.constant() as f32 })
    }
}

/// Evaluates the expression at the x, y and z in the first three registers, which are preserved. The others may hold anything.
#[simd]
pub(super) fn run<L: Lanes, Q: Quantity<L>>(l: L, tape: &Tape, registers: &mut [Q; REGISTERS]) -> Q {
    const MASK: usize = REGISTERS - 1;
    for instruction in &tape.instructions {
        let a = &registers[usize::from(instruction.operands[0]) & MASK];
        let b = &registers[usize::from(instruction.operands[1]) & MASK];
        let value = match instruction.op {
            Op::X | Op::Y | Op::Z => *a,
            Op::Constant => Q::constant(l, instruction.constant),
            Op::AddConstant => a.add_constant(instruction.constant),
            Op::Scale => a.scale(instruction.constant),
            Op::Add => a.add(b),
            Op::Subtract => a.subtract(b),
            Op::Multiply => a.multiply(b),
            Op::Square => a.square(),
            Op::Reciprocal => a.reciprocal(),
            Op::SquareRoot => a.square_root(),
            Op::Absolute => a.absolute(),
            Op::Minimum => a.minimum(b),
            Op::Maximum => a.maximum(b),
            Op::Exponential => a.exponential(),
            Op::Logarithm => a.logarithm(),
            Op::Sine => a.sine(),
            Op::Cosine => a.cosine(),
        };
        registers[usize::from(instruction.to) & MASK] = value;
    }
    registers[usize::from(tape.result) & MASK]
}
