//! Wording of messages.

/// A clause as the beginning of a sentence.
pub fn capitalised(clause: &str) -> String {
    let first = clause.chars().next().map_or(0, char::len_utf8);
    clause[..first].to_uppercase() + &clause[first..]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_begins_with_a_capital() {
        assert_eq!(["über allem", "", "A"].map(capitalised), ["Über allem", "", "A"]);
    }
}
