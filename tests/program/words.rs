//! One name for one thing: words that have a better one do not come back in pages, messages and public names.
use std::{fs, path::Path};

use super::declared::root;

/// Words, the words in their place, and whether public names avoid them too.
const REPLACED: [(&str, &str, bool); 17] = [
    ("lamp", "light", true),
    ("truth", "reference", true),
    ("picture", "image", false),
    ("both ends", "bidirectional", true),
    ("bright sample", "outlier", true),
    ("sharing", "path reuse", true),
    ("shared path", "path reuse", true),
    ("paths from light", "light paths", true),
    ("forward tracing", "light tracing", true),
    ("path sampling", "BSDF sampling", true),
    ("noise figure", "estimated error", true),
    ("relative noise", "estimated error", false),
    ("kept render", "checkpoint", true),
    ("save progress", "save checkpoint", true),
    ("planted", "mutant", true),
    ("gate", "CI", false),
    ("start over", "restart", false),
];
/// Beginnings of comments that say nothing.
const BEGINNINGS: [&str; 3] = ["What ", "That of ", "The same"];
/// The tables of former names, and this file.
const EXCEPT: [&str; 5] = ["renamed.rs", "former_names.rs", "words.rs", "meant.rs", "compatibility.md"];

/// Lower-case words between spaces. Names with underscores stay whole: they are those of files and keys.
fn spaced(text: &str) -> String {
    let words: Vec<String> =
        text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty()).map(str::to_lowercase).collect();
    format!(" {} ", words.join(" "))
}

/// A name of Rust in words.
fn in_words(name: &str) -> String {
    let mut words = String::new();
    for c in name.chars() {
        if c.is_uppercase() {
            words.push(' ');
        }
        words.push(if c == '_' { ' ' } else { c });
    }
    words
}

fn complain(file: &Path, text: &str, is_name: bool, complaints: &mut Vec<String>) {
    let spaced = spaced(text);
    for (word, instead, names_too) in REPLACED {
        let has = spaced.contains(&format!(" {word} ")) || spaced.contains(&format!(" {word}s "));
        if has && (names_too || !is_name) {
            let excerpt: String = text.trim().chars().take(100).collect();
            complaints.push(format!("{}: `{word}` is {instead}: {excerpt}", file.display()));
        }
    }
}

/// The strings of a line, without names of values in braces and without those in its comment.
fn strings(line: &str) -> impl Iterator<Item = String> {
    let code = line.split("//").next().unwrap_or_default();
    let without_values =
        |string: &str| string.split('{').map(|part| part.split_once('}').map_or(part, |(_, rest)| rest)).collect();
    code.split('"').skip(1).step_by(2).map(without_values)
}

fn public_name(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix("pub ")?;
    let kinds = ["struct ", "enum ", "trait ", "fn ", "const fn ", "const ", "mod ", "type ", "static "];
    let rest = kinds.iter().find_map(|kind| rest.strip_prefix(kind))?;
    rest.split(|c: char| !c.is_alphanumeric() && c != '_').next()
}

fn check_source(file: &Path, text: &str, complaints: &mut Vec<String>) {
    let is_test = file.components().any(|part| part.as_os_str() == "tests") || file.ends_with("tests.rs");
    let code = if is_test { "" } else { text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default() };
    for line in code.lines().filter(|line| !line.trim_start().starts_with("//")) {
        strings(line).for_each(|string| complain(file, &string, false, complaints));
        if let Some(name) = public_name(line) {
            complain(file, &in_words(name), true, complaints);
        }
    }
    let mut in_comment = false;
    for line in text.lines().map(str::trim_start) {
        let comment = line.trim_start_matches(['/', '!']).trim_start();
        let begins = line.starts_with("//") && !in_comment && BEGINNINGS.iter().any(|word| comment.starts_with(word));
        in_comment = line.starts_with("//");
        if begins || line.starts_with("fn what_") || line.starts_with("fn ") && line.contains("_what_") {
            complaints.push(format!("{}: begin with the thing itself: {line}", file.display()));
        }
    }
}

fn visit(path: &Path, complaints: &mut Vec<String>) {
    if path.is_dir() {
        let mut inside: Vec<_> = fs::read_dir(path).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
        inside.sort();
        inside.iter().filter(|path| !path.is_symlink()).for_each(|path| visit(path, complaints));
        return;
    }
    if EXCEPT.iter().any(|name| path.ends_with(name)) {
        return;
    }
    let extension = path.extension().and_then(|extension| extension.to_str());
    let text = || fs::read_to_string(path).expect("text");
    match extension {
        Some("md") => text().lines().for_each(|line| complain(path, line, false, complaints)),
        Some("rs") => check_source(path, &text(), complaints),
        _ => {}
    }
}

#[test]
fn words_with_a_better_one_do_not_come_back() {
    let mut complaints = Vec::new();
    for part in
        ["src", "crates", "tests", "docs", "mutation/README.md", "mutation/src", "README.md", "CONTRIBUTING.md", "CHANGELOG.md"]
    {
        visit(&root().join(part), &mut complaints);
    }
    assert!(complaints.is_empty(), "{} complaints:\n{}", complaints.len(), complaints.join("\n"));
}

#[test]
fn words_are_found_in_sentences_strings_and_names() {
    let found = |text: &str| {
        let mut complaints = Vec::new();
        check_source(Path::new("a.rs"), text, &mut complaints);
        complaints.len()
    };
    assert_eq!(found("let a = \"two lamps\";\npub fn of_lamp() {}\npub struct PathSharing;\n/// What it is.\nfn x() {}\n"), 4);
    assert_eq!(found("let a = \"tiny_lamp\"; // a lamp\npub struct Picture;\n/// Clamps what it is given.\nfn what() {}\n"), 0);
}
