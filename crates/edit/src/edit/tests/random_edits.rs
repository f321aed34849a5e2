//! Random sequences of edits: undo and redo give the very same description, and what is saved reads as it.
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{random::drawn_edit, *};
use crate::edit::{Gesture, History, Version, trial::drawn_scene};
use noisefall_base::declare::write;
use noisefall_scene::scene::{BUILT_IN, describe};

const EDITS: usize = 150;

/// A document with what was known of it at every version.
struct Known {
    document: Document,
    history: History,
    gesture: Gesture,
    versions: std::collections::HashMap<Version, Tree>,
    done: usize,
    refused: usize,
}

impl Known {
    fn of(document: Document) -> Known {
        let first = (document.version(), bits(document.description()));
        let mut history = History::default();
        let gesture = history.gesture();
        Known { document, history, gesture, versions: [first].into(), done: 0, refused: 0 }
    }

    fn edit(&mut self, random: &mut SmallRng) {
        let edit = drawn_edit(random, self.document.description());
        let before = bits(self.document.description());
        // One edit in two goes on with the gesture before.
        if random.random() {
            self.gesture = self.history.gesture();
        }
        match self.history.drag(&mut self.document, &edit, self.gesture) {
            Ok(()) => {
                self.done += 1;
                let after = bits(self.document.description());
                assert!(self.versions.insert(self.document.version(), after).is_none(), "versions are new");
            }
            Err(_) => {
                self.refused += 1;
                assert!(bits(self.document.description()).is_identical(&before), "{edit:?} is refused and changes something");
            }
        }
    }

    fn holds(&self) {
        let known = &self.versions[&self.document.version()];
        assert!(bits(self.document.description()).is_identical(known), "{:?}", self.history.next_redo());
    }

    fn reads(&self) {
        let text = self.document.text();
        let read = describe("saved", text.clone()).unwrap_or_else(|error| panic!("{}\n{text}", error.report()));
        assert!(bits(&read).is_identical(&bits(self.document.description())), "{text}");
        assert_eq!(read, *self.document.description());
    }
}

fn run(seed: u64, text: &str) -> (usize, usize) {
    let mut random = SmallRng::seed_from_u64(seed);
    let mut known = Known::of(Document::open("scene.toml", text).unwrap_or_else(|error| panic!("{}\n{text}", error.report())));
    for _ in 0..EDITS {
        match random.random_range(0..10) {
            0 | 1 => drop(known.history.undo(&mut known.document)),
            2 => drop(known.history.redo(&mut known.document)),
            _ => known.edit(&mut random),
        }
        known.holds();
        if random.random_range(0..10) == 0 {
            known.reads();
        }
    }
    let last = known.document.version();
    while known.history.redo(&mut known.document) {}
    let top = known.document.version();
    while known.history.undo(&mut known.document) {
        known.holds();
    }
    assert_eq!(known.document.text(), text, "seed {seed}: all is undone");
    assert!(!known.document.has_changes());
    while known.history.redo(&mut known.document) {
        known.holds();
    }
    assert!(known.document.version() == top && known.versions.contains_key(&last));
    known.reads();
    (known.done, known.refused)
}

#[test]
fn random_edits_of_the_built_in_scene() {
    let (mut done, mut refused) = (0, 0);
    for seed in 0..20 {
        let (more, less) = run(seed, BUILT_IN);
        (done, refused) = (done + more, refused + less);
    }
    assert!(done > 400 && refused > 50, "{done} were done, {refused} refused");
}

#[test]
fn random_edits_of_random_scenes() {
    let (mut done, mut refused) = (0, 0);
    for seed in 0..20 {
        let scene = drawn_scene(&mut SmallRng::seed_from_u64(1000 + seed));
        let (more, less) = run(seed, &write(&mut scene.clone()).to_string());
        (done, refused) = (done + more, refused + less);
    }
    assert!(done > 800 && refused > 50, "{done} were done, {refused} refused");
}
