//! Evaluates what is typed into a number field: `3/2`, `2*0.25`, `-(1 + 1e-3)`.
use noisefall_base::quote;

/// Most parentheses within each other.
const DEEPEST: usize = 32;

/// The value of an expression of numbers, `+ - * /` and parentheses. One comma is a decimal point, if there is no dot. The error says
/// what is wrong.
pub fn evaluate(text: &str) -> Result<f64, String> {
    let found = quote::piece(text.trim());
    let compact: String = text.chars().filter(|c| !c.is_whitespace()).map(ascii).collect();
    let compact = match (compact.matches(',').count(), compact.contains('.')) {
        (0, _) => compact,
        (1, false) => compact.replace(',', "."),
        _ => return Err(format!("expected one number, found “{found}”; use a dot for decimals, and no other separators")),
    };
    let mut reader = ExpressionReader { rest: &compact, depth: 0 };
    let value = reader.sum().filter(|_| reader.rest.is_empty());
    let value = value.ok_or_else(|| format!("expected a number, found “{found}”"))?;
    if value.is_finite() { Ok(value) } else { Err(format!("“{found}” is not a finite number")) }
}

/// The operators that other keyboards have.
fn ascii(c: char) -> char {
    match c {
        '−' => '-',
        '×' | '·' => '*',
        '÷' | ':' => '/',
        other => other,
    }
}

/// Reads an expression by recursive descent. `None`: the text is none.
struct ExpressionReader<'t> {
    rest: &'t str,
    depth: usize,
}

impl ExpressionReader<'_> {
    fn sum(&mut self) -> Option<f64> {
        let mut value = self.product()?;
        loop {
            if self.takes('+') {
                value += self.product()?;
            } else if self.takes('-') {
                value -= self.product()?;
            } else {
                return Some(value);
            }
        }
    }

    fn product(&mut self) -> Option<f64> {
        let mut value = self.factor()?;
        loop {
            if self.takes('*') {
                value *= self.factor()?;
            } else if self.takes('/') {
                value /= self.factor()?;
            } else {
                return Some(value);
            }
        }
    }

    fn factor(&mut self) -> Option<f64> {
        let mut sign = 1.0;
        loop {
            if self.takes('-') {
                sign = -sign;
            } else if !self.takes('+') {
                break;
            }
        }
        if !self.takes('(') {
            return Some(sign * self.number()?);
        }
        self.depth += 1;
        let value = if self.depth <= DEEPEST { self.sum()? } else { return None };
        self.depth -= 1;
        self.takes(')').then_some(sign * value)
    }

    fn number(&mut self) -> Option<f64> {
        let rest = self.rest;
        let digits = |from: usize| from + rest[from..].bytes().take_while(u8::is_ascii_digit).count();
        let mut end = digits(0);
        if rest[end..].starts_with('.') {
            end = digits(end + 1);
        }
        if rest[end..].starts_with(['e', 'E']) {
            let first = end + 1 + usize::from(rest[end + 1..].starts_with(['+', '-']));
            let last = digits(first);
            end = if last > first { last } else { end };
        }
        let (number, after) = rest.split_at(end);
        self.rest = after;
        number.parse().ok()
    }

    fn takes(&mut self, sign: char) -> bool {
        let after = self.rest.strip_prefix(sign);
        self.rest = after.unwrap_or(self.rest);
        after.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_simple_arithmetic_have_their_value() {
        for (text, value) in [
            ("3/2", 1.5),
            ("2*0.25", 0.5),
            ("1e-3", 1e-3),
            (" 1 + 2 * 3 − 4 ", 3.0),
            ("-(1 + 1)/4", -0.5),
            ("8/2/2", 2.0),
            ("--.5", 0.5),
            ("2.", 2.0),
            ("1E+2-1e2", 0.0),
            ("3×2", 6.0),
            ("12 000", 12_000.0),
        ] {
            assert_eq!(evaluate(text), Ok(value), "{text}");
        }
    }

    #[test]
    fn one_comma_without_a_dot_is_a_decimal_point() {
        assert_eq!([evaluate("0,25"), evaluate("-1,5e2")], [Ok(0.25), Ok(-150.0)]);
        let refusal = "expected one number, found “1,000.5”; use a dot for decimals, and no other separators";
        assert_eq!(evaluate("1,000.5"), Err(refusal.to_owned()));
        assert!(evaluate("0,5*0,5").is_err());
    }

    #[test]
    fn a_text_that_is_no_number_is_refused_and_quoted() {
        assert_eq!(evaluate(" wide "), Err("expected a number, found “wide”".to_owned()));
        assert_eq!(evaluate("1/0"), Err("“1/0” is not a finite number".to_owned()));
        for text in ["", ".", "3/", "(1", "1)", "2 e", "1e", "inf", "NaN", "0x10", "3**2", "1e999", "½"] {
            assert!(evaluate(text).is_err(), "{text}");
        }
        let nested = |depth: usize| format!("{}1{}", "(".repeat(depth), ")".repeat(depth));
        assert!(evaluate(&nested(DEEPEST)).is_ok() && evaluate(&nested(100_000)).is_err());
    }
}
