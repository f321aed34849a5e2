//! Syntax errors of an expression.
use std::ops::Range;

/// A syntax error, with its position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParseError {
    /// The erroneous bytes of the text; empty and at the end if something is missing there.
    pub at: Range<usize>,
    /// The problem, and the text to write instead.
    pub message: String,
    /// Label at the position.
    pub label: String,
}

impl ParseError {
    pub(super) fn new(at: Range<usize>, message: impl Into<String>, label: impl Into<String>) -> ParseError {
        ParseError { at, message: message.into(), label: label.into() }
    }
}
