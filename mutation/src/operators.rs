//! Mistakes that turn an operator, a literal or the name of a method into another one.
use syn::{BinOp, Lit};

/// Returns the operators that this one may be mistaken for.
pub fn instead_of(operator: &BinOp) -> &'static [&'static str] {
    match operator {
        BinOp::Add(_) => &["-"],
        BinOp::Sub(_) => &["+"],
        BinOp::Mul(_) => &["/"],
        BinOp::Div(_) => &["*"],
        BinOp::Rem(_) => &["/"],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        BinOp::BitAnd(_) => &["|"],
        BinOp::BitOr(_) | BinOp::BitXor(_) => &["&"],
        BinOp::Shl(_) => &[">>"],
        BinOp::Shr(_) => &["<<"],
        BinOp::Lt(_) => &["<=", ">"],
        BinOp::Le(_) => &["<", ">="],
        BinOp::Gt(_) => &[">=", "<"],
        BinOp::Ge(_) => &[">", "<="],
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::AddAssign(_) => &["-=", "="],
        BinOp::SubAssign(_) => &["+="],
        BinOp::MulAssign(_) => &["/="],
        BinOp::DivAssign(_) => &["*="],
        BinOp::BitAndAssign(_) => &["|="],
        BinOp::BitOrAssign(_) => &["&=", "="],
        _ => &[],
    }
}

/// Whether the bound of a comparison is a real number that nothing meets, so that it does not matter whether it is included.
pub fn is_never_met(comparison: &str) -> bool {
    let numbers = comparison.split(|c: char| !(c.is_ascii_alphanumeric() || c == '.' || c == '_'));
    let reals = numbers.filter(|number| number.contains('.') && number.starts_with(|c: char| c.is_ascii_digit()));
    reals.filter_map(|number| number.parse::<f64>().ok()).any(|number| number != 0.0 && number != 1.0)
}

/// Returns a mistake for a literal. Text has none, nor have bit patterns (hexadecimal), since any other is as good.
pub fn other_literal(literal: &Lit) -> Option<String> {
    match literal {
        Lit::Bool(value) => Some((!value.value).to_string()),
        Lit::Int(value) => {
            let text = value.to_string();
            if text.starts_with("0x") || text.starts_with("0b") {
                return None;
            }
            let other = match value.base10_parse::<u128>().ok()? {
                1 => 0,
                n => n + 1,
            };
            Some(format!("{other}{}", value.suffix()))
        }
        Lit::Float(value) => {
            let other = match value.base10_parse::<f64>().ok()? {
                0.0 => 1.0,
                x if x < 1.0 => 2.0 * x,
                x => 0.5 * x,
            };
            Some(format!("{other:?}{}", value.suffix()))
        }
        _ => None,
    }
}

/// Names that are mistaken for each other, of methods and functions.
const NAMES: &[(&str, &str)] = &[
    ("above", "below"),
    ("acos", "asin"),
    ("all", "any"),
    ("ceil", "floor"),
    ("cos", "sin"),
    ("exp", "ln"),
    ("first", "last"),
    ("floor", "round"),
    ("ge", "le"),
    ("height", "width"),
    ("is_none", "is_some"),
    ("is_err", "is_ok"),
    ("gt", "lt"),
    ("left", "right"),
    ("max", "min"),
    ("max_by", "min_by"),
    ("max_by_key", "min_by_key"),
    ("max_component", "min_component"),
    ("max_element", "min_element"),
    ("product", "sum"),
    ("starts_with", "ends_with"),
    ("to_degrees", "to_radians"),
];

/// Names that the name may be mistaken for.
pub fn other_names(name: &str) -> impl Iterator<Item = &'static str> {
    NAMES.iter().filter_map(move |&(a, b)| if name == a { Some(b) } else { (name == b).then_some(a) })
}

/// Methods that are easily forgotten, for what they give is of the type of what they are called on.
pub fn is_forgotten(method: &str) -> bool {
    const METHODS: &[&str] = &[
        "abs",
        "ceil",
        "clamp",
        "copysign",
        "exp",
        "floor",
        "inverse",
        "ln",
        "max",
        "min",
        "normalize",
        "normalized",
        "powf",
        "powi",
        "recip",
        "rev",
        "round",
        "skip",
        "sqrt",
        "to_degrees",
        "to_radians",
        "transpose",
        "trim",
    ];
    METHODS.contains(&method)
}

/// Fields that are mistaken for each other.
pub fn other_field(name: &str) -> Option<&'static str> {
    const FIELDS: &[(&str, &str)] = &[
        ("x", "y"),
        ("y", "z"),
        ("z", "x"),
        ("u", "v"),
        ("v", "u"),
        ("0", "1"),
        ("1", "0"),
        ("min", "max"),
        ("max", "min"),
        ("low", "high"),
        ("high", "low"),
        ("width", "height"),
        ("height", "width"),
        ("eta", "k"),
        ("start", "end"),
        ("end", "start"),
        ("front", "back"),
        ("back", "front"),
    ];
    FIELDS.iter().find(|(field, _)| *field == name).map(|(_, other)| *other)
}

/// Arguments of these are sizes, gaps and colours of the window and of plots: no test should hold them.
pub fn is_look(function: &str) -> bool {
    const FUNCTIONS: &[&str] = &[
        "add_space",
        "column",
        "corner_radius",
        "desired_width",
        "fixed_pos",
        "from_gray",
        "from_rgb",
        "from_rgba_unmultiplied",
        "font",
        "gamma_multiply",
        "inner_margin",
        "margin",
        "max_col_width",
        "max_height",
        "max_width",
        "min_col_width",
        "min_height",
        "min_size",
        "min_width",
        "num_columns",
        "rect_filled",
        "rect_stroke",
        "rounding",
        "spacing",
        "default_size",
        "default_width",
        "default_height",
        "stroke",
        "symmetric",
        "vec2",
        "with_inner_size",
        "with_min_inner_size",
        "circle_filled",
        "line_segment",
        "linear_multiply",
        "shrink",
        "shrink2",
        "expand",
        "max_decimals",
        "speed",
    ];
    FUNCTIONS.contains(&function)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_change_little_and_keep_their_type() {
        let cases =
            [("0", "1"), ("1u32", "0u32"), ("7_usize", "8usize"), ("0.5", "1.0"), ("4f32", "5f32"), ("2.0_f64", "1.0f64")];
        for (literal, other) in cases {
            assert_eq!(other_literal(&syn::parse_str(literal).expect("a literal")).as_deref(), Some(other));
        }
        assert_eq!(other_literal(&syn::parse_str("true").expect("a literal")).as_deref(), Some("false"));
        assert_eq!(other_literal(&syn::parse_str("0xffu32").expect("a literal")), None);
        assert_eq!(other_literal(&syn::parse_str("\"a\"").expect("a literal")), None);
    }

    #[test]
    fn bounds_that_are_met_are_told_from_others() {
        assert!(is_never_met("a < 0.25") && is_never_met("x.y >= 1e-3 * 2.5"));
        assert!(!is_never_met("a < 0.0") && !is_never_met("a.0 < 3") && !is_never_met("a.len() < b.len()"));
    }

    #[test]
    fn names_are_mistaken_both_ways() {
        assert_eq!(other_names("min").collect::<Vec<_>>(), ["max"]);
        assert_eq!(other_names("floor").collect::<Vec<_>>(), ["ceil", "round"]);
        assert_eq!(other_names("push").count(), 0);
    }
}
