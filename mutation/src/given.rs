//! Mutants that somebody wrote by hand, so that they can always be made again.
use serde::Deserialize;
use syn::{
    Expr, Stmt,
    spanned::Spanned,
    visit::{self, Visit},
};

use crate::{
    Outcome,
    mutant::{Form, Mutant},
    package::Package,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    mutant: Vec<Given>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Given {
    /// The mistake, in words.
    name: String,
    file: String,
    /// A whole expression or statement that the file has once.
    original: String,
    changed: String,
}

/// Reads the mutants of a TOML text, of a table with this name, and finds their places.
pub fn read(text: &str, table: &str, package: &Package) -> Outcome<Vec<Mutant>> {
    let mutants: Table = toml::from_str(text).map_err(|error| format!("{table}: {error}"))?;
    let found: Vec<Outcome<Mutant>> = mutants.mutant.iter().map(|given| find(given, package.text(&given.file))).collect();
    let errors: Vec<String> = found.iter().filter_map(|mutant| Some(format!("{table}, {}", mutant.as_ref().err()?))).collect();
    if errors.is_empty() { found.into_iter().collect() } else { Err(errors.join("\n")) }
}

fn find(given: &Given, source: &str) -> Outcome<Mutant> {
    let Given { name, file, original, changed } = given;
    let original = original.trim();
    let wrong = |reason: &str| format!("\"{name}\": {file} {reason}: {original}");
    let mut places = source.match_indices(original).map(|(at, _)| at..at + original.len());
    let range = places.next().ok_or_else(|| wrong("does not have this text any more"))?;
    if places.next().is_some() {
        return Err(wrong("has this text more than once"));
    }
    let parsed = syn::parse_file(source).map_err(|error| format!("{file}: {error}"))?;
    let mut whole = Whole { range, form: None };
    whole.visit_file(&parsed);
    let form = whole.form.ok_or_else(|| wrong("has this text, but it is not a whole expression or statement"))?;
    let is_value = form == Form::Place && !syn::parse_str(changed).is_ok_and(|changed| is_place(&changed));
    let form = if is_value { Form::Value } else { form };
    let start = source[..whole.range.start].rfind('\n').map_or(0, |at| at + 1);
    Ok(Mutant {
        file: file.clone(),
        line: source[..whole.range.start].matches('\n').count() + 1,
        source: source[start..].lines().next().unwrap_or_default().trim().to_owned(),
        function: name.clone(),
        operator: "given",
        form,
        original: original.to_owned(),
        changed: changed.trim().to_owned(),
        repeat: 0,
        range: whole.range,
    })
}

/// Whether an expression names a place in memory.
fn is_place(node: &Expr) -> bool {
    matches!(node, Expr::Path(_) | Expr::Field(_) | Expr::Index(_))
}

/// Looks for the expression or statement at a place.
struct Whole {
    range: std::ops::Range<usize>,
    form: Option<Form>,
}

impl<'ast> Visit<'ast> for Whole {
    fn visit_expr(&mut self, node: &'ast Expr) {
        if node.span().byte_range() == self.range {
            self.form = self.form.or(Some(if is_place(node) { Form::Place } else { Form::Value }));
        }
        visit::visit_expr(self, node);
    }

    fn visit_stmt(&mut self, node: &'ast Stmt) {
        if node.span().byte_range() == self.range && matches!(node, Stmt::Expr(_, Some(_)) | Stmt::Macro(_)) {
            self.form = Some(Form::Statement);
        }
        visit::visit_stmt(self, node);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(original: &str) -> Outcome<Mutant> {
        let given =
            Given { name: "n".to_owned(), file: "f".to_owned(), original: original.to_owned(), changed: "x.y".to_owned() };
        find(&given, "fn f() {\n    g(a * 2 + b);\n    h(b);\n    c.d\n}")
    }

    #[test]
    fn whole_expressions_and_statements_are_found() {
        let forms = ["a * 2", "a * 2 + b", "h(b);", "c.d"].map(|text| found(text).map(|mutant| (mutant.line, mutant.form)));
        assert_eq!(forms, [Ok((2, Form::Value)), Ok((2, Form::Value)), Ok((3, Form::Statement)), Ok((4, Form::Place))]);
    }

    #[test]
    fn text_that_is_gone_twice_there_or_torn_is_named() {
        for (original, reason) in [("z", "any more"), ("b", "more than once"), ("2 + b", "not a whole")] {
            assert!(found(original).is_err_and(|error| error.contains(reason) && error.ends_with(original)), "{original}");
        }
    }
}
