//! The text of an OBJ file: chunks, lines and words.
use std::borrow::Cow;

use memchr::memchr;

use super::super::{FilePosition, ModelFormatError};
use noisefall_base::progress::{Cancelled, Progress};

/// Bytes of a chunk, about.
const CHUNK: usize = 1 << 22;

/// Decodes the file. Comments and names may be in any superset of ASCII; bytes that are not UTF-8 are replaced. Zeros at the end, which
/// some programs write to fill a block, do not count.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, ModelFormatError> {
    let bytes = &bytes[..bytes.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1)];
    if let Some(at) = memchr(0, bytes) {
        let lines = bytes[..at].iter().filter(|byte| **byte == b'\n').count();
        return Err(FilePosition::Line(lines + 1).broken("this is not text in an encoding that extends ASCII"));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    Ok(str::from_utf8(bytes).map_or_else(|_| String::from_utf8_lossy(bytes), Cow::Borrowed))
}

/// The text in chunks of whole lines, which are read at the same time.
pub struct Chunks<'a> {
    pub list: Vec<&'a str>,
    /// End of a line. Some old files have only carriage returns.
    end: u8,
    progress: &'a Progress,
}

/// Why a chunk is not read.
pub enum ChunkError {
    /// An error in a line of the chunk, counted from 1.
    Line(usize, String),
    Cancelled(Cancelled),
}

impl From<Cancelled> for ChunkError {
    fn from(cancelled: Cancelled) -> ChunkError {
        ChunkError::Cancelled(cancelled)
    }
}

impl<'a> Chunks<'a> {
    pub fn new(text: &'a str, progress: &'a Progress) -> Chunks<'a> {
        Chunks::of(text, CHUNK, progress)
    }

    /// Chunks of at least `size` bytes, except for the last one.
    pub fn of(text: &'a str, size: usize, progress: &'a Progress) -> Chunks<'a> {
        let end = if text.contains('\n') { b'\n' } else { b'\r' };
        let (mut list, mut rest) = (Vec::new(), text);
        while !rest.is_empty() {
            let (chunk, after) = rest.split_at(boundary(rest.as_bytes(), size, end));
            list.push(chunk);
            rest = after;
        }
        Chunks { list, end, progress }
    }

    /// The lines of a chunk with their numbers in it, counted from 1. Fails if the reader is asked to stop.
    pub fn lines(&self, chunk: usize) -> Result<Lines<'a>, Cancelled> {
        self.progress.advance(self.list[chunk].len() as u64)?;
        Ok(Lines { rest: self.list[chunk], number: 1, end: self.end })
    }

    /// The results of all chunks, or the first error, by its line in the file.
    pub fn all<T>(&self, results: Vec<Result<T, ChunkError>>) -> Result<Vec<T>, ModelFormatError> {
        let located = |(chunk, result): (usize, Result<T, ChunkError>)| {
            result.map_err(|error| match error {
                ChunkError::Line(line, reason) => {
                    let lines = |chunk: &&str| chunk.bytes().filter(|byte| *byte == self.end).count();
                    let before: usize = self.list[..chunk].iter().map(lines).sum();
                    FilePosition::Line(before + line).broken(reason)
                }
                ChunkError::Cancelled(cancelled) => cancelled.into(),
            })
        };
        results.into_iter().enumerate().map(located).collect()
    }
}

/// The end of the first line at or after `size` that the next line does not continue.
fn boundary(bytes: &[u8], size: usize, end: u8) -> usize {
    let mut start = size.min(bytes.len());
    while let Some(length) = memchr(end, &bytes[start..]) {
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
    end: u8,
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a str);

    fn next(&mut self) -> Option<(usize, &'a str)> {
        let (text, first) = (self.rest.as_bytes(), self.number);
        let (mut end, mut is_continued) = (0, false);
        while end < text.len() {
            let start = end;
            end = memchr(self.end, &text[end..]).map_or(text.len(), |length| end + length + 1);
            self.number += 1;
            let last = text[start..end].iter().rev().find(|byte| !b"\r\n".contains(byte));
            // Empty lines do not end a continued one.
            is_continued = last.map_or(is_continued, |last| *last == b'\\');
            // Comments end in backslashes by chance, after the name of a directory.
            if text[0] == b'#' || !is_continued {
                break;
            }
        }
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest;
        (end > 0).then_some((first, line))
    }
}

/// The words of a line, up to its comment.
#[derive(Clone)]
pub struct Words<'a> {
    /// The text after the last word.
    pub rest: &'a str,
}

pub fn words(line: &str) -> Words<'_> {
    Words { rest: line }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a str;

    #[inline]
    fn next(&mut self) -> Option<&'a str> {
        loop {
            let bytes = self.rest.as_bytes();
            let start = bytes.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(bytes.len());
            // Almost all bytes fail the first test.
            let is_end = |byte: &u8| *byte <= b'#' && (byte.is_ascii_whitespace() || *byte == b'#');
            let length = bytes[start..].iter().position(is_end);
            let end = length.map_or(bytes.len(), |length| start + length);
            let word = &self.rest[start..end];
            let word = if word.ends_with('\\') { word.trim_end_matches('\\') } else { word };
            let is_last = bytes.get(end).is_none_or(|byte| *byte == b'#');
            self.rest = if is_last { "" } else { &self.rest[end..] };
            if !word.is_empty() || is_last {
                return Some(word).filter(|word| !word.is_empty());
            }
        }
    }
}

/// The text of a line after its first word, with spaces.
pub fn rest(line: &str) -> &str {
    let line = line.trim_ascii_start();
    let word = line.find(|c: char| c.is_ascii_whitespace()).unwrap_or(line.len());
    line[word..].trim()
}
