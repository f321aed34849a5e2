//! Puts a tree at a path: replaces the content there, or adds it.
use super::tree::{Answer, Tree};
use super::walk::{Walk, follows_walk};
use noisefall_base::declare::{Choice, Declare, Parameter, Parameters, Path, Rearrangement, Value};

/// Replaces the content at a path. Returns false if there is none, or if the tree does not fit; part of it may be replaced then.
pub fn replace(description: &mut dyn Declare, path: &Path, tree: &Tree) -> bool {
    put(description, path, Some(tree), false)
}

/// Adds an absent part, with its defaults or the content of a tree. Returns false if it cannot be added, or if the tree does not fit;
/// the part may have been added then.
pub fn insert(description: &mut dyn Declare, path: &Path, tree: Option<&Tree>) -> bool {
    put(description, path, tree, true)
}

fn put(description: &mut dyn Declare, path: &Path, tree: Option<&Tree>, adds: bool) -> bool {
    let answers = tree.map(|tree| tree.0.iter());
    let mut player = Player { walk: Walk::to(path), adds, is_there: !adds, answers, fits: true };
    description.parameters(&mut player);
    player.is_there && player.fits && player.answers.is_none_or(|mut left| left.next().is_none())
}

struct Player<'p> {
    walk: Walk<'p>,
    adds: bool,
    /// The part was absent before and exists now.
    is_there: bool,
    /// The answers for the description; without them it keeps its defaults.
    answers: Option<std::slice::Iter<'p, Answer>>,
    fits: bool,
}

impl<'p> Player<'p> {
    /// The next answer, once the walk has reached its target.
    fn next(&mut self, is_here: bool) -> Option<&'p Answer> {
        if !is_here {
            return None;
        }
        let next = self.answers.as_mut()?.next();
        self.fits &= next.is_some();
        next
    }
}

impl Parameters for Player<'_> {
    fn value(&mut self, parameter: &Parameter, mut value: Value<'_>) {
        match self.next(self.walk.takes(parameter.key)) {
            Some(Answer::Value(answer)) => self.fits &= answer.assign(&mut value),
            Some(_) => self.fits = false,
            None => {}
        }
    }

    follows_walk!();

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        if self.adds && self.walk.is_at(parameter.key) {
            self.is_there = !now;
            return true;
        }
        match self.next(self.walk.is_within()) {
            Some(Answer::Present(answer)) => *answer,
            Some(_) => {
                self.fits = false;
                now
            }
            None => now,
        }
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        match self.next(self.walk.is_within()) {
            Some(Answer::Choose(answer)) if *answer < choice.alternatives.len() => *answer,
            Some(_) => {
                self.fits = false;
                now
            }
            None => now,
        }
    }

    fn rearrange(&mut self, parameter: &Parameter, length: usize) -> Option<Rearrangement> {
        let place = self.walk.item_at(parameter.key).filter(|place| self.adds && *place <= length)?;
        self.is_there = true;
        Some(Rearrangement::Insert(place))
    }

    fn items(&mut self, parameter: &Parameter, now: usize) -> usize {
        match self.next(self.walk.takes(parameter.key)) {
            Some(Answer::Items(answer)) => *answer,
            Some(_) => {
                self.fits = false;
                now
            }
            None => now,
        }
    }

    fn names(&mut self, parameter: &Parameter, mut now: Vec<String>) -> Vec<String> {
        if let Some(name) = self.walk.name_at(parameter.key).filter(|_| self.adds) {
            self.is_there = !now.iter().any(|known| known == name);
            if self.is_there {
                now.push(name.to_owned());
            }
            return now;
        }
        match self.next(self.walk.takes(parameter.key)) {
            Some(Answer::Names(answer)) => answer.clone(),
            Some(_) => {
                self.fits = false;
                now
            }
            None => now,
        }
    }
}
