//! XML that is safe to parse: no document types, no entities but those of XML itself, and sizes in proportion to the file.
use std::{io::Read, path::Path};

use roxmltree::{Document, ParsingOptions};

use noisefall_base::file::open_regular;
use noisefall_scene::scene::{SceneError, SourceText};

/// Larger files are rejected before they are read: large data belong in files of their own.
const LARGEST_FILE: u64 = 256 << 20;
/// Nodes of a small file, and bytes of a large file per further node. A node takes up to some 250 bytes.
const FEWEST_NODES: usize = 1_000_000;
const BYTES_PER_NODE: usize = 64;
/// Attributes of an element. A parser compares each with all others.
const MOST_ATTRIBUTES: usize = 1000;
/// Declarations of namespaces, which Mitsuba has none of. A parser hands them down to all elements within.
const MOST_NAMESPACES: usize = 16;

/// Reads a file as text.
pub fn read(path: &Path) -> Result<SourceText, SceneError> {
    let unreadable = |reason: String| SceneError::of_file(path, reason, "a scene of Mitsuba is an XML file");
    let file = open_regular(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => unreadable("there is no such file".to_owned()),
        _ => unreadable(format!("cannot be read: {error}")),
    })?;
    let mut bytes = Vec::new();
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(|error| unreadable(format!("cannot be read: {error}")))?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(unreadable(format!("the file is larger than {} MB", LARGEST_FILE >> 20)));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").map(<[u8]>::to_vec).unwrap_or(bytes);
    let text = String::from_utf8(bytes).map_err(|_| unreadable("the file is not UTF-8 text".to_owned()))?;
    Ok(SourceText { name: path.display().to_string(), text })
}

/// The text without the hyphens of its comments: Mitsuba reads comments with `--` in them, which XML forbids. All places stay.
pub fn plain(source: &SourceText) -> SourceText {
    let mut plain = source.clone();
    let mut at = 0;
    while let Some(start) = plain.text[at..].find("<!--").map(|start| at + start + 4) {
        let Some(end) = plain.text[start..].find("-->").map(|end| start + end) else { break };
        let comment = &plain.text[start..end];
        if comment.contains("--") || comment.ends_with('-') {
            plain.text.replace_range(start..end, &comment.replace('-', " "));
        }
        at = end + 3;
    }
    plain
}

/// Parses a text.
pub fn parse(source: &SourceText) -> Result<Document<'_>, SceneError> {
    let text = &source.text;
    if let Some(at) = crowded_element(text) {
        let message = format!("an element has more than {MOST_ATTRIBUTES} attributes");
        return Err(source.error(at..at + 1, message, "here"));
    }
    if let Some((at, _)) = text.match_indices("xmlns").nth(MOST_NAMESPACES) {
        return Err(source.error(at..at + 5, "the file declares too many namespaces", "Mitsuba's scenes have none"));
    }
    let nodes_limit = (FEWEST_NODES + text.len() / BYTES_PER_NODE).min(u32::MAX as usize) as u32;
    let options = ParsingOptions { allow_dtd: false, nodes_limit, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| {
        let position = error.pos();
        let line_start = text.split_inclusive('\n').take(position.row.saturating_sub(1) as usize).map(str::len).sum::<usize>();
        let in_line = text[line_start..].chars().take(position.col.saturating_sub(1) as usize).map(char::len_utf8).sum::<usize>();
        let at = line_start + in_line;
        let message = format!("this is not valid XML: {error}");
        source.error(at..at + 1, message, "here").with_help("entities and document types are not supported")
    })
}

/// Where an element with too many attributes begins.
fn crowded_element(text: &str) -> Option<usize> {
    let mut rest = 0;
    while let Some(start) = text[rest..].find('<').map(|at| rest + at) {
        let close = if text[start..].starts_with("<!--") { "-->" } else { "<" };
        let end = text[start + 1..].find(close).map_or(text.len(), |at| start + 1 + at);
        if close == "<" && text[start..end].bytes().filter(|byte| *byte == b'=').count() > MOST_ATTRIBUTES {
            return Some(start);
        }
        rest = end;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hyphens_of_comments_are_read_over() {
        let text = "<scene><!-- é -- a --- b - c ---><!----><x a=\"--\"/><!-- -- open";
        let source = SourceText { name: "a.xml".to_owned(), text: text.to_owned() };
        let plain = plain(&source).text;
        assert_eq!(plain, "<scene><!-- é    a     b   c  --><!----><x a=\"--\"/><!-- -- open");
        assert_eq!(plain.len(), text.len());
    }
}
