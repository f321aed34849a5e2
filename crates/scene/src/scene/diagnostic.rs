//! Errors of scene files: the problem, its position, and the expected value.
use std::{fmt, ops::Range, path::Path};

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};

use super::excerpt::Excerpt;
use noisefall_base::quote;

/// The errors of a scene file: the first one and those after it. Displays as one line; [`SceneError::report`] adds the places with a
/// caret each.
#[derive(Debug, Clone)]
pub struct SceneError(Box<Details>);

#[derive(Debug, Clone)]
struct Details {
    message: String,
    label: String,
    help: Option<String>,
    place: Option<Location>,
    /// The further errors of the file.
    others: Vec<SceneError>,
}

#[derive(Debug, Clone)]
struct Location {
    /// Both from 1.
    line_column: (usize, usize),
    excerpt: Excerpt,
}

/// The text of a scene file and its name, for errors that point into it.
#[derive(Debug, Clone)]
pub struct SourceText {
    pub name: String,
    pub text: String,
}

impl SceneError {
    /// Largest number of errors of a file that are found and shown. Each one costs a pass over the whole text.
    pub const MOST: usize = 40;

    /// An error about a file as a whole.
    pub fn of_file(path: &Path, message: impl Into<String>, help: impl Into<String>) -> SceneError {
        SceneError::without_place(format!("{}: {}", quote::path(path), quote::message(&message.into())), &help.into())
    }

    /// An error about a part of a scene without a file. The message names the part.
    pub fn of_part(message: &str, help: &str) -> SceneError {
        SceneError::without_place(quote::message(message), help)
    }

    fn without_place(message: String, help: &str) -> SceneError {
        SceneError(Box::new(Details {
            message,
            label: String::new(),
            help: Some(quote::message(help)),
            place: None,
            others: Vec::new(),
        }))
    }

    /// All errors of a file as one, in the order of their places and without repetition; `None` if there are none.
    pub fn of_all(mut errors: Vec<SceneError>) -> Option<SceneError> {
        errors.sort_by_key(SceneError::line_column);
        errors.dedup_by(|a, b| a.line_column() == b.line_column() && a.0.message == b.0.message);
        let mut errors = errors.into_iter();
        let mut first = errors.next()?;
        first.0.others.extend(errors);
        Some(first)
    }

    /// Number of errors.
    pub fn count(&self) -> usize {
        1 + self.0.others.len()
    }

    /// Adds advice to the error.
    pub fn with_help(mut self, help: impl Into<String>) -> SceneError {
        self.0.help = Some(quote::message(&help.into()));
        self
    }

    /// Line and column, both from 1, of the place of the first error in the file, when it has one.
    pub fn line_column(&self) -> Option<(usize, usize)> {
        self.0.place.as_ref().map(|place| place.line_column)
    }

    /// The whole message, several lines of plain text per error: the problem, file:line:column, the line with a caret, and advice.
    pub fn report(&self) -> String {
        let errors = std::iter::once(self).chain(&self.0.others);
        let mut reports: Vec<String> = errors.take(SceneError::MOST).map(SceneError::report_of_first).collect();
        if self.count() >= SceneError::MOST {
            reports.push(format!("These are the first {} errors; the file may have more errors.", SceneError::MOST));
        }
        reports.join("\n\n")
    }

    fn report_of_first(&self) -> String {
        let mut text = String::new();
        let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_width(88);
        let alone = SceneError(Box::new(Details { others: Vec::new(), ..(*self.0).clone() }));
        if handler.render_report(&mut text, &alone).is_err() {
            text = alone.to_string();
        }
        text.trim_end().to_owned()
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.count() {
            1 => f.write_str(&self.0.message),
            2 => write!(f, "{} (and another error)", self.0.message),
            count => write!(f, "{} (and {} more errors)", self.0.message, count - 1),
        }
    }
}

impl std::error::Error for SceneError {}

impl Diagnostic for SceneError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.0.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.0.place.as_ref().map(|place| &place.excerpt as &dyn SourceCode)
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.0.place.as_ref()?.excerpt.span();
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(Some(self.0.label.clone()), span))))
    }
}

impl SourceText {
    /// An error at a byte range of the text. `label` stands at the caret.
    pub fn error(&self, span: Range<usize>, message: impl Into<String>, label: impl Into<String>) -> SceneError {
        #[cfg(test)]
        LOOKS.set(LOOKS.get() + 1);
        let end = self.text.len();
        let start = self.text.floor_char_boundary(span.start.min(end));
        let before = &self.text[..start];
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        let excerpt = Excerpt::new(&self.name, &self.text, start..self.text.ceil_char_boundary(span.end.clamp(start, end)));
        SceneError(Box::new(Details {
            message: quote::message(&message.into()),
            label: quote::message(&label.into()),
            help: None,
            place: Some(Location { line_column: (line, column), excerpt }),
            others: Vec::new(),
        }))
    }
}

#[cfg(test)]
thread_local! {
    /// Number of errors of this thread that were located: each costs a pass over the whole text.
    static LOOKS: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::parse;

    const HEAD: &str = "format = 1\ncamera = { eye = [0, 0, 0], look_at = [0, 0, 1], fov = 60, resolution = [8, 8] }\n";

    /// How often the whole text is looked at until such a file, with a line or table thousands of times, is refused.
    fn looks(repeated: impl Fn(usize) -> String) -> usize {
        let text = HEAD.to_owned() + &(0..3000).map(repeated).collect::<String>();
        let before = LOOKS.get();
        let error = parse("test.toml", text).err().expect("it is wrong");
        assert!(error.count() <= 2 * SceneError::MOST, "{}", error.count());
        LOOKS.get() - before
    }

    #[test]
    fn a_file_of_thousands_of_errors_costs_as_much_as_one_of_forty() {
        let object = |body: &str| format!("[[objects]]\n{body}\n");
        let ball = "shape.sphere = { center = [0, 0, 0], radius = 1 }";
        let wrong: [(&str, &dyn Fn(usize) -> String); 9] = [
            ("values of the wrong type", &|_| object("shape.sphere = { center = [0, 0, 0], radius = 'x' }")),
            ("values out of range", &|_| object("shape.sphere = { center = [0, 0, 0], radius = -1 }")),
            ("unknown keys of tables", &|_| object("shape.sphere = { center = [0, 0, 0], radios = 1 }")),
            ("unknown keys of the file", &|i| format!("key_{i} = 1\n")),
            ("unknown types", &|i| format!("[materials.m{i}]\nlambert.albedo = 1\n")),
            ("missing keys", &|_| object("shape.sphere = {}")),
            ("values in place of tables", &|_| object("shape = 3")),
            ("names of nothing", &|i| object(&format!("{ball}\nmaterial = 'm{i}'"))),
            ("text that is not TOML", &|_| object("shape: 3;")),
        ];
        for (what, repeated) in wrong {
            let looks = looks(repeated);
            assert!(looks <= 5 * SceneError::MOST, "{what}: {looks}");
        }
    }
}
