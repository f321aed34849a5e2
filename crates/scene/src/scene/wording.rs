//! Wording of errors in scene files.
use std::ops::Range;

use toml::de::DeValue;

use super::{
    diagnostic::{SceneError, SourceText},
    renamed::RENAMED,
};
use noisefall_base::{
    declare::{Entry, Looks, Parameter, Word, nearest},
    quote,
};

/// Longest text of a file that a message quotes.
const LONGEST_FOUND: usize = 40;
/// Syntax errors of the TOML parser, by the start of their text, and our wording.
const SYNTAX: [(&str, &str); 12] = [
    ("extra `=`", "there is one `=` too many"),
    ("floating-point number overflowed", "the number is too large"),
    ("invalid basic string", "the text in quotes does not end"),
    ("invalid literal string", "the text in quotes does not end"),
    ("unexpected key or value, expected newline", "a value must end on its line, but more text follows"),
    ("missing comma between key-value pairs", "a `,` is missing between two keys"),
    ("missing comma between array elements", "a `,` is missing between two values"),
    ("extra comma", "there is one `,` too many"),
    ("key with no value", "this key has no value: write key = value"),
    ("missing assignment", "a `=` is missing between a key and its value"),
    ("invalid float", "this is not a number"),
    ("invalid integer", "this is not a number"),
];

/// A syntax error with its position.
pub fn in_plain_words(source: &SourceText, error: &toml::de::Error) -> SceneError {
    let span = error.span().unwrap_or(0..0);
    let message = error.message().replace('\n', ": ");
    if message == "duplicate key" {
        let key = text_at(source, &span);
        let error = source.error(span.clone(), format!("duplicate key `{key}`"), "this is the second time");
        return error.with_help("a key can be given only once; each object begins with its own `[[objects]]`");
    }
    if message.starts_with("string values must be quoted") && text_at(source, &span).trim().is_empty() {
        return source.error(span, "a value is missing", "after the `=`");
    }
    if message.starts_with("string values must be quoted") {
        let value = quote::piece(text_at(source, &span).trim());
        return source.error(span, format!("`{value}` is not a number; text must be in quotes"), "expected a value");
    }
    let words = SYNTAX.iter().find(|(theirs, _)| message.starts_with(theirs)).map(|(_, ours)| (*ours).to_owned());
    source.error(span, words.unwrap_or(message), "this cannot be understood")
}

/// The error for an unknown word, with its position.
pub fn unknown(source: &SourceText, span: Range<usize>, what: &str, word: &str, known: &[Entry]) -> SceneError {
    let keys = || known.iter().map(|entry| entry.parameter.key);
    if let Some(renamed) = RENAMED.iter().find(|renamed| renamed.former == word && keys().any(|key| key == renamed.now)) {
        let error = source.error(span, format!("`{word}` is now `{}`", renamed.now), format!("write `{}`", renamed.now));
        return error.with_help("`noisefall convert OLD.toml -o NEW.toml` rewrites a file, and keeps its comments");
    }
    let by_alias = known.iter().find(|entry| entry.parameter.is_alias(word)).map(|entry| entry.parameter);
    let meant = by_alias.map(|parameter| parameter.key).or_else(|| nearest(word, keys()));
    let label = match meant {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("there is no such {what} here"),
    };
    let mut listed: Vec<String> = Vec::new();
    for key in keys().map(|key| format!("`{key}`")) {
        if !listed.contains(&key) {
            listed.push(key);
        }
    }
    let one_of = if listed.len() > 1 { "expected one of" } else { "expected" };
    let help = format!("{one_of} {}", listed.join(", "));
    let help = match by_alias.map(|parameter| parameter.advice).filter(|advice| !advice.is_empty()) {
        Some(advice) => format!("{advice}; {help}"),
        None => help,
    };
    source.error(span, format!("unknown {what} `{word}`"), label).with_help(help)
}

/// A word as an expected value.
pub fn expected_word(word: &Word) -> Entry {
    Entry { parameter: Parameter::new(word.name, word.doc), looks: Looks::Text }
}

/// Advice for a value in place of a table, if the first value of that table has the same form.
pub fn suggestion(value: &DeValue, text: &str, known: &[Entry]) -> Option<String> {
    if text.chars().count() > LONGEST_FOUND {
        return None;
    }
    if let Some(name) = value.as_str()
        && known.iter().any(|entry| entry.parameter.key == name)
    {
        return Some(format!("{{ {name} = … }}"));
    }
    let fits = |entry: &&Entry| match value {
        DeValue::Integer(_) | DeValue::Float(_) => matches!(entry.looks, Looks::Number | Looks::Colour),
        DeValue::Array(_) => entry.looks == Looks::Colour,
        DeValue::String(_) => entry.looks == Looks::Text,
        _ => false,
    };
    let required = || known.iter().filter(|entry| entry.parameter.is_required);
    let first = if required().count() == 1 { required().next() } else { known.first() };
    first.filter(fits).map(|entry| format!("{{ {} = {text} }}", entry.parameter.key))
}

/// Description of a value, with its text if that is short.
pub fn found(value: &DeValue, text: &str) -> String {
    let is_short = text.chars().count() <= LONGEST_FOUND;
    match value {
        DeValue::String(_) if is_short => format!("the text {text}"),
        DeValue::Integer(_) | DeValue::Float(_) | DeValue::Boolean(_) if is_short => text.to_owned(),
        _ => kind_of(value).to_owned(),
    }
}

/// [`found`] for an item of a list, from its text.
pub fn found_text(text: &str) -> String {
    match text.chars().next() {
        Some('[') => "a list".to_owned(),
        Some('{') => "a table".to_owned(),
        Some('"' | '\'') if text.chars().count() <= LONGEST_FOUND => format!("the text {text}"),
        _ if text.chars().count() <= LONGEST_FOUND => text.to_owned(),
        _ => "something else".to_owned(),
    }
}

/// The type of a value.
fn kind_of(value: &DeValue) -> &'static str {
    match value {
        DeValue::String(_) => "text",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

/// The text of a span.
pub fn text_at<'a>(source: &'a SourceText, span: &Range<usize>) -> &'a str {
    source.text.get(span.clone()).unwrap_or_default()
}
