//! The lines of a file around an error. Long lines are shortened, because a caret beyond the edge of the terminal would be
//! invisible.
use std::{ops::Range, path::Path};

use miette::{MietteError, MietteSpanContents, NamedSource, SourceCode, SourceSpan, SpanContents};

use noisefall_base::quote;

/// Longest line that is shown whole.
const LONGEST_LINE: usize = 200;
/// Number of characters of a shortened line before an error.
const BEFORE: usize = 60;
/// Number of lines before and after an error.
const AROUND: usize = 2;
/// An error over more lines is marked in its first line only.
const MOST_LINES: usize = 4;

/// The lines around a position in a text, with long lines shortened.
#[derive(Clone, Debug)]
pub struct Excerpt {
    name: String,
    text: NamedSource<String>,
    span: Range<usize>,
    /// The column in characters of the file minus the column in bytes of the excerpt.
    shift: isize,
    /// Number of lines of the file before the excerpt.
    lines_before: usize,
}

impl Excerpt {
    pub fn new(name: &str, text: &str, span: Range<usize>) -> Excerpt {
        let (window, span) = around(text, span);
        let lines_before = text[..window.start].matches('\n').count();
        let span = span.start - window.start..span.end - window.start;
        Excerpt { lines_before, ..Excerpt::of_lines(name, &printable(&text[window]), span) }
    }

    fn of_lines(name: &str, text: &str, span: Range<usize>) -> Excerpt {
        let name = quote::path(Path::new(name));
        let start = start_of_line(text, span.start);
        let column = text[start..span.start].chars().count();
        let excerpt = |text: String, line: usize, span: Range<usize>| Excerpt {
            name: name.clone(),
            shift: column as isize - (span.start - line) as isize,
            text: NamedSource::new(&name, text),
            span,
            lines_before: 0,
        };
        if text.lines().all(|line| line.len() <= LONGEST_LINE) {
            return excerpt(text.to_owned(), start, span);
        }
        let end = end_of_line(text, start);
        let line: Vec<char> = text[start..end].chars().collect();
        let from = if line.len() <= LONGEST_LINE { 0 } else { column.saturating_sub(BEFORE) };
        let to = line.len().min(from + LONGEST_LINE);

        let mut short = text[..start].split_inclusive('\n').map(shorten).collect::<String>();
        let short_start = short.len();
        if from > 0 {
            short.push('…');
        }
        short.extend(&line[from..column.min(to)]);
        let mark = short.len();
        let length = text.get(span.start..span.end.min(end)).map_or(1, |marked| marked.chars().count());
        short.extend(&line[column.min(to)..(column + length).min(to)]);
        let marked = mark..short.len();
        short.extend(&line[(column + length).min(to)..to]);
        if to < line.len() {
            short.push('…');
        }
        short.extend(text[end..].split_inclusive('\n').map(shorten));
        excerpt(short, short_start, marked)
    }

    /// Byte range of the error in the excerpt.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }
}

/// The lines around a byte range, and the part of the range to mark.
fn around(text: &str, span: Range<usize>) -> (Range<usize>, Range<usize>) {
    let line = start_of_line(text, span.start);
    let many = text.get(span.clone()).is_some_and(|marked| marked.matches('\n').nth(MOST_LINES - 1).is_some());
    let marked = span.start..if many { end_of_line(text, span.start) } else { span.end };
    let before = (0..AROUND).fold(line, |start, _| start_of_line(text, start.saturating_sub(1)));
    let end = end_of_line(text, marked.end);
    let after = (0..AROUND).fold(end, |end, _| end_of_line(text, text.len().min(end + 1)));
    (before..after, marked)
}

fn start_of_line(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |at| at + 1)
}

fn end_of_line(text: &str, at: usize) -> usize {
    text[at..].find('\n').map_or(text.len(), |length| at + length)
}

/// Replaces control characters of a text by characters of the same number of bytes, which keeps all positions.
fn printable(text: &str) -> String {
    let replaced = |c: char| match c {
        '\n' | '\t' => c,
        _ if !quote::acts(c) => c,
        _ => match c.len_utf8() {
            1 => ' ',
            2 => '¿',
            _ => '\u{fffd}',
        },
    };
    text.chars().map(replaced).collect()
}

fn shorten(line: &str) -> String {
    match line.char_indices().nth(LONGEST_LINE) {
        Some((at, _)) if line.trim_end().len() > at => {
            format!("{}…{}", &line[..at], if line.ends_with('\n') { "\n" } else { "" })
        }
        _ => line.to_owned(),
    }
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let shown = self.text.inner().read_span(span, before, after)?;
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            shown.data(),
            *shown.span(),
            shown.line() + self.lines_before,
            shown.column().saturating_add_signed(self.shift),
            shown.line_count(),
        )))
    }
}
