//! Errors of scene files: what is wrong, where, and what was expected.
use std::{fmt, ops::Range, path::Path};

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};

use super::excerpt::Excerpt;
use crate::quote;

/// Why a scene file cannot be used. Displays as one line; [`SceneError::report`] adds the place with a caret.
#[derive(Debug, Clone)]
pub struct SceneError(Box<Details>);

#[derive(Debug, Clone)]
struct Details {
    message: String,
    label: String,
    help: Option<String>,
    place: Option<Place>,
}

#[derive(Debug, Clone)]
struct Place {
    /// Both from 1.
    line_column: (usize, usize),
    excerpt: Excerpt,
}

/// The text of a scene file and what it is called, for pointing into it.
#[derive(Debug, Clone)]
pub struct SourceText {
    pub name: String,
    pub text: String,
}

impl SceneError {
    /// An error about a file as a whole.
    pub fn of_file(path: &Path, message: impl Into<String>, help: impl Into<String>) -> SceneError {
        SceneError(Box::new(Details {
            message: format!("{}: {}", quote::path(path), quote::message(&message.into())),
            label: String::new(),
            help: Some(quote::message(&help.into())),
            place: None,
        }))
    }

    /// The same error with advice on what to do.
    pub fn with_help(mut self, help: impl Into<String>) -> SceneError {
        self.0.help = Some(quote::message(&help.into()));
        self
    }

    /// Line and column, both from 1, of the place in the file, when the error has one.
    pub fn line_column(&self) -> Option<(usize, usize)> {
        self.0.place.as_ref().map(|place| place.line_column)
    }

    /// The whole message, several lines of plain text: what, file:line:column, the line with a caret, what to do.
    pub fn report(&self) -> String {
        let mut text = String::new();
        let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_width(88);
        if handler.render_report(&mut text, self).is_err() {
            text = self.to_string();
        }
        text.trim_end().to_owned()
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.message)
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
            place: Some(Place { line_column: (line, column), excerpt }),
        }))
    }
}
