//! What the TOML reader says, in the words of this program: serde speaks of maps, sequences, structs and variants.
use std::ops::Range;

use super::{
    diagnostic::{SceneError, SourceText},
    meant::{remark, synonym, table_around},
};

/// Longer texts of a file are not repeated in a message.
const LONGEST_FOUND: usize = 40;
/// What the reader says of wrong TOML, by its beginning, and how we say it.
const SYNTAX: [(&str, &str); 13] = [
    ("string values must be quoted", "text must stand in quotes"),
    ("extra `=`", "there is one `=` too many"),
    ("floating-point number overflowed", "the number is too large"),
    ("invalid basic string", "the text in quotes does not end"),
    ("invalid literal string", "the text in quotes does not end"),
    ("unexpected key or value, expected newline", "a value ends with its line: there is something behind it"),
    ("missing comma between key-value pairs", "a `,` is missing between two keys"),
    ("missing comma between array elements", "a `,` is missing between two values"),
    ("extra comma", "there is one `,` too many"),
    ("key with no value", "this key has no value: write key = value"),
    ("missing assignment", "a `=` is missing between a key and its value"),
    ("invalid float", "this is not a number"),
    ("invalid integer", "this is not a number"),
];

/// The error of a text that is not a scene, at its place.
pub fn in_plain_words(source: &SourceText, error: &toml::de::Error) -> SceneError {
    let span = error.span().unwrap_or(0..0);
    let message = error.message().replace('\n', ": ");
    missing(source, &span, &message)
        .or_else(|| unknown(source, &span, &message))
        .or_else(|| wrong_kind(source, &span, &message))
        .or_else(|| wrong_form(source, &span, &message))
        .unwrap_or_else(|| {
            let words = SYNTAX.iter().find(|(theirs, _)| message.starts_with(theirs)).map(|(_, ours)| (*ours).to_owned());
            source.error(span, words.unwrap_or(message), "this cannot be understood")
        })
}

/// The candidate that `word` was probably meant to be.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    /// Nobody mistypes longer words, and comparing them takes as long as both are.
    const LONGEST: usize = 100;
    let length = word.chars().count();
    let most = (length / 3).max(1);
    let comparable = |candidate: &&'a str| length <= LONGEST && candidate.chars().count().abs_diff(length) <= most;
    let candidates = candidates.into_iter().filter(comparable);
    let distances = candidates.map(|candidate| (strsim::osa_distance(word, candidate), candidate));
    distances.filter(|(distance, _)| *distance <= most).min().map(|(_, candidate)| candidate)
}

fn missing(source: &SourceText, span: &Range<usize>, message: &str) -> Option<SceneError> {
    let key = message.strip_prefix("missing field `")?.strip_suffix('`')?;
    let says_nothing = source.text.lines().map(str::trim).all(|line| line.is_empty() || line.starts_with('#'));
    if says_nothing {
        return Some(source.error(0..0, "the file is empty; a scene begins with `format = 1`", "nothing is said"));
    }
    let given = if key == "format" { "format = 1" } else { key };
    Some(source.error(span.clone(), format!("missing key `{key}`"), format!("`{given}` must be given here")))
}

fn unknown(source: &SourceText, span: &Range<usize>, message: &str) -> Option<SceneError> {
    let (what, rest) = if let Some(rest) = message.strip_prefix("unknown field `") {
        ("key", rest)
    } else if let Some(rest) = message.strip_prefix("unknown variant `") {
        (if text_at(source, span).starts_with(['"', '\'']) { "value" } else { "kind" }, rest)
    } else {
        let (word, known) = message.strip_prefix("unexpected keys in table: ")?.split_once(", available keys: ")?;
        return Some(unknown_word(source, span, "key", word, &known.split(", ").collect::<Vec<_>>()));
    };
    let (word, expected) = rest.split_once("`, ")?;
    // What is expected stands between backquotes: every second piece.
    let known: Vec<&str> = expected.split('`').skip(1).step_by(2).collect();
    Some(unknown_word(source, span, what, word, &known))
}

fn unknown_word(source: &SourceText, span: &Range<usize>, what: &str, word: &str, known: &[&str]) -> SceneError {
    let meant = synonym(word, known).or_else(|| nearest(word, known.iter().copied()));
    let label = match meant {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("there is no such {what} here"),
    };
    let list = known.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ");
    let help = if known.len() > 1 { format!("expected one of {list}") } else { format!("expected {list}") };
    let help = match meant.and_then(|meant| remark(word, meant)) {
        Some(remark) => format!("{remark}; {help}"),
        None => help,
    };
    source.error(span.clone(), format!("unknown {what} `{word}`"), label).with_help(help)
}

