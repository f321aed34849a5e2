//! The mutants that can be made at a single expression or statement.
use syn::{
    Arm, BinOp, Block, Expr, ExprBinary, ExprIf, ExprMatch, ExprStruct, ExprUnary, Lit, Member, RangeLimits, Stmt, Token, UnOp,
    punctuated::Punctuated, spanned::Spanned,
};

use super::{Finder, is_conditional};
use crate::{mutant::Form, operators};

/// Longer matches are not written twice.
const LONGEST_MATCH: usize = 30;

impl Finder<'_> {
    pub(super) fn neighbours(&mut self, node: &impl Spanned, values: &Punctuated<Expr, Token![,]>) {
        let values: Vec<&Expr> = values.iter().collect();
        for pair in values.windows(2).filter(|pair| look_alike(pair[0], pair[1])) {
            self.exchange("arguments exchanged", node, pair[0], pair[1]);
        }
    }

    pub(super) fn binary(&mut self, node: &ExprBinary) {
        if contains_let(&node.left) || contains_let(&node.right) {
            return;
        }
        let is_never_met = operators::is_never_met(self.text(node));
        let others = operators::instead_of(&node.op).iter();
        for other in others.filter(|other| !(is_never_met && is_bound(&node.op, other))) {
            self.replace("operator", node, Self::range(&node.op), other);
        }
    }

    pub(super) fn unary(&mut self, node: &ExprUnary) {
        if !matches!(node.op, UnOp::Deref(_)) {
            let operand = self.text(&node.expr).to_owned();
            self.add("sign or negation dropped", Form::Value, Self::range(node), operand);
        }
    }

    pub(super) fn condition(&mut self, node: &ExprIf) {
        // Of these, other mutants are the same.
        let is_same = match &*node.cond {
            Expr::Unary(node) => matches!(node.op, UnOp::Not(_)),
            Expr::Binary(node) => matches!(node.op, BinOp::Eq(_) | BinOp::Ne(_)),
            _ => false,
        };
        if !is_same && !contains_let(&node.cond) {
            let condition = self.text(&node.cond);
            self.add("condition negated", Form::Value, Self::range(&node.cond), format!("!({condition})"));
        }
    }

    pub(super) fn structure(&mut self, node: &ExprStruct) {
        let fields: Vec<_> = node.fields.iter().collect();
        for pair in fields.windows(2).filter(|pair| look_alike(&pair[0].expr, &pair[1].expr)) {
            let [Member::Named(a), Member::Named(b)] = [&pair[0].member, &pair[1].member] else { continue };
            let [x, y] = [self.text(&pair[0].expr), self.text(&pair[1].expr)];
            let parts = [(Self::range(pair[0]), format!("{a}: {y}")), (Self::range(pair[1]), format!("{b}: {x}"))];
            self.replace_all("fields exchanged", node, &parts);
        }
    }

    pub(super) fn arms(&mut self, node: &ExprMatch) {
        if self.text(node).lines().count() > LONGEST_MATCH {
            return;
        }
        let arms: Vec<&Arm> = node.arms.iter().filter(|arm| !is_conditional(&arm.attrs)).collect();
        for pair in arms.windows(2).filter(|pair| look_alike(&pair[0].body, &pair[1].body)) {
            self.exchange("arms exchanged", node, &pair[0].body, &pair[1].body);
        }
    }

    pub(super) fn end_of_range(&mut self, node: &syn::ExprRange) {
        let Some(end) = &node.end else { return };
        let change = if matches!(node.limits, RangeLimits::Closed(_)) { " - 1" } else { " + 1" };
        let longer = format!("{}{change}", self.text(end));
        self.replace("end of range", node, Self::range(end), &longer);
    }

    pub(super) fn method(&mut self, node: &syn::ExprMethodCall) {
        let name = node.method.to_string();
        for other in operators::other_names(&name) {
            self.replace("name", node, Self::range(&node.method), other);
        }
        let receiver = self.text(&node.receiver).to_owned();
        if operators::is_forgotten(&name) {
            self.add("method forgotten", Form::Value, Self::range(node), receiver);
        } else if name == "cross" {
            self.exchange("operands exchanged", node, &*node.receiver, &node.args);
        }
        self.neighbours(node, &node.args);
    }

    pub(super) fn field(&mut self, node: &syn::ExprField) {
        let (name, range) = match &node.member {
            Member::Named(name) => (name.to_string(), Self::range(name)),
            Member::Unnamed(index) => (index.index.to_string(), Self::range(index)),
        };
        // `a.0.1` is one token with a number that looks real.
        if let Some(other) = operators::other_field(&name).filter(|_| self.source[range.clone()] == name) {
            let changed = format!("{}{other}", &self.source[Self::range(node).start..range.start]);
            self.add("field", Form::Place, Self::range(node), changed);
        }
    }

    pub(super) fn literal(&mut self, lit: &Lit) {
        if let Some(other) = operators::other_literal(lit).filter(|_| self.looks == 0) {
            self.add("literal", Form::Value, Self::range(lit), other);
        }
    }

    pub(super) fn path(&mut self, path: &syn::Path) {
        let constant = path.get_ident().and_then(|name| Some((name, *self.constants.get(&name.to_string())?)));
        if let Some((name, change)) = constant {
            self.add("constant", Form::Value, Self::range(path), format!("({name}{change})"));
        }
    }

    /// A statement that may be dropped: a call, an assignment, or an early return.
    pub(super) fn statement(&mut self, statement: &Stmt) {
        let is_dropped = match statement {
            Stmt::Expr(Expr::Call(_) | Expr::MethodCall(_) | Expr::Assign(_), Some(_)) => true,
            Stmt::Expr(Expr::Binary(node), Some(_)) => !matches!(node.op, BinOp::Lt(_) | BinOp::Gt(_)),
            Stmt::Expr(Expr::If(node), _) => node.else_branch.is_none() && leaves(&node.then_branch),
            _ => false,
        };
        if is_dropped {
            self.add("statement dropped", Form::Statement, Self::range(statement), String::new());
        }
    }
}

/// Whether two values could be of one type, as far as one can see, and could be exchanged by mistake.
fn look_alike(a: &Expr, b: &Expr) -> bool {
    let is_text = |value: &Expr| matches!(value, Expr::Lit(value) if matches!(value.lit, Lit::Str(_)));
    let is_reference = |value: &Expr| matches!(value, Expr::Reference(_));
    let is_closure = |value: &Expr| matches!(value, Expr::Closure(_));
    ![a, b].into_iter().any(|value| is_text(value) || is_closure(value)) && is_reference(a) == is_reference(b)
}

/// Whether one comparison includes its bound and the other does not.
fn is_bound(operator: &BinOp, other: &str) -> bool {
    match operator {
        BinOp::Lt(_) | BinOp::Gt(_) => other.ends_with('='),
        BinOp::Le(_) | BinOp::Ge(_) => !other.ends_with('='),
        _ => false,
    }
}

fn contains_let(node: &Expr) -> bool {
    match node {
        Expr::Let(_) => true,
        Expr::Binary(node) => contains_let(&node.left) || contains_let(&node.right),
        _ => false,
    }
}

/// Whether a block ends by leaving what is around it.
fn leaves(block: &Block) -> bool {
    matches!(block.stmts.last(), Some(Stmt::Expr(Expr::Return(_) | Expr::Continue(_) | Expr::Break(_), _)))
}
