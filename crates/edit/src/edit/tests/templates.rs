//! Scenes to start from.
use super::*;
use crate::edit::TEMPLATES;
use noisefall_scene::scene::parse;

#[test]
fn templates_compile_without_warnings() {
    for template in TEMPLATES {
        let scene = parse(template.title, template.text.to_owned()).unwrap_or_else(|error| panic!("{}", error.report()));
        assert_eq!(scene.warnings(), Vec::<String>::new(), "{}", template.title);
        assert_eq!(scene.title, template.title);
        let document = Document::untitled(template.text).unwrap_or_else(|error| panic!("{}", error.report()));
        assert_eq!((document.has_changes(), document.path()), (false, None));
    }
}
