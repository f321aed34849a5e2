//! The names in expressions, and suggestions for unknown ones.
use std::ops::Range;

use super::parse_error::ParseError;

/// Functions and their numbers of arguments.
pub(super) const FUNCTIONS: [(&str, usize); 9] =
    [("sin", 1), ("cos", 1), ("tan", 1), ("exp", 1), ("log", 1), ("sqrt", 1), ("abs", 1), ("min", 2), ("max", 2)];
const VARIABLES: [&str; 4] = ["x", "y", "z", "pi"];

/// The error for an unknown name, with a suggestion.
pub(super) fn unknown(name: &str, at: Range<usize>) -> ParseError {
    let names = VARIABLES.into_iter().chain(FUNCTIONS.map(|(name, _)| name));
    let written = name.to_ascii_lowercase();
    // Of equally near ones the one that begins with the same letter.
    let begins_otherwise = |known: &str| known.chars().next() != written.chars().next();
    let near = names.map(|known| (distance(&written, known), begins_otherwise(known), known)).min();
    let label = match near {
        Some((distance, _, known)) if distance <= 2 && distance < written.len() => format!("did you mean {known}?"),
        _ => "known are x, y, z, pi, sin, cos, tan, exp, log, sqrt, abs, min and max".to_owned(),
    };
    ParseError::new(at, format!("\"{name}\" is not known"), label)
}

/// Levenshtein distance: the number of letters to insert, delete or change.
fn distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.chars().enumerate() {
            let changed = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[row.len() - 1]
}
