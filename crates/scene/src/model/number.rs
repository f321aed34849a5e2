//! Numbers in mesh files, in every notation that other readers accept.
/// Parses a real number, which may be infinite or NaN. `None` if the word is not a number.
///
/// Accepts Rust's notation, exponents after `d` as in Fortran, and a sign before the exponent, as in `3.1+e2`, where readers like
/// C's `strtod` stop before the sign.
pub fn real(word: &str) -> Option<f32> {
    word.parse().ok().or_else(|| unusual(word))
}

/// Parses the notations that Rust does not have.
#[cold]
fn unusual(word: &str) -> Option<f32> {
    let word = word.replace(['d', 'D'], "e");
    word.parse().ok().or_else(|| mantissa(&word)?.parse().ok())
}

/// The number before a misplaced sign and exponent.
fn mantissa(word: &str) -> Option<&str> {
    let at = word.find("+e").or_else(|| word.find("-e")).or_else(|| word.find("+E")).or_else(|| word.find("-E"))?;
    let digits = &word[at + 2..];
    (!digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit())).then_some(&word[..at])
}

/// Parses a whole number, with or without a decimal point.
pub fn whole(word: &str) -> Option<i64> {
    /// f64 represents all whole numbers up to this one.
    const MOST: f64 = 9_007_199_254_740_992.0;
    let real = || word.parse().ok().filter(|x: &f64| x.fract() == 0.0 && x.abs() <= MOST).map(|x| x as i64);
    word.parse().ok().or_else(real)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_however_they_are_written() {
        for (word, value) in [
            ("1.5", 1.5),
            ("+.5", 0.5),
            ("-.5", -0.5),
            ("2.", 2.0),
            ("1.e2", 100.0),
            ("+1e+02", 100.0),
            ("1E-2", 0.01),
            ("1.5d3", 1500.0),
            ("-1.0D+03", -1000.0),
            ("3.1+e2", 3.1),
            ("-3.1-e2", -3.1),
            ("+3.1+E2", 3.1),
            ("0000000000000000000000001", 1.0),
            ("1e-400", 0.0),
        ] {
            assert_eq!(real(word), Some(value), "{word}");
        }
        for word in ["", "x", "1,5", "1.5.2", "1e", "e5", "+", "3.1+e", "3.1+ex", "+e2", "1 2", "0x10", "dd"] {
            assert_eq!(real(word), None, "{word}");
        }
        assert!(real("nan").is_some_and(f32::is_nan) && real("1e99") == Some(f32::INFINITY));
    }

    #[test]
    fn whole_numbers_may_have_a_point() {
        assert_eq!([whole("3"), whole("+3"), whole("-3"), whole("3.0"), whole("3e2")], [3, 3, -3, 3, 300].map(Some));
        assert_eq!([whole("1.5"), whole("x"), whole("1e300"), whole("nan"), whole("")], [None; 5]);
    }
}
