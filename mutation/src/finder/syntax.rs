//! Questions to the syntax of Rust.
use proc_macro2::TokenStream;
use syn::{Attribute, Expr, Ident, Item, Token, parse::ParseStream};

/// Whether what has these attributes is left out: tests, and what only some systems compile.
pub fn is_conditional(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let condition = match attribute.parse_args::<TokenStream>() {
            Ok(tokens) if attribute.path().is_ident("cfg") => tokens.to_string(),
            _ => return attribute.path().is_ident("test"),
        };
        condition != "unix" && !condition.starts_with("feature") && condition != "target_arch = \"x86_64\""
    })
}

/// Constants cannot be switched, but their uses can.
pub(super) fn numeric_constant(item: &Item) -> Option<(String, &'static str)> {
    let Item::Const(item) = item else { return None };
    let syn::Type::Path(kind) = &*item.ty else { return None };
    let change = match kind.path.get_ident()?.to_string().as_str() {
        "f32" | "f64" => " * 2.0",
        "u8" | "u16" | "u32" | "u64" | "usize" | "i32" | "i64" => " + 1",
        _ => return None,
    };
    Some((item.ident.to_string(), change))
}

/// `value, name => call`
pub(super) fn call_with_name(input: ParseStream) -> syn::Result<[Expr; 2]> {
    let value = input.parse()?;
    input.parse::<Token![,]>()?;
    input.parse::<Ident>()?;
    input.parse::<Token![=>]>()?;
    let call = input.parse()?;
    input.parse::<Option<Token![,]>>()?;
    Ok([value, call])
}

pub(super) fn last_name(function: &Expr) -> Option<String> {
    let Expr::Path(function) = function else { return None };
    function.path.segments.last().map(|last| last.ident.to_string())
}

pub(super) fn type_name(kind: &syn::Type) -> Option<String> {
    let syn::Type::Path(kind) = kind else { return None };
    kind.path.segments.last().map(|last| last.ident.to_string())
}
