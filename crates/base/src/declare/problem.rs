//! Errors of values, with their paths.
use super::{path::Path, value::Family};
use crate::{progress::Cancelled, quote};

/// Something wrong in a description.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{path}: {message}")]
pub struct Problem {
    /// Its path, relative to the kind that reports it until the enclosing tables have [prefixed](Problem::within) theirs.
    pub path: Path,
    /// Description of the problem.
    pub message: String,
    /// The expected value.
    pub label: String,
    /// Advice; may be empty.
    pub help: String,
    /// Byte range within the text at `path`, if only a part of that text is wrong.
    pub part: Option<std::ops::Range<usize>>,
}

impl Problem {
    /// `at` as [`Path::of`] reads it.
    pub fn at(at: &str, message: impl Into<String>, label: impl Into<String>) -> Problem {
        Problem { path: Path::of(at), message: message.into(), label: label.into(), help: String::new(), part: None }
    }

    /// The end of a compile that was asked to stop.
    pub fn cancelled(cancelled: Cancelled) -> Problem {
        Problem::at("", cancelled.to_string(), "the scene was not opened")
    }

    /// The problem of an undefined name; `known` are the defined ones.
    pub fn not_defined<'k>(at: &str, family: Family, name: &str, known: impl Iterator<Item = &'k String>) -> Problem {
        /// More are not listed.
        const MOST: usize = 6;
        let kind = match family {
            Family::Texture => "texture",
            Family::Material => "material",
        };
        let known: Vec<_> = known.map(String::as_str).collect();
        let listed = known.iter().take(MOST).map(|name| format!("`{}`", quote::piece(name))).collect::<Vec<_>>().join(", ");
        let help = match known.len() {
            0 => format!("the scene defines no {kind}s"),
            1..=MOST => format!("the scene defines {listed}"),
            count => format!("the scene defines {listed} and {} more", count - MOST),
        };
        let meant = nearest(name, known.iter().copied());
        let label = meant.map_or_else(|| "not defined".to_owned(), |meant| format!("did you mean `{meant}`?"));
        Problem::at(at, format!("there is no {kind} `{name}`"), label).help(help)
    }

    /// Adds advice to the problem.
    #[must_use]
    pub fn help(self, help: impl Into<String>) -> Problem {
        Problem { help: help.into(), ..self }
    }

    /// Makes the path relative to an enclosing table.
    #[must_use]
    pub fn within(self, outer: &Path) -> Problem {
        Problem { path: outer.join(&self.path), ..self }
    }
}

/// A number as a person writes it: with a power of ten only if there are many zeros.
pub fn short(x: f64) -> String {
    if x == 0.0 || !x.is_finite() || (1e-4..1e6).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}

/// The candidate that `word` was probably meant to be.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    /// Longer words are not typing errors, and the comparison takes time in proportion to both lengths.
    const LONGEST: usize = 100;
    let length = word.chars().count();
    let most = (length / 3).max(1);
    let comparable = |candidate: &&'a str| length <= LONGEST && candidate.chars().count().abs_diff(length) <= most;
    let candidates = candidates.into_iter().filter(comparable);
    let distances = candidates.map(|candidate| (strsim::osa_distance(word, candidate), candidate));
    distances.filter(|(distance, _)| *distance <= most).min().map(|(_, candidate)| candidate)
}
