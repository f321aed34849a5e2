//! Parses the text of an expression to its graph, by recursive descent.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = ("-" | "+") signed | power
//! power   = atom [ "^" signed ]                       so −x^2 = −(x^2) and x^y^z = x^(y^z)
//! atom    = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
//! ```
use std::ops::Range;

use super::{
    graph::{Graph, Id, Op},
    names::{FUNCTIONS, unknown},
    parse_error::ParseError,
    token::{Token, Tokens},
};

/// Maximum length of the text, in bytes.
const LONGEST: usize = 4096;
/// Maximum nesting of parentheses, signs and powers.
const DEEPEST: usize = 64;
/// Maximum integer power.
const HIGHEST_POWER: f64 = 64.0;

/// The graph of an expression and the node of its value.
pub(super) fn parse(text: &str) -> Result<(Graph, Id), ParseError> {
    if text.len() > LONGEST {
        let message = format!("the expression has {} bytes, more than {LONGEST}", text.len());
        return Err(ParseError::new(0..text.len(), message, "too long"));
    }
    let tokens = Tokens::new(text)?;
    let mut parser = Parser { tokens, graph: Graph::default(), depth: 0 };
    if parser.tokens.peek().is_none() {
        return Err(ParseError::new(
            0..text.len(),
            "the expression is empty",
            "write one in x, y and z, such as x^2 + y^2 + z^2 - 1",
        ));
    }
    let value = parser.sum()?;
    if let Some((token, at)) = parser.tokens.take() {
        let label =
            if token == Token::Symbol(')') { "it has no matching (" } else { "an operator such as * is missing before it" };
        return Err(ParseError::new(at, format!("{token} is not expected here"), label));
    }
    Ok((parser.graph, value))
}

struct Parser<'a> {
    tokens: Tokens<'a>,
    graph: Graph,
    depth: usize,
}

type Parsed = Result<Id, ParseError>;

