//! Quotation marks around names.

/// Text for the window: what is between backticks in a message of the library is between quotation marks.
pub fn with_quotation_marks(text: &str) -> String {
    let parts = text.split('`').count();
    if parts.is_multiple_of(2) {
        // One backtick has no partner.
        return text.to_owned();
    }
    let marks = ["”", "“"].into_iter().cycle().skip(1);
    let mut parts = text.split('`');
    let first = parts.next().unwrap_or_default().to_owned();
    parts.zip(marks).fold(first, |text, (part, mark)| text + mark + part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_of_backticks_become_quotation_marks() {
        assert_eq!(with_quotation_marks("`a b` is used at `c`"), "“a b” is used at “c”");
        assert_eq!(with_quotation_marks("nothing"), "nothing");
        assert_eq!(with_quotation_marks("a ` alone"), "a ` alone");
    }
}
