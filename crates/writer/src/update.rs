//! The text of a file that is updated.
use noisefall_scene::scene::description::SceneDescription;
use toml_edit::DocumentMut;

use super::{
    objects::spread,
    origin::Origins,
    outline::Table,
    tables::{Level, Update},
};

/// The text of a file that described `was`, changed so that it describes `now`. `origins` are the parts of the file from which those of `now`
/// come.
pub fn updated(text: &str, was: &SceneDescription, now: &SceneDescription, origins: &Origins) -> String {
    let (new, old) = (Table::of(now), Table::of(was));
    if *origins == Origins::of(was) && new.is_identical(&old) {
        return text.to_owned();
    }
    // The text was read before: this cannot fail.
    let mut document: DocumentMut = text.parse().unwrap_or_default();
    spread(document.as_table_mut());
    Update { origins }.table(document.as_table_mut(), &old, &new, Level::Root);
    like(text, document.to_string())
}

/// The text with the byte order mark and the line ends of another.
pub(super) fn like(original: &str, text: String) -> String {
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
    use super::like;
    use crate::new_text;
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
        let text = written(&describe("untitled.toml", BUILT_IN.to_owned()).expect("it is a scene"));
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
