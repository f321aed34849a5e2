//! Names that are not too long for a file system.

/// Most bytes of a name on the file systems in use.
pub const LONGEST_NAME: usize = 255;

/// The longest beginning of a text that has at most so many bytes.
pub fn cut(text: &str, most: usize) -> &str {
    &text[..text.floor_char_boundary(most)]
}

/// A name of at most so many bytes: if it has more, its stem is cut, and a short extension is kept.
pub fn short_name(name: &str, most: usize) -> String {
    const LONGEST_EXTENSION: usize = 8;
    if name.len() <= most {
        return name.to_owned();
    }
    let end = name.rfind('.').filter(|at| (2..=LONGEST_EXTENSION).contains(&(name.len() - at)));
    let (stem, extension) = name.split_at(end.unwrap_or(name.len()));
    format!("{}{extension}", cut(stem, most.saturating_sub(extension.len())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_cut_by_bytes_and_between_characters() {
        for (name, most, short) in [
            ("room.png", 8, "room.png"),
            ("room.png", 7, "roo.png"),
            ("🙂🙂🙂.ply", 11, "🙂.ply"),
            ("🙂🙂🙂.ply", 12, "🙂🙂.ply"),
            ("a.long_extension", 6, "a.long"),
            ("üüü", 3, "ü"),
            ("room.", 4, "room"),
        ] {
            assert_eq!(short_name(name, most), short, "{name}");
        }
        assert_eq!(short_name(&format!("{}.png", "🙂".repeat(200)), LONGEST_NAME).len(), 252);
    }
}
