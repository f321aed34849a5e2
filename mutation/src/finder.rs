//! Walks over a file and finds every place where a fault of one line could be made.
use std::{collections::HashMap, ops::Range};

use syn::{
    Arm, Attribute, BinOp, Block, Expr, ExprBinary, ExprIf, ExprMatch, ExprStruct, ExprUnary, Ident, ImplItem, Item, ItemFn, Lit,
    Macro, Member, Pat, RangeLimits, Signature, Stmt, Token, UnOp,
    parse::{ParseStream, Parser},
    punctuated::Punctuated,
    spanned::Spanned,
    visit::{self, Visit},
};

use crate::{
    fault::{Fault, Form},
    operators,
};

/// Longer matches are not written twice.
const LONGEST_MATCH: usize = 30;

/// Finds the faults of one file, in the order of their places.
pub fn faults(file: &str, source: &str) -> syn::Result<Vec<Fault>> {
    let parsed = syn::parse_file(source)?;
    let constants = parsed.items.iter().filter_map(numeric_constant).collect();
    let mut finder = Finder { file, source, functions: Vec::new(), owner: None, constants, looks: 0, faults: Vec::new() };
    finder.visit_file(&parsed);
    let mut faults = finder.faults;
    faults.sort_by_key(|fault| (fault.range.start, fault.range.end));
    crate::fault::number_repeats(&mut faults);
    Ok(faults)
}

/// Whether what has these attributes is left out: tests, and what only some systems compile.
pub fn is_conditional(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let condition = match attribute.parse_args::<proc_macro2::TokenStream>() {
            Ok(tokens) if attribute.path().is_ident("cfg") => tokens.to_string(),
            _ => return attribute.path().is_ident("test"),
        };
        condition != "unix" && !condition.starts_with("feature") && condition != "target_arch = \"x86_64\""
    })
}

/// Constants cannot be switched, but their uses can.
fn numeric_constant(item: &Item) -> Option<(String, &'static str)> {
    let Item::Const(item) = item else { return None };
    let syn::Type::Path(kind) = &*item.ty else { return None };
    let change = match kind.path.get_ident()?.to_string().as_str() {
        "f32" | "f64" => " * 2.0",
        "u8" | "u16" | "u32" | "u64" | "usize" | "i32" | "i64" => " + 1",
        _ => return None,
    };
    Some((item.ident.to_string(), change))
}

struct Finder<'a> {
    file: &'a str,
    source: &'a str,
    /// The functions around the place, outermost first.
    functions: Vec<String>,
    /// The type whose methods these are.
    owner: Option<String>,
    constants: HashMap<String, &'static str>,
    /// How many calls around the place only set sizes and colours.
    looks: usize,
    faults: Vec<Fault>,
}

