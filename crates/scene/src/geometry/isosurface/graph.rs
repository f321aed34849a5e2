//! Expressions as a graph: equal subexpressions are the same node, constants are folded, and operations without effect are
//! dropped.
use std::collections::HashMap;

use super::functions;
use noisefall_base::math::{F, One};

/// The operation of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Op {
    X,
    Y,
    Z,
    Constant,
    AddConstant,
    Scale,
    Add,
    Subtract,
    Multiply,
    Square,
    /// 1/a; the sign changes at the pole.
    Reciprocal,
    /// √max(a, 0)
    SquareRoot,
    Absolute,
    Minimum,
    Maximum,
    Exponential,
    /// log of the larger of a and the smallest normal number.
    Logarithm,
    Sine,
    Cosine,
}

impl Op {
    pub fn operands(self) -> usize {
        match self {
            Op::X | Op::Y | Op::Z | Op::Constant => 0,
            Op::Add | Op::Subtract | Op::Multiply | Op::Minimum | Op::Maximum => 2,
            _ => 1,
        }
    }
}

/// The index of a node in its graph; operands precede their users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Id(pub usize);

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Node {
    pub op: Op,
    /// The operands; unused ones are node 0.
    pub operands: [Id; 2],
    constant_bits: u64,
}

impl Node {
    pub fn constant(&self) -> f64 {
        f64::from_bits(self.constant_bits)
    }
}

#[derive(Default)]
pub(super) struct Graph {
    nodes: Vec<Node>,
    ids: HashMap<Node, Id>,
    infinite_constant: bool,
}

impl Graph {
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Whether a constant is infinite or NaN in f32.
    pub fn has_infinite_constant(&self) -> bool {
        self.infinite_constant
    }

    fn node(&mut self, op: Op, operands: [Id; 2], constant: f64) -> Id {
        // −0 and 0 are one constant.
        let node = Node { op, operands, constant_bits: (constant + 0.0).to_bits() };
        self.infinite_constant |= !(constant as f32).is_finite();
        let next = Id(self.nodes.len());
        let id = *self.ids.entry(node).or_insert(next);
        if id == next {
            self.nodes.push(node);
        }
        id
    }

    pub fn leaf(&mut self, op: Op) -> Id {
        self.node(op, [Id(0); 2], 0.0)
    }

    pub fn constant(&mut self, value: f64) -> Id {
        self.node(Op::Constant, [Id(0); 2], value)
    }

    /// The value of a node that is a constant.
    pub fn value(&self, a: Id) -> Option<f64> {
        let node = &self.nodes[a.0];
        (node.op == Op::Constant).then(|| node.constant())
    }

    /// (a', c) with a = a' · c
    fn factor(&self, a: Id) -> (Id, f64) {
        let node = &self.nodes[a.0];
        if node.op == Op::Scale { (node.operands[0], node.constant()) } else { (a, 1.0) }
    }

