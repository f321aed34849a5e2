//! The places where mutants are found.
use super::*;

fn changes(body: &str) -> Vec<String> {
    let source = format!("fn f() {{ {body} }}");
    mutants("src/a.rs", &source).expect("it is Rust").iter().map(Mutant::change).collect()
}

#[test]
fn every_kind_of_place_is_found() {
    let cases = [
        ("a + b", "a + b → a - b"),
        ("a < b", "a < b → a <= b"),
        ("-a", "-a → a"),
        ("if a { b } else { c }", "a → !(a)"),
        ("x.min(y)", "x.min(y) → x.max(y)"),
        ("x.abs()", "x.abs() → x"),
        ("p.x", "p.x → p.y"),
        ("v[0]", "0 → 1"),
        ("g(a, b)", "g(a, b) → g(b, a)"),
        ("S { a, b: c }", "S { a, b: c } → S { a: c, b: a }"),
        ("match a { P => b, Q => c }", "match a { P => b, Q => c } → match a { P => c, Q => b }"),
        ("0..n", "0..n → 0..n + 1"),
        ("0..=n", "0..=n → 0..=n - 1"),
        ("g(a);", "g(a); → (dropped)"),
        ("a = b;", "a = b; → (dropped)"),
        ("if a { return; } b", "if a { return; } → (dropped)"),
        ("a += b;", "a += b → a -= b"),
        ("matches!(a, B)", "matches!(a, B) → !matches!(a, B)"),
        ("write!(to, \"{} {}\", a, b)", "write!(to, \"{} {}\", a, b) → write!(to, \"{} {}\", b, a)"),
        ("in_lanes!(level, l => g(l, 0.5))", "0.5 → 1.0"),
        ("vec![1.0; n + 1]", "n + 1 → n - 1"),
        ("match a { x if x > 1 => b, _ => c }", "x > 1 → x >= 1"),
    ];
    for (body, change) in cases {
        let found = changes(body);
        assert!(found.iter().any(|found| found == change), "{body}: {found:?}");
    }
}

#[test]
fn code_that_no_variable_can_switch_is_left_alone() {
    let cases = [
        "let a: [f32; 3] = b;",
        "const A: u32 = 1 + 2;",
        "if let Some(1..=2) = a && let Some(b) = c {}",
        "g::<3>(a)",
        "static A: u32 = 1;",
        "ui.add_space(4.0)",
        "\"text\"",
        "0xff",
    ];
    for body in cases {
        let found = changes(body);
        assert!(found.iter().all(|change| change.ends_with("(dropped)")), "{body}: {found:?}");
    }
}

#[test]
fn tests_and_constants_are_left_alone() {
    let source = "
        const fn a() -> u32 { 1 + 1 }
        macro_rules! m { () => { 1 + 1 } }
        #[cfg(test)] mod tests { fn b() -> u32 { 1 + 1 } }
        #[test] fn c() { d(1 + 1) }
        #[cfg(not(unix))] fn e() -> u32 { 1 + 1 }";
    assert!(mutants("src/a.rs", source).expect("it is Rust").is_empty());
}

#[test]
fn uses_of_constants_stand_for_the_constants() {
    let source = "const LIMIT: f64 = 3.0;\nimpl A { fn f(x: f64) -> bool { g(LIMIT) } }";
    let found = mutants("src/a.rs", source).expect("it is Rust");
    assert_eq!(found.iter().map(Mutant::change).collect::<Vec<_>>(), ["LIMIT → (LIMIT * 2.0)"]);
    assert_eq!((found[0].function.as_str(), found[0].line), ("A::f", 2));
    assert_eq!(&source[found[0].range.clone()], "LIMIT");
}
