//! Typing errors in a scene file, found in its text. The TOML parser only reports where it gave up, which may be many lines
//! later.
use std::ops::Range;

use super::diagnostic::{SceneError, SourceText};

/// Typing errors in a text.
pub struct Slips {
    pub errors: Vec<SceneError>,
    /// Brackets do not match, so later errors of the parser are misleading.
    pub unbalanced: bool,
}

/// Finds syntax of other languages, and unclosed brackets and quotes.
pub fn slips(source: &SourceText) -> Slips {
    let mut scanner = Scanner { source, open: Vec::new(), last: None, text: None, slips: Vec::new(), unbalanced: false };
    let mut start = 0;
    for line in source.text.split_inclusive('\n') {
        scanner.line(start, line);
        start += line.len();
    }
    scanner.leave_open();
    Slips { errors: scanner.slips, unbalanced: scanner.unbalanced }
}

struct Scanner<'s> {
    source: &'s SourceText,
    /// The open brackets and their positions.
    open: Vec<(usize, char)>,
    /// The last character that is neither a space nor in a comment.
    last: Option<char>,
    /// The quotes that end the current multi-line string.
    text: Option<&'static str>,
    slips: Vec<SceneError>,
    unbalanced: bool,
}

impl Scanner<'_> {
    fn line(&mut self, start: usize, line: &str) {
        let mut at = 0;
        if self.text.is_none() && self.begins_anew(start, line) {
            self.leave_open();
        }
        let mut has_parenthesis = false;
        while let Some(c) = line[at..].chars().next() {
            if let Some(end) = self.text {
                let Some(length) = line[at..].find(end) else { return };
                (self.text, at) = (None, at + length + end.len());
                continue;
            }
            let (here, next) = (start + at, at + c.len_utf8());
            at = match c {
                '#' => return,
                '"' | '\'' => match self.quoted(start, line, at) {
                    Some(end) => end,
                    None => return,
                },
                '[' | '{' => {
                    self.open.push((here, c));
                    next
                }
                ']' | '}' => {
                    self.close(here, c);
                    next
                }
                '(' if !has_parenthesis => {
                    has_parenthesis = true;
                    self.slip(here..here + 1, "a list stands in square brackets, not in parentheses", "write [ … ]");
                    next
                }
                ';' => {
                    let advice = if self.open.is_empty() { "leave it out: a value ends with its line" } else { "write `,`" };
                    self.slip(here..here + 1, "there is no `;` in a scene file", advice);
                    next
                }
                ':' if self.stands_for_equals(&line[next..]) => {
                    self.slip(here..here + 1, "a key and its value are joined by `=`, not by `:`", "write `=`");
                    next
                }
                '/' if line[next..].starts_with(['/', '*']) => {
                    self.slip(here..here + 2, "a comment begins with `#`", "write `#`");
                    return;
                }
                _ => next,
            };
            if !c.is_whitespace() {
                self.last = Some(c);
            }
        }
    }

    fn slip(&mut self, place: Range<usize>, message: impl Into<String>, label: impl Into<String>) {
        if self.slips.len() < SceneError::MOST {
            self.slips.push(self.source.error(place, message, label));
        }
    }

    /// Skips a quoted string; `None` if it continues past the line.
    fn quoted(&mut self, start: usize, line: &str, at: usize) -> Option<usize> {
        let (quote, long) = if line[at..].starts_with('"') { ("\"", "\"\"\"") } else { ("'", "'''") };
        if line[at..].starts_with(long) {
            self.text = Some(long);
            return Some(at + long.len());
        }
        let mut escaped = false;
        for (i, c) in line[at + 1..].char_indices() {
            if !escaped && c.to_string() == quote {
                return Some(at + 1 + i + 1);
            }
            escaped = !escaped && c == '\\' && quote == "\"";
        }
        let end = start + line.trim_end().len();
        self.slip(start + at..end, "the text in quotes does not end", format!("a closing {quote} is missing on this line"));
        None
    }

    fn close(&mut self, here: usize, closing: char) {
        match self.open.pop() {
            Some((_, opening)) if closing_of(opening) == closing => {}
            Some((at, opening)) => {
                self.unbalanced = true;
                let message = format!("`{opening}` is closed by `{closing}`");
                self.slip(at..at + 1, message, format!("a `{}` is missing for this", closing_of(opening)));
                // It may close the bracket around.
                while self.open.pop().is_some_and(|(_, outer)| closing_of(outer) != closing) {}
            }
            None => {
                self.unbalanced = true;
                self.slip(here..here + 1, format!("there is one `{closing}` too many"), "this closes nothing");
            }
        }
    }

    /// Reports all open brackets and quotes, and clears them.
    fn leave_open(&mut self) {
        let Some((at, opening)) = self.open.last().copied() else { return };
        let missing: Vec<String> = self.open.iter().rev().map(|(_, opening)| closing_of(*opening).to_string()).collect();
        let are = if missing.len() > 1 { "are" } else { "is" };
        self.unbalanced = true;
        self.slip(at..at + 1, format!("`{}` {are} missing", missing.join(" ")), format!("this `{opening}` is not closed"));
        self.open.clear();
    }

    /// Whether a line starts a table or has a key where the open brackets allow neither.
    fn begins_anew(&self, start: usize, line: &str) -> bool {
        let Some(&(at, opening)) = self.open.last() else { return false };
        let words = line.trim_start();
        if let Some(header) = words.strip_prefix('[') {
            let name = header.trim_start_matches('[').trim_start().split(']').next().unwrap_or_default().trim_end();
            return is_key(name) && !["true", "false", "inf", "nan"].contains(&name) && header.contains(']');
        }
        let Some((key, _)) = words.split_once('=').filter(|(key, _)| is_key(key.trim_end())) else { return false };
        // Multi-line inline tables are valid. They have a comma before each key except the first, and are indented.
        let indent = line.len() - line.trim_start().len();
        let line_of_bracket = &self.source.text[self.source.text[..at].rfind('\n').map_or(0, |end| end + 1)..start];
        let indent_of_bracket = line_of_bracket.len() - line_of_bracket.trim_start().len();
        let goes_on = matches!(self.last, Some(',' | '{')) || indent > indent_of_bracket;
        !key.is_empty() && (opening == '[' || !goes_on)
    }

    /// Whether a `:` before this text separates a key from a value. It also occurs in times.
    fn stands_for_equals(&self, behind: &str) -> bool {
        let is_digit = |c: char| c.is_ascii_digit();
        !(self.last.is_some_and(is_digit) && behind.starts_with(is_digit))
    }
}

fn closing_of(opening: char) -> char {
    if opening == '[' { ']' } else { '}' }
}

/// Whether this is an unquoted key, possibly dotted, that starts with a letter.
fn is_key(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.'))
}
