//! Random edits, drawn from the declarations.
use rand::{Rng, rngs::SmallRng};

use super::*;
use crate::edit::trial::define_names;
use noisefall_base::declare::{Choice, Declare, Dice, Form, Parameter, Parameters, Step, Value};

/// Longer lists get no more items.
const LONGEST: usize = 6;

/// An edit of something in the description. Not all are possible.
pub fn drawn_edit(random: &mut SmallRng, description: &SceneDescription) -> Edit {
    let mut spots = Spots { path: Path::default(), lengths: Vec::new(), values: Vec::new(), edits: Vec::new() };
    description.clone().parameters(&mut spots);
    let Spots { values, mut edits, .. } = spots;
    if random.random_range(0..3) > 0 || edits.is_empty() {
        let mut redrawn = description.clone();
        redrawn.parameters(&mut Redraw(Dice::new(random)));
        define_names(random, &mut redrawn);
        let path = values[random.random_range(0..values.len())].clone();
        let value = Tree::at(&mut redrawn, &path).and_then(|tree| tree.value().cloned()).expect("values stay where they are");
        return Edit::set(path, value);
    }
    let first = edits.swap_remove(random.random_range(0..edits.len()));
    if random.random_range(0..8) > 0 || edits.is_empty() {
        return first;
    }
    // Places may have shifted: then none is done.
    Edit::All(vec![first, edits.swap_remove(random.random_range(0..edits.len()))])
}

/// Draws all values anew; what there is stays.
struct Redraw<'r>(Dice<'r>);

impl Parameters for Redraw<'_> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        self.0.value(parameter, value);
    }
}

/// Collects what can be edited.
struct Spots {
    path: Path,
    lengths: Vec<usize>,
    values: Vec<Path>,
    edits: Vec<Edit>,
}

impl Spots {
    fn descend(&mut self, path: Path) {
        self.lengths.push(self.path.0.len());
        self.path = path;
    }
}

impl Parameters for Spots {
    fn value(&mut self, parameter: &Parameter, _: Value<'_>) {
        self.values.push(self.path.key(parameter.key));
    }

    fn enter(&mut self, parameter: &Parameter, _: Form) {
        self.descend(self.path.key(parameter.key));
    }

    fn leave(&mut self) {
        self.path.0.truncate(self.lengths.pop().unwrap_or(0));
    }

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        let path = self.path.key(parameter.key);
        self.edits.push(if now { Edit::remove(path) } else { Edit::insert(path) });
        now
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        let others = choice.alternatives.iter().enumerate().filter(|(place, _)| *place != now);
        self.edits.extend(others.map(|(_, other)| Edit::choose(self.path.clone(), choice.what, other.name)));
        now
    }

    fn items(&mut self, parameter: &Parameter, now: usize) -> usize {
        let list = self.path.key(parameter.key);
        if now < LONGEST {
            self.edits.extend((0..=now).map(|place| Edit::insert(list.item(place))));
        }
        self.edits.extend((0..now).map(|place| Edit::remove(list.item(place))));
        self.edits.extend((1..now).map(|place| Edit::Move { path: list.item(place), to: (place * 5 + 3) % now }));
        now
    }

    fn item(&mut self, parameter: &Parameter, index: usize) {
        self.descend(self.path.key(parameter.key).item(index));
    }

    fn names(&mut self, parameter: &Parameter, now: Vec<String>) -> Vec<String> {
        let map = self.path.key(parameter.key);
        let free = (0..).map(|number| format!("free {number}")).find(|name| !now.contains(name)).expect("one is free");
        if now.len() < LONGEST {
            self.edits.push(Edit::insert(map.key(&free)));
        }
        for name in &now {
            self.edits.push(Edit::remove(map.key(name)));
            self.edits.push(Edit::Rename { path: map.key(name), to: free.clone() });
        }
        now
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        self.descend(Path(vec![Step::Key(parameter.key.to_owned()), Step::Key(name.to_owned())]));
    }
}
