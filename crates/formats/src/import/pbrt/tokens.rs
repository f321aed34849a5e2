//! The words of a scene: directives, quoted strings, brackets.
use std::rc::Rc;

use super::source::TextSpan;
use noisefall_scene::scene::{SceneError, SourceText};

/// A piece of text with a meaning of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Token {
    /// A directive, a number, `true` or `false`.
    Word,
    /// Text between quotes.
    Quoted,
    /// `[`
    Open,
    /// `]`
    Close,
}

/// Splits a text into tokens.
pub struct Tokens {
    source: Rc<SourceText>,
    at: usize,
    line: u32,
    /// Where the line begins.
    line_start: usize,
    /// The token that was looked at but not taken.
    peeked: Option<(Token, TextSpan)>,
}

impl Tokens {
    /// The tokens of a text.
    pub fn new(source: Rc<SourceText>) -> Tokens {
        Tokens { source, at: 0, line: 1, line_start: 0, peeked: None }
    }

    /// The next token, which is taken; `None` at the end of the text.
    pub fn next(&mut self) -> Result<Option<(Token, TextSpan)>, SceneError> {
        if let Some(peeked) = self.peeked.take() {
            return Ok(Some(peeked));
        }
        self.scan()
    }

    /// The next token, which stays.
    pub fn peek(&mut self) -> Result<Option<Token>, SceneError> {
        if self.peeked.is_none() {
            self.peeked = self.scan()?;
        }
        Ok(self.peeked.as_ref().map(|(token, _)| *token))
    }

    /// The text at a place of this source.
    pub fn text(&self, place: &TextSpan) -> &str {
        &self.source.text[place.start..place.end]
    }

    /// The end of the text, as a place.
    pub fn end(&self) -> TextSpan {
        self.place(self.source.text.len())
    }

    fn place(&self, start: usize) -> TextSpan {
        let column = (start - self.line_start.min(start)) as u32 + 1;
        TextSpan { source: self.source.clone(), start, end: start, line: self.line, column }
    }

    fn scan(&mut self) -> Result<Option<(Token, TextSpan)>, SceneError> {
        self.skip_blanks();
        let bytes = self.source.text.as_bytes();
        let Some(first) = bytes.get(self.at) else { return Ok(None) };
        let mut place = self.place(self.at);
        let token = match first {
            b'[' => Token::Open,
            b']' => Token::Close,
            b'"' => Token::Quoted,
            _ => Token::Word,
        };
        let length = match token {
            Token::Open | Token::Close => 1,
            Token::Word => bytes[self.at..].iter().position(|byte| is_end_of_word(*byte)).unwrap_or(bytes.len() - self.at),
            Token::Quoted => quoted_length(&bytes[self.at..]).ok_or_else(|| {
                let line = TextSpan { end: (place.start + 1).min(bytes.len()), ..place.clone() };
                line.error("a quoted string does not end", "its closing quote is missing on this line")
            })?,
        };
        self.at += length;
        place.end = self.at;
        Ok(Some((token, place)))
    }

    fn skip_blanks(&mut self) {
        let bytes = self.source.text.as_bytes();
        let mut comment = false;
        while let Some(byte) = bytes.get(self.at) {
            match byte {
                b'\n' => {
                    comment = false;
                    self.line += 1;
                    self.line_start = self.at + 1;
                }
                b'#' => comment = true,
                b' ' | b'\t' | b'\r' | 0x0b | 0x0c => {}
                _ if comment => {}
                _ => return,
            }
            self.at += 1;
        }
    }
}

fn is_end_of_word(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | b'\n' | 0x0b | 0x0c | b'"' | b'[' | b']' | b'#')
}

/// Length of a quoted string, with its quotes; `None` if it does not end on its line.
fn quoted_length(bytes: &[u8]) -> Option<usize> {
    let mut at = 1;
    loop {
        match bytes.get(at)? {
            b'"' => return Some(at + 1),
            b'\n' => return None,
            b'\\' => at += 2,
            _ => at += 1,
        }
    }
}

/// The text of a quoted token, with its escapes resolved.
pub fn unquoted(token: &str) -> String {
    let inner = token.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(token);
    if !inner.contains('\\') {
        return inner.to_owned();
    }
    let mut text = String::with_capacity(inner.len());
    let mut characters = inner.chars();
    while let Some(character) = characters.next() {
        text.push(match character {
            '\\' => match characters.next().unwrap_or('\\') {
                'b' => '\u{8}',
                'f' => '\u{c}',
                'n' => '\n',
                'r' => '\r',
                't' => '\t',
                other => other,
            },
            other => other,
        });
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Tokens {
        Tokens::new(Rc::new(SourceText { name: "a.pbrt".into(), text: text.into() }))
    }

    fn all(text: &str) -> Vec<(Token, String)> {
        let mut tokens = tokens(text);
        let mut found = Vec::new();
        while let Some((token, place)) = tokens.next().expect("it is valid") {
            found.push((token, tokens.text(&place).to_owned()));
        }
        found
    }

    #[test]
    fn words_strings_and_brackets_need_no_spaces() {
        let found = all("Shape\"sphere\"[1 -2e3]# a \"comment [\n\ttrue");
        let words: Vec<&str> = found.iter().map(|(_, text)| text.as_str()).collect();
        assert_eq!(words, ["Shape", "\"sphere\"", "[", "1", "-2e3", "]", "true"]);
        assert_eq!([found[0].0, found[1].0, found[2].0, found[5].0], [Token::Word, Token::Quoted, Token::Open, Token::Close]);
    }

    #[test]
    fn escapes_are_resolved() {
        assert_eq!(unquoted(r#""a \"b\"\n\\""#), "a \"b\"\n\\");
        assert_eq!(all(r#" "a\"b" c"#).len(), 2);
    }

    #[test]
    fn places_have_lines_and_columns() {
        let mut tokens = tokens("# é\n  Shape\n");
        let (_, place) = tokens.next().expect("it is valid").expect("a token");
        assert_eq!(place.to_string(), "a.pbrt:2:3");
        assert!(tokens.next().expect("it is valid").is_none());
    }

    #[test]
    fn strings_end_on_their_line() {
        for text in ["\"abc", "\"abc\ndef\"", "\"", "\"\\"] {
            assert!(tokens(text).next().is_err_and(|error| error.to_string().contains("does not end")), "{text}");
        }
    }
}
