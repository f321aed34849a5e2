//! Writing and reading gives the same scene: for all that come with the program, and for random ones.
use std::{fs, path::Path as FilePath};

use rand::{SeedableRng, rngs::SmallRng};

use super::*;
use crate::edit::{content::Content, origin::Origins, tree::Answer, trial::write_and_read};
use noisefall_scene::scene::describe;

/// A validation under stress tries more.
const DRAWN: u64 = 1000;

/// The texts of all scenes that come with the program.
pub fn shipped() -> Vec<(String, String)> {
    let folder = FilePath::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let files = fs::read_dir(folder).expect("the folder can be read").map(|entry| entry.expect("an entry").path());
    let scenes = files.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    scenes.map(|path| (path.display().to_string(), fs::read_to_string(&path).expect("a scene is text"))).collect()
}

#[test]
fn scenes_that_come_with_the_program_stay_as_they_are() {
    let scenes = shipped();
    assert!(scenes.len() > 20);
    for (name, text) in &scenes {
        let mut document = Document::open(name, text).unwrap_or_else(|error| panic!("{}", error.report()));
        assert_eq!(document.text(), *text, "{name}");
        // Through the writer, too: a change and its opposite in the description, behind the back of the document.
        document.content.description.title.push('!');
        let changed = document.text();
        document.content.description.title.pop();
        let title = format!("title = \"{}", document.description().title);
        assert_eq!(changed, text.replacen(&title, &format!("{title}!"), 1), "{name}");
    }
}

#[test]
fn scenes_that_come_with_the_program_are_written_anew() {
    for (name, text) in shipped() {
        let description = describe(&name, text).unwrap_or_else(|error| panic!("{}", error.report()));
        let empty = SceneDescription::default();
        let bare = "format = 1\n[camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\nfov = 40\nresolution = [640, 480]\n";
        let origins = Origins::of(&empty);
        let content = Content { description, origins, ..Content::new(bare.to_owned(), empty) };
        let written = content.text();
        let again = describe(&name, written.clone()).unwrap_or_else(|error| panic!("{}\n{written}", error.report()));
        assert!(bits(&again).is_identical(&bits(&content.description)), "{name}:\n{written}");
    }
}

#[test]
fn random_scenes_are_written_into_each_other() {
    for seed in 0..DRAWN {
        write_and_read(&mut SmallRng::seed_from_u64(seed)).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
    }
}

#[test]
fn a_part_is_taken_down_and_put_back() {
    for seed in 0..200 {
        let mut random = SmallRng::seed_from_u64(seed);
        let [mut from, mut to] = [(); 2].map(|()| crate::edit::trial::drawn_scene(&mut random));
        let tree = Tree::of(&mut from);
        assert!(crate::edit::put::replace(&mut to, &Path::default(), &tree), "seed {seed}");
        assert!(bits(&to).is_identical(&bits(&from)) && to == from, "seed {seed}");
        // Taking down changes nothing.
        assert!(bits(&from).is_identical(&tree));
    }
}

/// Every answer in turn is replaced by one of another form.
#[test]
fn a_tree_with_an_answer_of_another_form_does_not_fit() {
    let from = crate::edit::trial::drawn_scene(&mut SmallRng::seed_from_u64(0));
    let tree = Tree::of(&mut from.clone());
    for (place, answer) in tree.0.iter().enumerate() {
        let mut other = tree.clone();
        other.0[place] = if matches!(answer, Answer::Names(_)) { Answer::Items(0) } else { Answer::Names(Vec::new()) };
        assert!(!crate::edit::put::replace(&mut from.clone(), &Path::default(), &other), "{place}: {answer:?}");
    }
}
