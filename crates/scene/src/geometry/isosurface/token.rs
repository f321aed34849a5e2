//! Numbers, names and symbols of an expression.
use std::{fmt, ops::Range};

use super::parse_error::ParseError;

const SYMBOLS: &str = "+-*/^(),";

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'a> {
    Number(f64),
    Name(&'a str),
    Symbol(char),
}

impl fmt::Display for Token<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Token::Number(value) => write!(f, "{value}"),
            Token::Name(name) => write!(f, "\"{name}\""),
            Token::Symbol(symbol) => write!(f, "\"{symbol}\""),
        }
    }
}

/// The tokens of a text with their positions.
pub(super) struct Tokens<'a> {
    tokens: Vec<(Token<'a>, Range<usize>)>,
    next: usize,
    end: usize,
}

impl<'a> Tokens<'a> {
    pub fn new(text: &'a str) -> Result<Tokens<'a>, ParseError> {
        let mut tokens = Vec::new();
        let mut at = 0;
        while let Some(c) = text[at..].chars().next() {
            let rest = &text[at..];
            let (token, length) = match c {
                _ if c.is_whitespace() => {
                    at += c.len_utf8();
                    continue;
                }
                '0'..='9' | '.' => number(rest, at)?,
                'a'..='z' | 'A'..='Z' | '_' => name(rest),
                _ if SYMBOLS.contains(c) => (Token::Symbol(c), 1),
                _ => {
                    let label = if c == '−' { "write - instead" } else { "not part of an expression" };
                    return Err(ParseError::new(at..at + c.len_utf8(), format!("\"{}\" is not known", c.escape_debug()), label));
                }
            };
            tokens.push((token, at..at + length));
            at += length;
        }
        Ok(Tokens { tokens, next: 0, end: text.len() })
    }

    pub fn peek(&self) -> Option<Token<'a>> {
        self.tokens.get(self.next).map(|(token, _)| *token)
    }

    pub fn take(&mut self) -> Option<(Token<'a>, Range<usize>)> {
        let token = self.tokens.get(self.next).cloned();
        self.next += usize::from(token.is_some());
        token
    }

    /// The next token, if it is one of these symbols.
    pub fn take_symbol(&mut self, symbols: &[char]) -> Option<char> {
        match self.peek() {
            Some(Token::Symbol(symbol)) if symbols.contains(&symbol) => {
                self.next += 1;
                Some(symbol)
            }
            _ => None,
        }
    }

    /// The position of the next token, or the end of the text.
    pub fn here(&self) -> Range<usize> {
        self.tokens.get(self.next).map_or(self.end..self.end, |(_, at)| at.clone())
    }

    /// The end of the previous token.
    pub fn last_end(&self) -> usize {
        self.next.checked_sub(1).map_or(0, |last| self.tokens[last].1.end)
    }
}

fn name(rest: &str) -> (Token<'_>, usize) {
    let length = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
    (Token::Name(&rest[..length]), length)
}

/// Digits with a point and an exponent, such as 2, .5 and 1e-3.
fn number(rest: &str, at: usize) -> Result<(Token<'_>, usize), ParseError> {
    let bytes = rest.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length += 1 + digits(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let exponent = digits(length + 1 + sign);
        length += if exponent > 0 { 1 + sign + exponent } else { 0 };
    }
    match rest[..length].parse::<f64>() {
        Ok(value) if (value as f32).is_finite() => Ok((Token::Number(value), length)),
        Ok(_) => Err(ParseError::new(at..at + length, "the number is too large", "at most 3.4e38")),
        Err(_) => Err(ParseError::new(at..at + length, "this is not a number", "digits are missing")),
    }
}
