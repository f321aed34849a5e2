//! Faults: one small change each at one place of the source.
use std::{collections::HashMap, ops::Range};

/// How the place is rewritten so that a number switches the fault.
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
pub struct Fault {
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
    pub faulty: String,
    /// Tells faults of one function apart that read the same.
    pub repeat: usize,
}

/// Longer changes are shortened to where they differ.
const SHOWN: usize = 100;
/// This much of what is the same is shown before and after the difference.
const CONTEXT: usize = 24;

impl Fault {
    /// The folder below `src` that the file lies in.
    pub fn folder(&self) -> &str {
        self.file.rsplit_once('/').map_or("", |(folder, _)| folder)
    }

    /// The change as a reader sees it: `original → faulty`.
    pub fn change(&self) -> String {
        let [original, faulty] = [&self.original, &self.faulty].map(|text| on_one_line(text));
        if faulty.is_empty() {
            return format!("{} → (dropped)", shortened(&original, 0, original.chars().count()));
        }
        let [a, b]: [Vec<char>; 2] = [&original, &faulty].map(|text| text.chars().collect());
        let before = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
        let after = a[before..].iter().rev().zip(b[before..].iter().rev()).take_while(|(a, b)| a == b).count();
        let middle = |text: &str, length: usize| shortened(text, before, length - after);
        format!("{} → {}", middle(&original, a.len()), middle(&faulty, b.len()))
    }

    /// Names the fault in results that are kept, wherever its line moves.
    pub fn key(&self) -> String {
        let [original, faulty] = [&self.original, &self.faulty].map(|text| on_one_line(text));
        format!("{} {} #{}: {original} → {faulty}", self.file, self.function, self.repeat)
    }
}

/// Numbers faults that read the same, in the order of their places.
pub fn number_repeats(faults: &mut [Fault]) {
    let mut seen: HashMap<String, usize> = HashMap::new();
    for fault in faults {
        let count = seen.entry(fault.key()).or_default();
        fault.repeat = *count;
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

    pub fn fault(original: &str, faulty: &str) -> Fault {
        let [file, source, function, original, faulty] = ["src/a/b.rs", "the line", "f", original, faulty].map(str::to_owned);
        Fault { file, range: 0..1, line: 1, source, function, operator: "sign", form: Form::Value, original, faulty, repeat: 0 }
    }

    #[test]
    fn a_long_change_is_shown_where_it_differs() {
        let long = "a_long_name + ".repeat(20);
        let change = fault(&format!("{long} x * y + {long}"), &format!("{long} x / y + {long}")).change();
        assert!(change.contains("x * y") && change.contains("x / y"), "{change}");
        assert!(change.chars().count() < 130, "{change}");
        assert_eq!(fault("a  <\n b", "a <= b").change(), "a < b → a <= b");
        assert_eq!(fault("f(x);", "").change(), "f(x); → (dropped)");
    }

    #[test]
    fn faults_that_read_the_same_have_keys_of_their_own() {
        let mut faults = [fault("a", "b"), fault("a", "c"), fault("a", "b")];
        number_repeats(&mut faults);
        assert_eq!(faults.each_ref().map(|fault| fault.repeat), [0, 0, 1]);
        assert_ne!(faults[0].key(), faults[2].key());
    }
}
