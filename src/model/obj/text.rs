//! The text of an OBJ file: chunks, lines and words.
use std::borrow::Cow;

use super::super::{ModelFormatError, Place};

/// Bytes of a chunk, about.
const CHUNK: usize = 1 << 22;

/// Decodes the file. Comments and names may be in any superset of ASCII; bytes that are not UTF-8 are replaced.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, ModelFormatError> {
    if let Some(at) = bytes.iter().position(|byte| *byte == 0) {
        let lines = bytes[..at].iter().filter(|byte| **byte == b'\n').count();
        return Err(Place::Line(lines + 1).broken("this is not text in an encoding that extends ASCII"));
    }
    Ok(String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)))
}

/// The text in chunks of whole lines, which are read at the same time.
pub struct Chunks<'a> {
    pub list: Vec<&'a str>,
    /// End of a line. Some old files have only carriage returns.
    end: char,
}

/// An error in a line of a chunk, counted from 1.
pub type LineError = (usize, String);

impl<'a> Chunks<'a> {
    pub fn new(text: &'a str) -> Chunks<'a> {
        Chunks::of(text, CHUNK)
    }

    /// Chunks of at least `size` bytes, except for the last one.
    pub fn of(text: &'a str, size: usize) -> Chunks<'a> {
        let end = if text.contains('\n') { '\n' } else { '\r' };
        let (mut list, mut rest) = (Vec::new(), text);
        while !rest.is_empty() {
            let (chunk, after) = rest.split_at(boundary(rest.as_bytes(), size, end as u8));
            list.push(chunk);
            rest = after;
        }
        Chunks { list, end }
    }

    /// The lines of a chunk with their numbers in it, counted from 1.
    pub fn lines(&self, chunk: usize) -> Lines<'a> {
        Lines { rest: self.list[chunk], number: 1, end: self.end }
    }

    /// The results of all chunks, or the first error, by its line in the file.
    pub fn all<T>(&self, results: Vec<Result<T, LineError>>) -> Result<Vec<T>, ModelFormatError> {
        let located = |(chunk, result): (usize, Result<T, LineError>)| {
            result.map_err(|(line, reason)| {
                let before: usize = self.list[..chunk].iter().map(|chunk| chunk.matches(self.end).count()).sum();
                Place::Line(before + line).broken(reason)
            })
        };
        results.into_iter().enumerate().map(located).collect()
    }
}

/// The end of the first line at or after `size` that the next line does not continue.
fn boundary(bytes: &[u8], size: usize, end: u8) -> usize {
    let mut start = size.min(bytes.len());
    while let Some(length) = bytes[start..].iter().position(|byte| *byte == end) {
        let line = &bytes[start..start + length];
        start += length + 1;
        // An empty line belongs to the one before it if that is continued.
        if line.iter().rev().find(|byte| !b"\r\n".contains(byte)).is_some_and(|byte| *byte != b'\\') {
            return start;
        }
    }
    bytes.len()
}

/// The lines with their numbers. A backslash at its end continues a line.
pub struct Lines<'a> {
    rest: &'a str,
    number: usize,
    end: char,
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a str);

    fn next(&mut self) -> Option<(usize, &'a str)> {
        let (text, first) = (self.rest, self.number);
        let (mut end, mut is_continued) = (0, false);
        while end < text.len() {
            let start = end;
            end = text[end..].find(self.end).map_or(text.len(), |length| end + length + 1);
            self.number += 1;
            let line = text[start..end].trim_end_matches(['\r', '\n']);
            // Empty lines do not end a continued one.
            is_continued = if line.is_empty() { is_continued } else { line.ends_with('\\') };
            // Comments end in backslashes by chance, after the name of a directory.
            if text.starts_with('#') || !is_continued {
                break;
            }
        }
        self.rest = &text[end..];
        (end > 0).then(|| (first, &text[..end]))
    }
}

/// Splits a line into words, up to its comment.
pub fn words(line: &str) -> impl Iterator<Item = &str> + Clone {
    let line = line.split('#').next().unwrap_or_default();
    line.split_ascii_whitespace().map(|word| word.trim_end_matches('\\')).filter(|word| !word.is_empty())
}

/// The text of a line after its first word, with spaces.
pub fn rest(line: &str) -> &str {
    let line = line.trim_ascii_start();
    let word = line.find(|c: char| c.is_ascii_whitespace()).unwrap_or(line.len());
    line[word..].trim()
}
