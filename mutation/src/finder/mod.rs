//! Walks over a file and finds every place where a mutant of one line could be made.
mod places;
mod syntax;
#[cfg(test)]
mod tests;

use std::{collections::HashMap, ops::Range};

use syn::{
    Arm, Attribute, Block, Expr, ImplItem, Item, ItemFn, Macro, Pat, Signature, Stmt, Token,
    parse::{ParseStream, Parser},
    punctuated::Punctuated,
    spanned::Spanned,
    visit::{self, Visit},
};

pub use self::syntax::is_conditional;
use self::syntax::{call_with_name, last_name, numeric_constant, type_name};
use crate::{
    mutant::{Form, Mutant},
    operators,
};

/// Finds the mutants of one file, in the order of their places.
pub fn mutants(file: &str, source: &str) -> syn::Result<Vec<Mutant>> {
    let parsed = syn::parse_file(source)?;
    let constants = parsed.items.iter().filter_map(numeric_constant).collect();
    let mut finder = Finder { file, source, functions: Vec::new(), owner: None, constants, looks: 0, mutants: Vec::new() };
    finder.visit_file(&parsed);
    let mut mutants = finder.mutants;
    mutants.sort_by_key(|mutant| (mutant.range.start, mutant.range.end));
    crate::mutant::number_repeats(&mut mutants);
    Ok(mutants)
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
    mutants: Vec<Mutant>,
}

impl Finder<'_> {
    fn range(node: &impl Spanned) -> Range<usize> {
        node.span().byte_range()
    }

    fn text(&self, node: &impl Spanned) -> &str {
        &self.source[Self::range(node)]
    }

    fn add(&mut self, operator: &'static str, form: Form, range: Range<usize>, changed: String) {
        let original = &self.source[range.clone()];
        let is_code = match form {
            Form::Statement => changed.is_empty(),
            _ => syn::parse_str::<Expr>(&changed).is_ok(),
        };
        if self.functions.is_empty() || original == changed || !is_code {
            return;
        }
        let start = self.source[..range.start].rfind('\n').map_or(0, |at| at + 1);
        let source = self.source[start..].lines().next().unwrap_or_default().trim().to_owned();
        self.mutants.push(Mutant {
            file: self.file.to_owned(),
            line: self.source[..range.start].matches('\n').count() + 1,
            source,
            function: self.functions.join("::"),
            operator,
            form,
            original: original.to_owned(),
            changed,
            repeat: 0,
            range,
        });
    }

    /// Adds the mutant that a part of a node reads differently.
    fn replace(&mut self, operator: &'static str, node: &impl Spanned, part: Range<usize>, other: &str) {
        self.replace_all(operator, node, &[(part, other.to_owned())]);
    }

    fn replace_all(&mut self, operator: &'static str, node: &impl Spanned, parts: &[(Range<usize>, String)]) {
        let range = Self::range(node);
        let mut changed = String::new();
        let mut at = range.start;
        for (part, other) in parts {
            changed.push_str(&self.source[at..part.start]);
            changed.push_str(other);
            at = part.end;
        }
        changed.push_str(&self.source[at..range.end]);
        self.add(operator, Form::Value, range, changed);
    }

    fn exchange(&mut self, operator: &'static str, node: &impl Spanned, a: &impl Spanned, b: &impl Spanned) {
        let parts = [(Self::range(a), self.text(b).to_owned()), (Self::range(b), self.text(a).to_owned())];
        self.replace_all(operator, node, &parts);
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
            // The left side of an assignment must stay a place.
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
