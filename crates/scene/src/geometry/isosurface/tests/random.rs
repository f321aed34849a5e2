//! Random expressions, as text and as numbers.
use std::fmt;

use glam::DVec3;
use rand::{Rng, rngs::SmallRng};

#[derive(Clone, Debug)]
pub enum Tree {
    Variable(usize),
    Constant(f64),
    Negative(Box<Tree>),
    Power(Box<Tree>, f64),
    Call(&'static str, Vec<Tree>),
    Binary(char, Box<Tree>, Box<Tree>),
}

use Tree::{Binary, Call, Constant, Negative, Power, Variable};

/// Constants whose inverses are exact in f32 too.
const CONSTANTS: [f64; 7] = [0.25, 0.5, 1.0, 2.0, 4.0, -0.5, -1.0];

pub fn tree(rng: &mut SmallRng, depth: u32) -> Tree {
    if depth == 0 {
        return Variable(rng.random_range(0..3));
    }
    let part = |rng: &mut SmallRng| Box::new(tree(rng, depth - 1));
    match rng.random_range(0..12) {
        0 => Negative(part(rng)),
        1 | 2 => Power(part(rng), [2.0, 3.0, -1.0, 4.0, 0.5, 1.5, 2.25][rng.random_range(0..7)]),
        3 | 4 => Call(["sin", "cos", "tan", "exp", "log", "sqrt", "abs"][rng.random_range(0..7)], vec![*part(rng)]),
        5 => Call(["min", "max"][rng.random_range(0..2)], vec![*part(rng), *part(rng)]),
        6 => {
            Binary(['+', '-', '*', '/'][rng.random_range(0..4)], part(rng), Box::new(Constant(CONSTANTS[rng.random_range(0..7)])))
        }
        7 => {
            Binary(['+', '-', '*', '/'][rng.random_range(0..4)], Box::new(Constant(CONSTANTS[rng.random_range(0..7)])), part(rng))
        }
        k => Binary(['+', '-', '*', '/'][k % 4], part(rng), part(rng)),
    }
}

impl Tree {
    pub fn value(&self, p: DVec3) -> f64 {
        match self {
            Variable(axis) => p[*axis],
            Constant(c) => *c,
            Negative(a) => -a.value(p),
            Power(a, n) if n.fract() == 0.0 => a.value(p).powi(*n as i32),
            Power(a, c) => a.value(p).max(0.0).powf(*c),
            Call(name, arguments) => {
                let a = arguments[0].value(p);
                match *name {
                    "sin" => a.sin(),
                    "cos" => a.cos(),
                    "tan" => a.tan(),
                    "exp" => a.exp(),
                    "log" => a.max(f32::MIN_POSITIVE.into()).ln(),
                    "sqrt" => a.max(0.0).sqrt(),
                    "abs" => a.abs(),
                    _ => extreme(name, a, arguments[1].value(p)),
                }
            }
            Binary(op, a, b) => {
                let (a, b) = (a.value(p), b.value(p));
                match op {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    _ => a / b,
                }
            }
        }
    }
}

/// NaN where either is.
fn extreme(name: &str, a: f64, b: f64) -> f64 {
    match name {
        _ if a.is_nan() || b.is_nan() => f64::NAN,
        "min" => a.min(b),
        _ => a.max(b),
    }
}

/// With parentheses where precedence asks for them only: sums 0, products 1, signs 2, powers 3, atoms 4.
fn write(tree: &Tree, at_least: u32, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let level = match tree {
        Binary('+' | '-', ..) => 0,
        Binary(..) => 1,
        Negative(_) => 2,
        Constant(c) if *c < 0.0 => 2,
        Power(..) => 3,
        _ => 4,
    };
    if level < at_least {
        f.write_str("(")?;
    }
    match tree {
        Variable(axis) => write!(f, "{}", ["x", "y", "z"][*axis])?,
        Constant(c) => write!(f, "{c}")?,
        Negative(a) => {
            f.write_str("-")?;
            write(a, 2, f)?;
        }
        Power(a, n) => {
            write(a, 4, f)?;
            write!(f, "^{n}")?;
        }
        Call(name, arguments) => {
            write!(f, "{name}(")?;
            for (i, argument) in arguments.iter().enumerate() {
                f.write_str(if i > 0 { ", " } else { "" })?;
                write(argument, 0, f)?;
            }
            f.write_str(")")?;
        }
        Binary(op, a, b) => {
            write(a, level, f)?;
            write!(f, " {op} ")?;
            write(b, level + 1, f)?;
        }
    }
    if level < at_least { f.write_str(")") } else { Ok(()) }
}

impl fmt::Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write(self, 0, f)
    }
}
