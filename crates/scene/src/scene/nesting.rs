//! Notices text that nests too deeply for the TOML parser, which would overflow the stack.
use std::ops::Range;

use toml_parser::{Source, lexer::TokenKind};

/// Most brackets that may be open at once. Far fewer are refused by the parser itself, but brackets that do not match make it lose count.
const DEEPEST: usize = 500;

/// The first bracket that is too deep.
pub fn too_deep(text: &str) -> Option<Range<usize>> {
    let mut open = Vec::new();
    for token in Source::new(text).lex() {
        match token.kind() {
            TokenKind::LeftSquareBracket => open.push(TokenKind::RightSquareBracket),
            TokenKind::LeftCurlyBracket => open.push(TokenKind::RightCurlyBracket),
            // The parser ignores those that do not match, too.
            kind if open.last() == Some(&kind) => _ = open.pop(),
            _ => {}
        }
        if open.len() > DEEPEST {
            return Some(token.span().start()..token.span().end());
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{CameraPath, describe};

    #[test]
    fn brackets_count_while_they_are_open_and_outside_of_strings() {
        assert_eq!(too_deep(&"a = [{ b = [1] }]\n[c]\n".repeat(DEEPEST)), None);
        assert_eq!(too_deep(&format!("a = \"{0}\" # {0}\nb = '''{0}'''", "[{".repeat(DEEPEST))), None);
        assert_eq!(too_deep(&format!("a = {}", "[".repeat(DEEPEST))), None);
        assert_eq!(too_deep(&format!("a = {}", "[".repeat(DEEPEST + 1))), Some(4 + DEEPEST..5 + DEEPEST));
    }

    #[test]
    fn text_that_would_overflow_the_stack_is_refused() {
        // An unclosed table in a string that is closed in the next line: after that, the parser counts depths below zero.
        for part in ["a = { b = { c = \"9]\nd = [0, 0, 0]\n", "a = [ { ] }", "{ [ } ]", "a = { b = [ ] ]", "[{\n", "a = {]"] {
            let text = part.repeat(100_000);
            std::thread::spawn(move || {
                assert!(describe("a", text.clone()).is_err());
                assert!(CameraPath::parse("a", text).is_err());
            })
            .join()
            .expect("it ends");
        }
    }
}
