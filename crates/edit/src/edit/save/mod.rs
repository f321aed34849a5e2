//! Writes a scene into the text of its file. Changes only the values that differ, and keeps comments, order and number formats.
//!
//! | file | holds |
//! |---|---|
//! | `outline.rs` | the required and the optional content of a file for a description |
//! | `tables.rs`, `lists.rs`, `named.rs` | update a table, a list or a table of named tables in the file |
//! | `objects.rs` | the same for the objects, in any order |
//! | `values.rs` | values in the style of a person |
//! | `new_text.rs` | the text of a new file |
mod lists;
mod named;
mod new_text;
mod objects;
mod outline;
mod tables;
mod values;

use toml_edit::DocumentMut;

pub use self::new_text::new_text;
use self::{
    objects::spread,
    outline::Table,
    tables::{Level, Update},
};
use super::{content::Content, origin::Origins};
/// The text of a scene file.
pub fn text(content: &Content) -> String {
    let base = &content.base;
    let now = Table::of(&content.description);
    let was = Table::of(&base.description);
    if content.origins == Origins::of(&base.description) && now.is_identical(&was) {
        return base.text.clone();
    }
    // The text was read before: this cannot fail.
    let mut document: DocumentMut = base.text.parse().unwrap_or_default();
    spread(document.as_table_mut());
    Update { origins: &content.origins }.table(document.as_table_mut(), &was, &now, Level::Root);
    like(&base.text, document.to_string())
}

/// The text with the byte order mark and the line ends of another.
fn like(original: &str, text: String) -> String {
    const MARK: &str = "\u{feff}";
    let returns = original.matches("\r\n").count();
    let text = if returns > 0 && returns == original.matches('\n').count() {
        text.replace("\r\n", "\n").replace('\n', "\r\n")
    } else {
        text
    };
    if original.starts_with(MARK) && !text.starts_with(MARK) { format!("{MARK}{text}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::{like, new_text};
    use crate::edit::Document;
    use noisefall_scene::{
        scene::{
            BUILT_IN, describe,
            description::{EmissionDescription, SceneDescription},
        },
        shape::{Sphere, Transform},
    };

    #[test]
    fn a_new_text_has_the_content_and_few_lines() {
        let written = |description: &SceneDescription| {
            let text = new_text(description);
            let read = describe("new.toml", text.clone()).unwrap_or_else(|error| panic!("{}\n{text}", error.report()));
            assert_eq!(read, *description, "{text}");
            text
        };
        let text = written(Document::untitled(BUILT_IN).expect("it is a scene").description());
        assert!(text.starts_with("format = 1") && text.lines().count() < 2 * BUILT_IN.lines().count(), "{text}");
        let mut description = SceneDescription::default();
        for name in ["a \"quoted\" name", "ü\n", "a.b"] {
            let ball = description.add_object(name, Sphere { radius: 0.1 + 0.2, ..Sphere::default() });
            ball.emission = Some(EmissionDescription::radiance([1.0 / 3.0, 1e-9, 1e9]));
            ball.transform = vec![Transform::Matrix([
                [1.0, -0.0, 0.1, 5e-7],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
                [0.0, 0.0, 0.0, 1.0],
            ])];
        }
        written(&description);
    }

    #[test]
    fn only_a_text_whose_lines_all_end_as_on_windows_gives_others_its_ends() {
        let ends = |original: &str| like(original, "a = 1\nb = 2\n".to_owned());
        assert_eq!(ends("a = 1\r\nc = 3\r\n"), "a = 1\r\nb = 2\r\n");
        for original in ["a = 1\r\nc = 3\n", "a = 1\nc = 3\n", "a = 1"] {
            assert_eq!(ends(original), "a = 1\nb = 2\n", "{original:?}");
        }
    }
}