    pub fn add(&mut self, a: Id, b: Id) -> Id {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => self.constant(x + y),
            (Some(x), None) => self.add_constant(b, x),
            (None, Some(y)) => self.add_constant(a, y),
            _ if a == b => self.scale(a, 2.0),
            _ => match (self.factor(a), self.factor(b)) {
                (_, (b, -1.0)) => self.subtract(a, b),
                ((a, -1.0), _) => self.subtract(b, a),
                _ => self.node(Op::Add, [a.min(b), a.max(b)], 0.0),
            },
        }
    }

    pub fn subtract(&mut self, a: Id, b: Id) -> Id {
        match (self.value(a), self.value(b)) {
            (_, Some(y)) => {
                let minus = self.constant(-y);
                self.add(a, minus)
            }
            (Some(x), None) => {
                let minus = self.scale(b, -1.0);
                self.add_constant(minus, x)
            }
            _ if a == b => self.constant(0.0),
            _ => match self.factor(b) {
                (b, -1.0) => self.add(a, b),
                _ => self.node(Op::Subtract, [a, b], 0.0),
            },
        }
    }

    fn add_constant(&mut self, a: Id, by: f64) -> Id {
        let node = self.nodes[a.0];
        match node.op {
            _ if by == 0.0 => a,
            Op::AddConstant => self.add_constant(node.operands[0], node.constant() + by),
            _ => self.node(Op::AddConstant, [a, Id(0)], by),
        }
    }

    pub fn scale(&mut self, a: Id, by: f64) -> Id {
        let (a, by) = (self.factor(a).0, self.factor(a).1 * by);
        match self.value(a) {
            Some(x) => self.constant(x * by),
            _ if by == 1.0 => a,
            _ if by == 0.0 => self.constant(0.0),
            _ => self.node(Op::Scale, [a, Id(0)], by),
        }
    }

    pub fn multiply(&mut self, a: Id, b: Id) -> Id {
        match (self.value(a), self.value(b)) {
            (Some(x), _) => self.scale(b, x),
            (_, Some(y)) => self.scale(a, y),
            _ => {
                // Constant factors move outwards, where they may meet others.
                let ((a, x), (b, y)) = (self.factor(a), self.factor(b));
                let product = match a == b {
                    true => self.unary(Op::Square, a),
                    false => self.node(Op::Multiply, [a.min(b), a.max(b)], 0.0),
                };
                self.scale(product, x * y)
            }
        }
    }

    pub fn divide(&mut self, a: Id, b: Id) -> Id {
        let inverse = self.unary(Op::Reciprocal, b);
        self.multiply(a, inverse)
    }

    /// a^n by repeated squaring, so that even powers are provably not negative.
    pub fn integer_power(&mut self, a: Id, n: i32) -> Id {
        match n {
            0 => self.constant(1.0),
            1 => a,
            ..0 => {
                let power = self.integer_power(a, -n);
                self.unary(Op::Reciprocal, power)
            }
            _ if n % 2 == 0 => {
                let root = self.integer_power(a, n / 2);
                self.unary(Op::Square, root)
            }
            _ => {
                let even = self.integer_power(a, n - 1);
                self.multiply(a, even)
            }
        }
    }

    /// a^c for any c; a < 0 counts as 0.
    pub fn real_power(&mut self, a: Id, c: f64) -> Id {
        if (c - 0.5).fract() == 0.0 && c.abs() < 16.0 {
            let root = self.unary(Op::SquareRoot, a);
            return self.integer_power(root, (2.0 * c) as i32);
        }
        let log = self.unary(Op::Logarithm, a);
        let log = self.scale(log, c);
        self.unary(Op::Exponential, log)
    }

    pub fn unary(&mut self, op: Op, a: Id) -> Id {
        match self.value(a) {
            Some(x) => self.constant(fold(op, x)),
            None => self.node(op, [a, Id(0)], 0.0),
        }
    }

    /// The minimum or the maximum.
    pub fn extreme(&mut self, op: Op, a: Id, b: Id) -> Id {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => self.constant(if op == Op::Minimum { x.min(y) } else { x.max(y) }),
            _ if a == b => a,
            _ => self.node(op, [a.min(b), a.max(b)], 0.0),
        }
    }
}

/// A function of a constant, with the same bits as in lanes: the system's sine may differ between machines.
fn fold(op: Op, x: f64) -> f64 {
    let of = F::<One>(x as f32);
    match op {
        Op::Square => x * x,
        Op::Reciprocal => 1.0 / x,
        Op::SquareRoot => x.max(0.0).sqrt(),
        Op::Absolute => x.abs(),
        Op::Exponential => functions::exp(of).0.into(),
        Op::Logarithm => functions::log(of).0.into(),
        Op::Sine => functions::sin_cos(of).0.0.into(),
        Op::Cosine => functions::sin_cos(of).1.0.into(),
        _ => unreachable!("{op:?} is not a function of one number"),
    }
}
