//! Numbers with their nouns.
use std::fmt::Display;

/// "1 sample", "2 samples": a number with a noun whose plural ends in s.
pub fn counted<N: Copy + Display + PartialEq + From<u8>>(count: N, noun: &str) -> String {
    format!("{count} {noun}{}", if count == N::from(1) { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_one_has_no_plural() {
        assert_eq!([0, 1, 2].map(|count: u32| counted(count, "sample")), ["0 samples", "1 sample", "2 samples"]);
        assert_eq!(counted(1usize, "remark"), "1 remark");
    }
}
