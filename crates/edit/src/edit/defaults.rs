//! The value that a parameter has by default.
use super::{Document, tree::Tree};
use noisefall_base::declare::{Choice, Declare, OwnedValue, Parameter, Parameters, Path, Value};
use noisefall_scene::scene::description::SceneDescription;

impl Document {
    /// The default of the value at a path: that of its kind, or else that of a new scene. `None` if there is no such value.
    pub fn default_of(&self, path: &Path) -> Option<OwnedValue> {
        let mut renewed = self.description().clone();
        let now = Tree::at(&mut renewed, path)?.value().cloned()?;
        renew(&mut renewed);
        let of_kind = Tree::at(&mut renewed, path)?.value().cloned()?;
        if of_kind != now {
            return Some(of_kind);
        }
        Tree::at(&mut SceneDescription::default(), path).and_then(|tree| tree.value().cloned()).or(Some(now))
    }
}

/// Makes all kinds of a description anew, with their defaults.
fn renew(description: &mut SceneDescription) {
    let mut record = Chooser::Record(Vec::new());
    description.parameters(&mut record);
    description.parameters(&mut Chooser::Leave);
    if let Chooser::Record(places) = record {
        description.parameters(&mut Chooser::Return(places.into_iter()));
    }
}

/// Chooses alternatives one after the other.
enum Chooser {
    /// Records what is chosen.
    Record(Vec<usize>),
    /// Chooses others: their values are new.
    Leave,
    /// Chooses what was recorded.
    Return(std::vec::IntoIter<usize>),
}

impl Parameters for Chooser {
    fn value(&mut self, _: &Parameter, _: Value<'_>) {}

    fn reads_outlines(&self) -> bool {
        false
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        match self {
            Chooser::Record(places) => {
                places.push(now);
                now
            }
            Chooser::Leave => (now + 1) % choice.alternatives.len(),
            Chooser::Return(places) => places.next().unwrap_or(now),
        }
    }
}
