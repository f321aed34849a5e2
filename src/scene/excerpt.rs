//! The lines of a file around an error. Long ones are cut: a caret far to the right of a window is not seen.
use std::ops::Range;

use miette::{MietteError, MietteSpanContents, NamedSource, SourceCode, SourceSpan, SpanContents};

/// Longer lines are cut.
const LONGEST_LINE: usize = 200;
/// What is left of a line before an error.
const BEFORE: usize = 60;

/// A text with its long lines cut, and a place in it.
#[derive(Clone, Debug)]
pub struct Excerpt {
    name: String,
    text: NamedSource<String>,
    span: Range<usize>,
    /// The column in characters of the file, less that in bytes of the excerpt.
    shift: isize,
}

impl Excerpt {
    pub fn new(name: &str, text: &str, span: Range<usize>) -> Excerpt {
        let start = text[..span.start].rfind('\n').map_or(0, |at| at + 1);
        let column = text[start..span.start].chars().count();
        let excerpt = |text: String, line: usize, span: Range<usize>| Excerpt {
            name: name.to_owned(),
            shift: column as isize - (span.start - line) as isize,
            text: NamedSource::new(name, text),
            span,
        };
        if text.lines().all(|line| line.len() <= LONGEST_LINE) {
            return excerpt(text.to_owned(), start, span);
        }
        let end = text[start..].find('\n').map_or(text.len(), |at| start + at);
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

    /// Where the error lies in what is shown.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }
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
            shown.line(),
            shown.column().saturating_add_signed(self.shift),
            shown.line_count(),
        )))
    }
}
