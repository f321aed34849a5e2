//! Removes the part at a path, and moves items of lists.
use super::walk::Walk;
use noisefall_base::declare::{Declare, Form, Parameter, Parameters, Path, Rearrangement};

/// Removes an optional value or table, a table with a name, or an item of a list. Returns false if there is no such part.
pub fn remove(description: &mut dyn Declare, path: &Path) -> bool {
    take(description, path, None)
}

/// Moves an item within its list. Returns false if there is no such item or place.
pub fn relocate(description: &mut dyn Declare, path: &Path, to: usize) -> bool {
    take(description, path, Some(to))
}

fn take(description: &mut dyn Declare, path: &Path, to: Option<usize>) -> bool {
    let mut taker = Taker { walk: Walk::to(path), to, is_done: false };
    description.parameters(&mut taker);
    taker.is_done
}

struct Taker<'p> {
    walk: Walk<'p>,
    /// The new index of the item; `None` removes it.
    to: Option<usize>,
    is_done: bool,
}

impl Parameters for Taker<'_> {
    fn value(&mut self, _: &Parameter, _: noisefall_base::declare::Value<'_>) {}

    fn enter(&mut self, parameter: &Parameter, _: Form) {
        self.walk.enter(parameter.key);
    }

    fn leave(&mut self) {
        self.walk.leave();
    }

    fn skips(&self) -> bool {
        self.is_done || self.walk.is_beside() || self.walk.is_within()
    }

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        let goes = now && self.to.is_none() && self.walk.is_at(parameter.key);
        self.is_done |= goes;
        now && !goes
    }

    fn rearrange(&mut self, parameter: &Parameter, length: usize) -> Option<Rearrangement> {
        let place = self.walk.item_at(parameter.key).filter(|place| *place < length)?;
        let rearrangement = match self.to {
            None => Rearrangement::Remove(place),
            Some(to) if to < length => Rearrangement::Move(place, to),
            Some(_) => return None,
        };
        self.is_done = true;
        Some(rearrangement)
    }

    fn item(&mut self, parameter: &Parameter, index: usize) {
        self.walk.item(parameter.key, index);
    }

    fn names(&mut self, parameter: &Parameter, mut now: Vec<String>) -> Vec<String> {
        if let Some(name) = self.walk.name_at(parameter.key).filter(|_| self.to.is_none()) {
            let before = now.len();
            now.retain(|known| known != name);
            self.is_done |= now.len() < before;
        }
        now
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        self.walk.named(parameter.key, name);
    }
}
