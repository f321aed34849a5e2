//! Mutants: one small change each at one place of the source.
use std::{collections::HashMap, ops::Range};

/// How the place is rewritten so that a number switches the mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// An expression whose value is used.
    Value,
    /// An expression that names a place in memory, which must stay that very place.
    Place,
    /// A statement.
    Statement,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Mutant {
    /// Relative to the package, with `/` on every system.
    pub file: String,
    /// Bytes of the file.
    pub range: Range<usize>,
    pub line: usize,
    /// The whole line, trimmed.
    pub source: String,
    pub function: String,
    pub operator: &'static str,
    pub form: Form,
    pub original: String,
    pub changed: String,
    /// Tells mutants of one function apart that read the same.
    pub repeat: usize,
}

/// Longer changes are shortened to where they differ.
const SHOWN: usize = 100;
/// This much of what is the same is shown before and after the difference.
const CONTEXT: usize = 24;

impl Mutant {
    /// The folder below `src` that the file lies in.
    pub fn folder(&self) -> &str {
        self.file.rsplit_once('/').map_or("", |(folder, _)| folder)
    }

    /// The change as a reader sees it: `original → changed`.
    pub fn change(&self) -> String {
        let [original, changed] = [&self.original, &self.changed].map(|text| on_one_line(text));
        if changed.is_empty() {
            return format!("{} → (dropped)", shortened(&original, 0, original.chars().count()));
        }
        let [a, b]: [Vec<char>; 2] = [&original, &changed].map(|text| text.chars().collect());
        let before = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
        let after = a[before..].iter().rev().zip(b[before..].iter().rev()).take_while(|(a, b)| a == b).count();
        let middle = |text: &str, length: usize| shortened(text, before, length - after);
        format!("{} → {}", middle(&original, a.len()), middle(&changed, b.len()))
    }

    /// Names the mutant in results that are kept, wherever its line moves.
    pub fn key(&self) -> String {
        let [original, changed] = [&self.original, &self.changed].map(|text| on_one_line(text));
        format!("{} {} #{}: {original} → {changed}", self.file, self.function, self.repeat)
    }
}

/// Numbers mutants that read the same, in the order of their places.
pub fn number_repeats(mutants: &mut [Mutant]) {
    let mut seen: HashMap<String, usize> = HashMap::new();
    for mutant in mutants {
        let count = seen.entry(mutant.key()).or_default();
        mutant.repeat = *count;
        *count += 1;
    }
}

fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The characters from `start` to `end` with some before and after them, or all if the text is short.
fn shortened(text: &str, start: usize, end: usize) -> String {
    let length = text.chars().count();
    if length <= SHOWN {
        return text.to_owned();
    }
    let (first, last) = (start.saturating_sub(CONTEXT), (end + CONTEXT).min(length).min(start + SHOWN));
    let middle: String = text.chars().skip(first).take(last - first).collect();
    format!("{}{middle}{}", if first > 0 { "…" } else { "" }, if last < length { "…" } else { "" })
}

#[cfg(test)]
mod tests {
    use super::*;

    pub fn mutant(original: &str, changed: &str) -> Mutant {
        let [file, source, function, original, changed] = ["src/a/b.rs", "the line", "f", original, changed].map(str::to_owned);
        Mutant { file, range: 0..1, line: 1, source, function, operator: "sign", form: Form::Value, original, changed, repeat: 0 }
    }

    #[test]
    fn a_long_change_is_shown_where_it_differs() {
        let long = "a_long_name + ".repeat(20);
        let change = mutant(&format!("{long} x * y + {long}"), &format!("{long} x / y + {long}")).change();
        assert!(change.contains("x * y") && change.contains("x / y"), "{change}");
        assert!(change.chars().count() < 130, "{change}");
        assert_eq!(mutant("a  <\n b", "a <= b").change(), "a < b → a <= b");
        assert_eq!(mutant("f(x);", "").change(), "f(x); → (dropped)");
    }

    #[test]
    fn faults_that_read_the_same_have_keys_of_their_own() {
        let mut mutants = [mutant("a", "b"), mutant("a", "c"), mutant("a", "b")];
        number_repeats(&mut mutants);
        assert_eq!(mutants.each_ref().map(|mutant| mutant.repeat), [0, 0, 1]);
        assert_ne!(mutants[0].key(), mutants[2].key());
    }
}
