//! Positions of problems in the text of a scene file.
use std::ops::Range;

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::{
    diagnostic::{SceneError, SourceText},
    renamed,
};
use noisefall_base::declare::{Path, Problem, Step};

/// Turns problems into errors with positions in the text.
pub fn locate(problems: Vec<Problem>, source: &SourceText) -> Vec<SceneError> {
    // Parsing the text again takes less memory than keeping its tables while the scene is compiled.
    let table = DeTable::parse(&source.text).ok();
    let error = |problem: Problem| {
        let (found, value) = table.as_ref().map_or((0..1, None), |table| span_of(table, &problem.path));
        let place = problem.part.as_ref().and_then(|part| part_of(source, value, part)).unwrap_or(found);
        let error = source.error(place, problem.message, problem.label);
        if problem.help.is_empty() { error } else { error.with_help(problem.help) }
    };
    problems.into_iter().map(error).collect()
}

/// The byte range of a part of a string. If the string contains escapes, it is the range of the whole string.
fn part_of(source: &SourceText, value: Option<&Spanned<DeValue>>, part: &Range<usize>) -> Option<Range<usize>> {
    let value = value?;
    let text = value.get_ref().as_str()?;
    let start = value.span().start + 1;
    (source.text.get(start..start + text.len()) == Some(text)).then(|| start + part.start..start + part.end)
}

/// The byte range of the value at a path, or else of the innermost table on the path.
fn span_of<'t>(table: &'t Spanned<DeTable<'t>>, path: &Path) -> (Range<usize>, Option<&'t Spanned<DeValue<'t>>>) {
    let mut span = 0..1;
    let mut value: Option<&Spanned<DeValue>> = None;
    for (place, step) in path.0.iter().enumerate() {
        let here = value.map(Spanned::get_ref);
        let next = match (step, here) {
            (Step::Key(key), None) if place == 0 => renamed::value_of(table.get_ref(), key),
            (Step::Key(key), Some(DeValue::Table(table))) => table.get(key.as_str()),
            (Step::Item(index), Some(DeValue::Array(array))) => array.get(*index),
            _ => None,
        };
        let Some(next) = next else { return (span, None) };
        if !next.span().is_empty() {
            span = next.span();
        }
        value = Some(next);
    }
    (span, value)
}
