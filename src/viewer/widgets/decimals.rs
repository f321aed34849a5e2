//! Numbers with decimals. A number that rounds to zero has no sign.

/// A number with this many decimals: 0.000 and never -0.000.
pub fn fixed(x: f64, decimals: usize) -> String {
    unsigned_zero(format!("{x:.decimals$}"))
}

/// Three numbers with spaces between them.
pub fn three(numbers: [f64; 3], decimals: usize) -> String {
    numbers.map(|x| fixed(x, decimals)).join(" ")
}

/// The text of a number, without the sign of a zero.
pub fn unsigned_zero(text: String) -> String {
    if text.parse::<f64>() == Ok(0.0) { text.replace('-', "") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_round_to_zero_have_no_sign() {
        assert_eq!(three([-0.000_4, -0.0, -0.001], 3), "0.000 0.000 -0.001");
        assert_eq!([fixed(-1e-17, 0), fixed(2.5, 1), fixed(f64::NAN, 2)], ["0", "2.5", "NaN"]);
    }
}
