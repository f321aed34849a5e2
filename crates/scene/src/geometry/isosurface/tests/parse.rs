//! Expressions: precedence, values, and messages about mistakes.
use glam::DVec3;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{Expression, random::tree, value};

fn at(text: &str, p: [f64; 3]) -> f64 {
    value(&Expression::parse(text).unwrap_or_else(|e| panic!("{text}: {e:?}")), DVec3::from_array(p))
}

#[test]
fn precedence_is_that_of_mathematics() {
    let p = [3.0, 2.0, 0.5];
    assert_eq!(at("-x^2", p), -9.0);
    assert_eq!(at("(-x)^2", p), 9.0);
    assert_eq!(at("2^3^2*x", [1.0, 0.0, 0.0]), 512.0);
    assert_eq!(at("x^-2", [2.0, 0.0, 0.0]), 0.25);
    assert_eq!(at("x - y - z", p), 0.5);
    assert_eq!(at("x / y / z", p), 3.0);
    assert_eq!(at("2 * -x", p), -6.0);
    assert_eq!(at("x--y", p), 5.0);
    assert_eq!(at("-2^2 + x", p), -1.0);
    assert_eq!(at("1e-3 * x + .5 + 2.", [0.0; 3]), 2.5);
    assert_eq!(at("min(x, y, z) + max(x, y, z)", p), 3.5);
    assert_eq!(at("x + cos(0) + exp(0) + log(1)", p), 5.0);
    assert!((at("sin(pi*x)", [0.5, 0.0, 0.0]) - 1.0).abs() < 1e-12);
    assert!((at("x^(1/3)", [8.0, 0.0, 0.0]) - 2.0).abs() < 1e-6);
}

#[test]
fn equal_parts_are_computed_once() {
    let torus = Expression::parse("(x^2 + y^2 + z^2 + 0.84)^2 - 4*(z^2 + x^2)").expect("an expression");
    assert_eq!(torus.tape.len(), 10);
    let sphere = Expression::parse("x*x + 0*sin(y) + 1*y^2 + z*z*1 - 1 - 2 + 2").expect("an expression");
    assert_eq!(sphere.tape.len(), 6);
}

#[test]
fn random_expressions_have_their_values() {
    let mut rng = SmallRng::seed_from_u64(1);
    let mut compared = 0;
    for _ in 0..20_000 {
        let depth = rng.random_range(1..6);
        let tree = tree(&mut rng, depth);
        // Constant expressions are refused.
        let Ok(expression) = Expression::parse(&tree.to_string()) else { continue };
        for _ in 0..4 {
            let p = DVec3::from_array([0; 3].map(|_| rng.random_range(-2.0..2.0)));
            let (expected, found) = (tree.value(p), value(&expression, p));
            // Where the last bits of f64 matter nothing can be compared.
            let stable = (tree.value(p * (1.0 + 1e-14)) - expected).abs() < 1e-7;
            if stable && expected.abs() < 1e6 && found.abs() < 1e6 {
                compared += 1;
                assert!((expected - found).abs() <= 1e-5 * (1.0 + expected.abs()), "{tree} at {p}: {found}, exactly {expected}");
            }
        }
    }
    assert!(compared > 50_000, "{compared}");
}

#[test]
fn errors_state_the_problem_and_its_place() {
    let cases: [(&str, std::ops::Range<usize>, &str, &str); 23] = [
        ("", 0..0, "empty", "x^2"),
        ("  ", 0..2, "empty", "x^2"),
        ("x +", 3..3, "ends too early", "a number, a name or ("),
        ("(x + 1", 0..1, "not closed", ") is missing"),
        ("x + 1)", 5..6, "\")\" is not expected", "no matching ("),
        ("2x", 1..2, "\"x\" is not expected", "operator"),
        ("2*sni(x)", 2..5, "\"sni\" is not known", "did you mean sin?"),
        ("a + 1", 0..1, "\"a\" is not known", "known are"),
        ("sqr(x)", 0..3, "\"sqr\" is not known", "sqrt"),
        ("sin x", 0..3, "sin is a function", "sin(…)"),
        ("sin(x, y)", 5..6, "comma", "too many"),
        ("max(x)", 0..3, "two arguments", "max(a, b)"),
        ("x ^ y", 4..5, "power must be a number", "exp(b * log(a))"),
        ("x^(2*50)", 2..8, "must lie between", "too high"),
        ("x / (1 - 1)", 4..11, "division by zero", "0"),
        ("x * / y", 4..5, "\"/\" is not expected", "number"),
        ("x & y", 2..3, "\"&\" is not known", "not part"),
        ("x − y", 2..5, "\"−\" is not known", "write -"),
        ("1e99 * x", 0..4, "too large", "3.4e38"),
        ("x + .", 4..5, "not a number", "digits"),
        ("3 - 1", 0..5, "same number everywhere", "x, y or z"),
        ("1e30*1e30*x", 0..11, "infinite", "3.4e38"),
        ("x + exp(1 + (x - x)^-1)", 8..22, "infinite", "divides by 0"),
    ];
    for (text, at, message, label) in cases {
        let error = Expression::parse(text).err().unwrap_or_else(|| panic!("{text} is an expression"));
        assert_eq!(error.at, at, "{text}: {error:?}");
        assert!(error.message.contains(message) && error.label.contains(label), "{text}: {error:?}");
    }
}

#[test]
fn expressions_that_are_too_long_or_deep_are_errors() {
    let deep = |open: &str, close: &str, n: usize| format!("{}x{}", open.repeat(n), close.repeat(n));
    assert!(Expression::parse(&deep("(", ")", 60)).is_ok());
    for text in [deep("(", ")", 2000), deep("-", "", 4000), deep("sin(", ")", 800), deep("(", "", 4000), "x^".repeat(2000)] {
        let error = Expression::parse(&text).expect_err("too deep");
        assert!(error.message.contains("nested"), "{error:?}");
    }
    assert!(Expression::parse(&"x".repeat(5000)).expect_err("too long").message.contains("bytes"));
    let terms: Vec<String> = (2..300).map(|i| format!("sin({i}*x)")).collect();
    assert!(Expression::parse(&terms.join("+")).expect_err("too long").message.contains("too long"));
    // Forty results are waiting when the innermost is reached.
    let waiting: String = (2..42).map(|i| format!("sin({i}*x) - (")).collect();
    assert!(Expression::parse(&(waiting + "y" + &")".repeat(40))).expect_err("too complex").message.contains("complex"));
}

#[test]
fn no_text_makes_the_parser_panic() {
    const PARTS: [&str; 34] = [
        "x", "y", "z", "pi", "+", "-", "*", "/", "^", "(", ")", ",", "sin", "min(", "max", "sqrt(", "log(", "1", "0", "2.5",
        "1e", "e-3", ".", "..", " ", "\n", "é", "−", "\u{0}", "_", "1e-3", "64", "𝒙", "abs",
    ];
    let mut rng = SmallRng::seed_from_u64(2);
    let mut parsed = 0;
    for _ in 0..200_000 {
        let text: String = (0..rng.random_range(0..12)).map(|_| PARTS[rng.random_range(0..PARTS.len())]).collect();
        match Expression::parse(&text) {
            Ok(_) => parsed += 1,
            Err(error) => assert!(text.get(error.at.clone()).is_some(), "{text}: {error:?}"),
        }
    }
    assert!(parsed > 1000, "{parsed}");
}
