//! Quotes of foreign text in messages: shortened, and without control characters.
use std::{borrow::Cow, path::Path};

/// Maximum number of characters of a quoted piece.
const LONGEST_PIECE: usize = 60;
/// Maximum number of characters of a path; the last ones are kept, which say most.
const LONGEST_PATH: usize = 160;
/// Maximum number of characters of a message.
const LONGEST_MESSAGE: usize = 500;

/// The beginning of a text, on one line.
pub fn piece(text: &str) -> String {
    cut(text, LONGEST_PIECE)
}

/// `a, b or c`.
pub fn either(words: &[String]) -> String {
    match words.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        _ => words.concat(),
    }
}

/// The beginning of bytes that should be text, between backquotes.
pub fn bytes(piece: &[u8]) -> String {
    let start = &piece[..piece.len().min(4 * LONGEST_PIECE)];
    format!("`{}`", self::piece(&String::from_utf8_lossy(start)))
}

/// A path, or its end if it is long.
pub fn path(path: &Path) -> String {
    let text = path.to_string_lossy();
    let count = text.chars().count();
    if count <= LONGEST_PATH {
        return cut(&text, LONGEST_PATH);
    }
    let end: String = text.chars().skip(count - LONGEST_PATH).collect();
    format!("…{}", cut(&end, LONGEST_PATH))
}

/// Shortens the quoted pieces of a message, between backquotes or double quotes.
pub fn message(text: &str) -> String {
    let mut short = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(['`', '"']) {
        let (before, quoted) = rest.split_at(start);
        let mark = &quoted[..1];
        let Some(length) = quoted[1..].find(mark) else { break };
        short += &format!("{before}{mark}{}{mark}", piece(&quoted[1..=length]));
        rest = &quoted[length + 2..];
    }
    cut(&(short + rest), LONGEST_MESSAGE)
}

/// A whole text of several lines as it goes to a terminal. The escape sequences are also those of JSON, in which only strings have such
/// characters.
pub fn lines(text: &str) -> Cow<'_, str> {
    let is_kept = |c: char| !acts(c) || c == '\n' || c == '\t';
    if text.chars().all(is_kept) {
        return Cow::Borrowed(text);
    }
    let mut quoted = String::with_capacity(text.len());
    for c in text.chars() {
        match is_kept(c) {
            true => quoted.push(c),
            false => quoted += &format!("\\u{:04x}", u32::from(c)),
        }
    }
    Cow::Owned(quoted)
}

/// Truncates a text to a number of characters and marks the cut.
fn cut(text: &str, most: usize) -> String {
    let mut short: String = text.chars().take(most).map(printable).collect();
    if text.chars().nth(most).is_some() {
        short.push('…');
    }
    short
}

/// The character, or Rust's escape sequence if it is a control character.
fn printable(c: char) -> String {
    if acts(c) { c.escape_debug().to_string() } else { c.to_string() }
}

/// Whether a character is a control character, changes the text direction, or is invisible.
pub fn acts(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_cut_between_characters() {
        assert_eq!(piece("short"), "short");
        assert_eq!(piece(&"ü".repeat(60)), "ü".repeat(60));
        assert_eq!(piece(&"ü".repeat(61)), format!("{}…", "ü".repeat(60)));
        assert_eq!(bytes(b"Jos\xe9"), "`Jos\u{fffd}`");
        assert_eq!(bytes(&[b'x'; 100_000]), format!("`{}…`", "x".repeat(60)));
    }

    #[test]
    fn nothing_that_a_terminal_obeys_is_left() {
        assert_eq!(piece("a\x1b[31mb\r\n\u{9b}c\u{202e}d\u{feff}\0"), "a\\u{1b}[31mb\\r\\n\\u{9b}c\\u{202e}d\\u{feff}\\0");
        assert_eq!(piece("ordinary: ρ = ½, “é”, \\ and 🙂"), "ordinary: ρ = ½, “é”, \\ and 🙂");
        assert_eq!(path(Path::new("a\x07b.toml")), "a\\u{7}b.toml");
    }

    #[test]
    fn lines_keep_their_ends_and_json_stays_json() {
        assert_eq!(lines("two\n\tlines of “text”\n"), "two\n\tlines of “text”\n");
        assert_eq!(lines("a\x1b]0;b\x07\r\u{9b}31m\u{202e}"), "a\\u001b]0;b\\u0007\\u000d\\u009b31m\\u202e");
        let title = "a\u{9b}31m\u{202e}\u{feff}\x1b[0m";
        let json = serde_json::to_string(title).expect("it is a text");
        assert_ne!(lines(&json), json);
        assert_eq!(serde_json::from_str::<String>(&lines(&json)).expect("it is JSON"), title);
    }

    #[test]
    fn quoted_pieces_of_messages_are_cut_and_the_rest_is_kept() {
        let long = "y".repeat(5000);
        let expected = format!("there is no `{}…`, but \"{}…\"; end", "y".repeat(60), "y".repeat(60));
        assert_eq!(message(&format!("there is no `{long}`, but \"{long}\"; end")), expected);
        assert_eq!(message("expected one of `a`, `b` and `c`"), "expected one of `a`, `b` and `c`");
        assert_eq!(message("a ` alone"), "a ` alone");
        assert_eq!(message(&long), format!("{}…", "y".repeat(500)));
    }

    #[test]
    fn of_long_paths_the_end_is_shown() {
        let long = format!("{}/scene.toml", "x".repeat(300));
        let shown = path(Path::new(&long));
        assert!(shown.starts_with("…x") && shown.ends_with("x/scene.toml") && shown.chars().count() == 161);
        assert_eq!(shown, format!("…{}/scene.toml", "x".repeat(149)));
        assert_eq!(path(Path::new(&"y".repeat(160))), "y".repeat(160));
        assert_eq!(path(Path::new(&"y".repeat(161))), format!("…{}", "y".repeat(160)));
    }
}