impl Finder<'_> {
    fn range(node: &impl Spanned) -> Range<usize> {
        node.span().byte_range()
    }

    fn text(&self, node: &impl Spanned) -> &str {
        &self.source[Self::range(node)]
    }

    fn add(&mut self, operator: &'static str, form: Form, range: Range<usize>, faulty: String) {
        let original = &self.source[range.clone()];
        let is_code = match form {
            Form::Statement => faulty.is_empty(),
            _ => syn::parse_str::<Expr>(&faulty).is_ok(),
        };
        if self.functions.is_empty() || original == faulty || !is_code {
            return;
        }
        let start = self.source[..range.start].rfind('\n').map_or(0, |at| at + 1);
        let source = self.source[start..].lines().next().unwrap_or_default().trim().to_owned();
        self.faults.push(Fault {
            file: self.file.to_owned(),
            line: self.source[..range.start].matches('\n').count() + 1,
            source,
            function: self.functions.join("::"),
            operator,
            form,
            original: original.to_owned(),
            faulty,
            repeat: 0,
            range,
        });
    }

    /// Adds the fault that a part of a node reads differently.
    fn replace(&mut self, operator: &'static str, node: &impl Spanned, part: Range<usize>, other: &str) {
        self.replace_all(operator, node, &[(part, other.to_owned())]);
    }

    fn replace_all(&mut self, operator: &'static str, node: &impl Spanned, parts: &[(Range<usize>, String)]) {
        let range = Self::range(node);
        let mut faulty = String::new();
        let mut at = range.start;
        for (part, other) in parts {
            faulty.push_str(&self.source[at..part.start]);
            faulty.push_str(other);
            at = part.end;
        }
        faulty.push_str(&self.source[at..range.end]);
        self.add(operator, Form::Value, range, faulty);
    }

    fn exchange(&mut self, operator: &'static str, node: &impl Spanned, a: &impl Spanned, b: &impl Spanned) {
        let parts = [(Self::range(a), self.text(b).to_owned()), (Self::range(b), self.text(a).to_owned())];
        self.replace_all(operator, node, &parts);
    }

    fn neighbours(&mut self, node: &impl Spanned, values: &Punctuated<Expr, Token![,]>) {
        let values: Vec<&Expr> = values.iter().collect();
        for pair in values.windows(2).filter(|pair| look_alike(pair[0], pair[1])) {
            self.exchange("arguments exchanged", node, pair[0], pair[1]);
        }
    }

    fn binary(&mut self, node: &ExprBinary) {
        if contains_let(&node.left) || contains_let(&node.right) {
            return;
        }
        let is_never_met = operators::is_never_met(self.text(node));
        let others = operators::instead_of(&node.op).iter();
        for other in others.filter(|other| !(is_never_met && is_bound(&node.op, other))) {
            self.replace("operator", node, Self::range(&node.op), other);
        }
    }

    fn unary(&mut self, node: &ExprUnary) {
        if !matches!(node.op, UnOp::Deref(_)) {
            let operand = self.text(&node.expr).to_owned();
            self.add("sign or negation dropped", Form::Value, Self::range(node), operand);
        }
    }

    fn condition(&mut self, node: &ExprIf) {
        // Of these, other faults are the same.
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

    fn structure(&mut self, node: &ExprStruct) {
        let fields: Vec<_> = node.fields.iter().collect();
        for pair in fields.windows(2).filter(|pair| look_alike(&pair[0].expr, &pair[1].expr)) {
            let [Member::Named(a), Member::Named(b)] = [&pair[0].member, &pair[1].member] else { continue };
            let [x, y] = [self.text(&pair[0].expr), self.text(&pair[1].expr)];
            let parts = [(Self::range(pair[0]), format!("{a}: {y}")), (Self::range(pair[1]), format!("{b}: {x}"))];
            self.replace_all("fields exchanged", node, &parts);
        }
    }

    fn arms(&mut self, node: &ExprMatch) {
        if self.text(node).lines().count() > LONGEST_MATCH {
            return;
        }
        let arms: Vec<&Arm> = node.arms.iter().filter(|arm| !is_conditional(&arm.attrs)).collect();
        for pair in arms.windows(2).filter(|pair| look_alike(&pair[0].body, &pair[1].body)) {
            self.exchange("arms exchanged", node, &pair[0].body, &pair[1].body);
        }
    }

    fn end_of_range(&mut self, node: &syn::ExprRange) {
        let Some(end) = &node.end else { return };
        let change = if matches!(node.limits, RangeLimits::Closed(_)) { " - 1" } else { " + 1" };
        let longer = format!("{}{change}", self.text(end));
        self.replace("end of range", node, Self::range(end), &longer);
    }

    fn method(&mut self, node: &syn::ExprMethodCall) {
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

    fn field(&mut self, node: &syn::ExprField) {
        let (name, range) = match &node.member {
            Member::Named(name) => (name.to_string(), Self::range(name)),
            Member::Unnamed(index) => (index.index.to_string(), Self::range(index)),
        };
        // `a.0.1` is one token with a number that looks real.
        if let Some(other) = operators::other_field(&name).filter(|_| self.source[range.clone()] == name) {
            let faulty = format!("{}{other}", &self.source[Self::range(node).start..range.start]);
            self.add("field", Form::Place, Self::range(node), faulty);
        }
    }

    fn literal(&mut self, lit: &Lit) {
        if let Some(other) = operators::other_literal(lit).filter(|_| self.looks == 0) {
            self.add("literal", Form::Value, Self::range(lit), other);
        }
    }

    fn path(&mut self, path: &syn::Path) {
        let constant = path.get_ident().and_then(|name| Some((name, *self.constants.get(&name.to_string())?)));
        if let Some((name, change)) = constant {
            self.add("constant", Form::Value, Self::range(path), format!("({name}{change})"));
        }
    }

    /// A statement that may be dropped: a call, an assignment, or an early return.
    fn statement(&mut self, statement: &Stmt) {
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

    fn function(&mut self, attributes: &[Attribute], signature: &Signature, body: &Block) {
        if is_conditional(attributes) || signature.constness.is_some() {
            return;
        }
        let name = signature.ident.to_string();
        let name = match self.owner.take() {
            Some(owner) if self.functions.is_empty() => format!("{owner}::{name}"),
            _ => name,
        };
        self.functions.push(name);
        visit::visit_block(self, body);
        self.functions.pop();
    }

    fn called(&mut self, name: Option<String>, visit: impl FnOnce(&mut Self)) {
        let is_look = name.is_some_and(|name| operators::is_look(&name));
        self.looks += usize::from(is_look);
        visit(self);
        self.looks -= usize::from(is_look);
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_expr(&mut self, node: &'ast Expr) {
        match node {
            Expr::Binary(node) => self.binary(node),
            Expr::Unary(node) => self.unary(node),
            Expr::If(node) if is_conditional(&node.attrs) => return,
            Expr::If(node) => self.condition(node),
            Expr::Struct(node) => self.structure(node),
            Expr::Match(node) => self.arms(node),
            Expr::Range(node) => self.end_of_range(node),
            Expr::MethodCall(node) => self.method(node),
            Expr::Call(node) => self.neighbours(node, &node.args),
            Expr::Array(node) => self.neighbours(node, &node.elems),
            Expr::Tuple(node) => self.neighbours(node, &node.elems),
            Expr::Field(node) => self.field(node),
            Expr::Lit(node) => self.literal(&node.lit),
            Expr::Path(node) => self.path(&node.path),
            Expr::Macro(node) if node.mac.path.is_ident("matches") => {
                self.add("condition negated", Form::Value, Self::range(node), format!("!{}", self.text(node)));
            }
            Expr::Block(node) if is_conditional(&node.attrs) => return,
            _ => {}
        }
        match node {
            // What is assigned to must stay the place that it is.
            Expr::Assign(node) => {
                if let Expr::Index(left) = &*node.left {
                    self.visit_expr(&left.index);
                }
                self.visit_expr(&node.right);
            }
            // The length must be known when the program is compiled.
            Expr::Repeat(node) => self.visit_expr(&node.expr),
            Expr::Call(call) => self.called(last_name(&call.func), |finder| visit::visit_expr(finder, node)),
            Expr::MethodCall(call) => {
                self.visit_expr(&call.receiver);
                self.called(Some(call.method.to_string()), |finder| call.args.iter().for_each(|value| finder.visit_expr(value)));
            }
            Expr::Const(_) => {}
            _ => visit::visit_expr(self, node),
        }
    }

    fn visit_stmt(&mut self, node: &'ast Stmt) {
        if matches!(node, Stmt::Local(local) if is_conditional(&local.attrs)) {
            return;
        }
        self.statement(node);
        visit::visit_stmt(self, node);
    }

    fn visit_arm(&mut self, node: &'ast Arm) {
        if !is_conditional(&node.attrs) {
            visit::visit_arm(self, node);
        }
    }

    /// Of patterns, only guards are expressions.
    fn visit_pat(&mut self, node: &'ast Pat) {
        if let Pat::Guard(node) = node {
            self.visit_expr(&node.guard);
        }
    }

    /// Macros that take expressions, and those of this package that take them with a name.
    fn visit_macro(&mut self, node: &'ast Macro) {
        let Some(name) = node.path.segments.last().map(|last| last.ident.to_string()) else { return };
        let list = Punctuated::<Expr, Token![,]>::parse_terminated;
        let repeated = |input: ParseStream| Ok([input.parse()?, (input.parse::<Token![;]>()?, input.parse::<Expr>()?).1]);
        let parsed: Vec<Expr> = match name.as_str() {
            "vec" => list
                .parse2(node.tokens.clone())
                .map(|values| values.into_iter().collect())
                .or_else(|_| repeated.parse2(node.tokens.clone()).map(Vec::from)),
            "format" | "write" | "writeln" | "print" | "println" | "eprint" | "eprintln" => {
                list.parse2(node.tokens.clone()).map(|values| {
                    self.neighbours(node, &values);
                    values.into_iter().collect()
                })
            }
            "in_lanes" | "in_kind" => call_with_name.parse2(node.tokens.clone()).map(Vec::from),
            _ => return,
        }
        .unwrap_or_default();
        parsed.iter().for_each(|value| Visit::visit_expr(self, value));
    }

    fn visit_item(&mut self, node: &'ast Item) {
        match node {
            Item::Fn(ItemFn { attrs, sig, block, .. }) => self.function(attrs, sig, block),
            Item::Impl(node) if !is_conditional(&node.attrs) => {
                for item in &node.items {
                    if let ImplItem::Fn(method) = item {
                        self.owner = type_name(&node.self_ty);
                        self.function(&method.attrs, &method.sig, &method.block);
                    }
                }
            }
            Item::Trait(node) => {
                for item in &node.items {
                    if let syn::TraitItem::Fn(syn::TraitItemFn { attrs, sig, default: Some(body), .. }) = item {
                        self.owner = Some(node.ident.to_string());
                        self.function(attrs, sig, body);
                    }
                }
            }
            Item::Mod(node) if !is_conditional(&node.attrs) => visit::visit_item_mod(self, node),
            // Constants, types and macros cannot be switched.
            _ => {}
        }
    }

    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_path_arguments(&mut self, _: &'ast syn::PathArguments) {}
    fn visit_attribute(&mut self, _: &'ast Attribute) {}
}

/// `value, name => call`
fn call_with_name(input: ParseStream) -> syn::Result<[Expr; 2]> {
    let value = input.parse()?;
    input.parse::<Token![,]>()?;
    input.parse::<Ident>()?;
    input.parse::<Token![=>]>()?;
    let call = input.parse()?;
    input.parse::<Option<Token![,]>>()?;
    Ok([value, call])
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

fn last_name(function: &Expr) -> Option<String> {
    let Expr::Path(function) = function else { return None };
    function.path.segments.last().map(|last| last.ident.to_string())
}

fn type_name(kind: &syn::Type) -> Option<String> {
    let syn::Type::Path(kind) = kind else { return None };
    kind.path.segments.last().map(|last| last.ident.to_string())
}

#[cfg(test)]
mod tests;