/// A value of another type than the key has.
fn wrong_kind(source: &SourceText, span: &Range<usize>, message: &str) -> Option<SceneError> {
    let (found, expected) = match message.split_once(", expected ")? {
        (found, "struct variant" | "newtype variant") if found.contains("unit variant") => {
            let name = text_at(source, span).trim_matches(['"', '\'']);
            return Some(source.error(span.clone(), format!("`{name}` needs a value"), format!("write {{ {name} = … }}")));
        }
        (found, expected) => (found, plain_expected(expected)),
    };
    let found = if let Some(length) = found.strip_prefix("invalid length ") {
        format!("{length} values")
    } else {
        let found = found.strip_prefix("invalid type: ").or_else(|| found.strip_prefix("invalid value: "))?;
        plain_found(found, text_at(source, span))
    };
    let key = key_before(source, span.start);
    let place = key.map_or_else(String::new, |key| format!("`{key}`: "));
    let message = format!("{place}expected {expected}, found {found}");
    let text = text_at(source, span);
    let meant = match key {
        _ if text.chars().count() > LONGEST_FOUND => None,
        // Where colours may be textures.
        Some(key) if key != "radiance" && expected.starts_with("a colour") && text.starts_with(['"', '\'']) => {
            Some(format!("{{ texture = {text} }}"))
        }
        Some(key) => table_around(key, text),
        None => None,
    };
    let label = meant.map_or_else(|| format!("expected {expected}"), |meant| format!("write {meant}"));
    let error = source.error(span.clone(), message, label);
    Some(match advice(key, &found, text) {
        Some(help) => error.with_help(help),
        None => error,
    })
}

/// The error of a list where the table of this key belongs.
pub fn expected_table(source: &SourceText, key: &str, span: &Range<usize>) -> SceneError {
    let text = text_at(source, span);
    let meant = table_around(key, text).filter(|_| text.chars().count() <= LONGEST_FOUND);
    let label = meant.map_or_else(|| "expected a table { … }".to_owned(), |meant| format!("write {meant}"));
    source.error(span.clone(), format!("`{key}`: expected a table {{ … }}, found a list"), label)
}

/// What is said of the likeliest mistakes.
fn advice(key: Option<&str>, found: &str, text: &str) -> Option<String> {
    match key {
        Some("max_bounces") => Some("leave it out for no cap".to_owned()),
        None if found == "a table" && text.starts_with('[') => {
            Some(format!("each of several has its own table: write `[{text}]`"))
        }
        _ => None,
    }
}

/// A table or a name where the other was expected, or a table of too many kinds.
fn wrong_form(source: &SourceText, span: &Range<usize>, message: &str) -> Option<SceneError> {
    let error = |message: &str, label: &str| Some(source.error(span.clone(), message, label));
    match message {
        "duplicate key" => {
            let key = text_at(source, span);
            let error = source.error(span.clone(), format!("duplicate key `{key}`"), "this is the second time");
            Some(error.with_help("a key can be given once; of several objects each begins with `[[objects]]`"))
        }
        "wanted string or table" => error("expected a name in quotes, or a table { … }", "neither of them"),
        _ if message.starts_with("a second kind") => error(message, "remove one of them"),
        _ if message.starts_with("wanted exactly 1 element") => {
            error("expected a table that says exactly one kind", "one of the kinds must be given here")
        }
        _ if message.starts_with("string values must be quoted") && text_at(source, span).trim().is_empty() => {
            error("a value is missing", "after the `=`")
        }
        _ => None,
    }
}

fn plain_expected(expected: &str) -> &str {
    match expected {
        "u32" | "u64" => "a whole number, 0 or more",
        "i64" => "a whole number",
        "f32" | "f64" => "a number",
        "a string" => "text in quotes",
        "a boolean" => "true or false",
        "a sequence" => "a list [ … ]",
        "enum" => "a table { … } that says one kind",
        "a map" => "a table { … }",
        _ if expected.starts_with("struct ") => "a table { … }",
        _ => expected,
    }
}

/// `found` is serde's word for the value, `text` how the file writes it.
fn plain_found(found: &str, text: &str) -> String {
    match found.split_once(' ').map_or(found, |(kind, _)| kind) {
        "string" if text.chars().count() > LONGEST_FOUND => "text".to_owned(),
        "string" => format!("the text {text}"),
        "map" if text.starts_with(|c: char| c.is_ascii_digit()) => "a date".to_owned(),
        "map" => "a table".to_owned(),
        "sequence" => "a list".to_owned(),
        _ if text.chars().count() <= LONGEST_FOUND => text.to_owned(),
        _ => "something else".to_owned(),
    }
}

/// The text of a span.
fn text_at<'a>(source: &'a SourceText, span: &Range<usize>) -> &'a str {
    source.text.get(span.clone()).unwrap_or_default()
}

/// The key whose value begins at `start`.
fn key_before(source: &SourceText, start: usize) -> Option<&str> {
    let before = source.text.get(..start)?.trim_end().strip_suffix('=')?.trim_end();
    let is_key = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    let key = &before[before.trim_end_matches(is_key).len()..];
    (!key.is_empty()).then_some(key)
}
