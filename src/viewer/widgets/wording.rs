//! Wording of figures and messages.

/// A clause as the beginning of a sentence.
pub fn capitalised(clause: &str) -> String {
    let first = clause.chars().next().map_or(0, char::len_utf8);
    clause[..first].to_uppercase() + &clause[first..]
}

/// A number of things: "1 sample", "2 samples".
pub fn count(number: u64, thing: &str) -> String {
    if number == 1 { format!("1 {thing}") } else { format!("{number} {thing}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_begins_with_a_capital_and_one_thing_is_singular() {
        assert_eq!(["über allem", "", "A"].map(capitalised), ["Über allem", "", "A"]);
        assert_eq!([0, 1, 2].map(|number| count(number, "sample")), ["0 samples", "1 sample", "2 samples"]);
    }
}