impl Parser<'_> {
    fn sum(&mut self) -> Parsed {
        let start = self.tokens.here().start;
        let mut sum = self.product()?;
        while let Some(sign) = self.tokens.take_symbol(&['+', '-']) {
            let b = self.product()?;
            sum = if sign == '+' { self.graph.add(sum, b) } else { self.graph.subtract(sum, b) };
        }
        if self.graph.has_infinite_constant() {
            let at = start..self.tokens.last_end();
            return Err(ParseError::new(
                at,
                "a constant is infinite or undefined",
                "it exceeds 3.4e38, or its expression divides by 0",
            ));
        }
        Ok(sum)
    }

    fn product(&mut self) -> Parsed {
        let mut product = self.signed()?;
        while let Some(sign) = self.tokens.take_symbol(&['*', '/']) {
            let at = self.tokens.here();
            let b = self.signed()?;
            if sign == '/' && self.graph.value(b) == Some(0.0) {
                return Err(ParseError::new(at.start..self.tokens.last_end(), "division by zero", "this is 0"));
            }
            product = if sign == '*' { self.graph.multiply(product, b) } else { self.graph.divide(product, b) };
        }
        Ok(product)
    }

    fn signed(&mut self) -> Parsed {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(ParseError::new(
                self.tokens.here(),
                format!("nested more than {DEEPEST} deep"),
                "simplify what is around this",
            ));
        }
        let value = match self.tokens.take_symbol(&['+', '-']) {
            Some('+') => self.signed()?,
            Some(_) => {
                let value = self.signed()?;
                self.graph.scale(value, -1.0)
            }
            None => self.power()?,
        };
        self.depth -= 1;
        Ok(value)
    }

    fn power(&mut self) -> Parsed {
        let base = self.atom()?;
        if self.tokens.take_symbol(&['^']).is_none() {
            return Ok(base);
        }
        let at = self.tokens.here();
        let exponent = self.signed()?;
        let at = at.start..self.tokens.last_end();
        match self.graph.value(exponent) {
            Some(n) if n.fract() == 0.0 && n.abs() <= HIGHEST_POWER => Ok(self.graph.integer_power(base, n as i32)),
            Some(n) if n.abs() > HIGHEST_POWER => Err(ParseError::new(
                at,
                format!("a power must lie between -{HIGHEST_POWER} and {HIGHEST_POWER}"),
                "too high a power",
            )),
            Some(c) => Ok(self.graph.real_power(base, c)),
            None => Err(ParseError::new(at, "a power must be a number", "write exp(b * log(a)) for a^b")),
        }
    }

    fn atom(&mut self) -> Parsed {
        let here = self.tokens.here();
        match self.tokens.take() {
            Some((Token::Number(value), _)) => Ok(self.graph.constant(value)),
            Some((Token::Name(name), at)) => self.named(name, at),
            Some((Token::Symbol('('), at)) => {
                let value = self.sum()?;
                self.close(at)?;
                Ok(value)
            }
            Some((token, at)) => {
                Err(ParseError::new(at, format!("{token} is not expected here"), "expected a number, a name or ("))
            }
            None => Err(ParseError::new(here, "the expression ends too early", "expected a number, a name or (")),
        }
    }

    /// Parses the parenthesis that closes the one at `open`.
    fn close(&mut self, open: Range<usize>) -> Result<(), ParseError> {
        if self.tokens.take_symbol(&[')']).is_some() {
            return Ok(());
        }
        match self.tokens.take() {
            Some((Token::Symbol(','), at)) => Err(ParseError::new(at, "a comma is not expected here", "too many arguments")),
            Some((token, at)) => {
                Err(ParseError::new(at, format!("{token} is not expected here"), "expected an operator or ) before it"))
            }
            None => Err(ParseError::new(open, "a parenthesis is not closed", "its ) is missing")),
        }
    }

    fn named(&mut self, name: &str, at: Range<usize>) -> Parsed {
        match name {
            "x" => Ok(self.graph.leaf(Op::X)),
            "y" => Ok(self.graph.leaf(Op::Y)),
            "z" => Ok(self.graph.leaf(Op::Z)),
            "pi" => Ok(self.graph.constant(std::f64::consts::PI)),
            _ => match FUNCTIONS.iter().find(|(known, _)| *known == name) {
                Some((_, 1)) => {
                    let open = self.open(name, at)?;
                    let a = self.sum()?;
                    self.close(open)?;
                    Ok(self.function(name, a))
                }
                Some(_) => self.extreme(if name == "min" { Op::Minimum } else { Op::Maximum }, name, at),
                None => Err(unknown(name, at)),
            },
        }
    }

    /// Parses the parenthesis after the name of a function.
    fn open(&mut self, name: &str, at: Range<usize>) -> Result<Range<usize>, ParseError> {
        let open = self.tokens.here();
        match self.tokens.take_symbol(&['(']) {
            Some(_) => Ok(open),
            None => Err(ParseError::new(at, format!("{name} is a function"), format!("write {name}(…)"))),
        }
    }

    fn function(&mut self, name: &str, a: Id) -> Id {
        match name {
            "sin" => self.graph.unary(Op::Sine, a),
            "cos" => self.graph.unary(Op::Cosine, a),
            "tan" => {
                let (sin, cos) = (self.graph.unary(Op::Sine, a), self.graph.unary(Op::Cosine, a));
                self.graph.divide(sin, cos)
            }
            "exp" => self.graph.unary(Op::Exponential, a),
            "log" => self.graph.unary(Op::Logarithm, a),
            "sqrt" => self.graph.unary(Op::SquareRoot, a),
            _ => self.graph.unary(Op::Absolute, a),
        }
    }

    /// Parses the minimum or maximum of two or more arguments.
    fn extreme(&mut self, op: Op, name: &str, at: Range<usize>) -> Parsed {
        let open = self.open(name, at.clone())?;
        let mut value = self.sum()?;
        let mut arguments = 1;
        while self.tokens.take_symbol(&[',']).is_some() {
            let b = self.sum()?;
            value = self.graph.extreme(op, value, b);
            arguments += 1;
        }
        self.close(open)?;
        if arguments < 2 {
            return Err(ParseError::new(at, format!("{name} needs two arguments or more"), format!("write {name}(a, b)")));
        }
        Ok(value)
    }
}
