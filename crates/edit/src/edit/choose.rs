//! Chooses another alternative, and keeps the parameters that both have.
use std::collections::HashMap;

use super::walk::Walk;
use noisefall_base::declare::{Choice, Declare, Form, OwnedValue, Parameter, Parameters, Path, Step, Value, check_value};

/// Result of choosing an alternative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChoiceOutcome {
    /// The alternative was chosen.
    Done,
    /// The table has no such choice.
    NoChoice,
    /// There is no such alternative.
    NoAlternative,
}

/// Chooses the alternative `name` of the choice `what` in the table at a path. A parameter keeps its value if the former alternative
/// has one of the same key, meaning and type, and if the value is in range.
pub fn choose(description: &mut dyn Declare, path: &Path, what: &str, name: &str) -> ChoiceOutcome {
    let mut places = HashMap::new();
    let mut kept = HashMap::new();
    let mut chooser = Chooser { within: Within::to(path), what, name: None, kept: &mut kept, places: &mut places, outcome: None };
    description.parameters(&mut chooser);
    let mut chooser =
        Chooser { within: Within::to(path), what, name: Some(name), kept: &mut kept, places: &mut places, outcome: None };
    description.parameters(&mut chooser);
    chooser.outcome.unwrap_or(ChoiceOutcome::NoChoice)
}

/// A place in the table with the choice. Kinds keep their parameters in a table of their own name; its key is empty here.
type Place = Vec<Step>;

/// An answer of the former alternative at a place.
enum FormerAnswer {
    Value(Box<(Parameter, OwnedValue)>),
    Items(usize),
    Present,
}

/// Position of the visitor in the table with the choice.
struct Within<'p> {
    walk: Walk<'p>,
    place: Place,
    lengths: Vec<usize>,
    /// The alternative that is visited.
    alternative: &'static str,
}

impl<'p> Within<'p> {
    fn to(path: &'p Path) -> Within<'p> {
        Within { walk: Walk::to(path), place: Vec::new(), lengths: Vec::new(), alternative: "" }
    }

    fn at(&self, key: &str) -> Place {
        self.place.iter().cloned().chain([Step::Key(key.to_owned())]).collect()
    }

    /// Where the table at a key is.
    fn table_at(&self, key: &str) -> Place {
        self.at(if self.place.is_empty() && key == self.alternative { "" } else { key })
    }

    /// Called before the walk enters.
    fn descend(&mut self, place: Place, enter: impl FnOnce(&mut Walk<'p>)) {
        self.lengths.push(self.place.len());
        if self.walk.is_within() {
            self.place = place;
        }
        enter(&mut self.walk);
    }

    fn leave(&mut self) {
        self.walk.leave();
        self.place.truncate(self.lengths.pop().unwrap_or(0));
    }
}

struct Chooser<'p, 'k> {
    within: Within<'p>,
    what: &'p str,
    /// The new alternative; absent while the former one is read.
    name: Option<&'p str>,
    kept: &'k mut HashMap<Place, FormerAnswer>,
    /// Choices within the former alternative.
    places: &'k mut HashMap<(Place, &'static str), &'static str>,
    outcome: Option<ChoiceOutcome>,
}

impl Parameters for Chooser<'_, '_> {
    fn value(&mut self, parameter: &Parameter, mut value: Value<'_>) {
        if !self.within.walk.is_within() {
            return;
        }
        let place = self.within.at(parameter.key);
        let was = OwnedValue::of(&value);
        if self.name.is_none() {
            self.kept.insert(place, FormerAnswer::Value(Box::new((*parameter, was))));
        } else if let Some(FormerAnswer::Value(former)) = self.kept.get(&place)
            && let (before, kept) = &**former
            && before.means_same(parameter)
            && kept.assign(&mut value)
            && check_value(parameter, &value).is_some()
        {
            was.assign(&mut value);
        }
    }

    fn enter(&mut self, parameter: &Parameter, _: Form) {
        let place = self.within.table_at(parameter.key);
        self.within.descend(place, |walk| walk.enter(parameter.key));
    }

    fn leave(&mut self) {
        self.within.leave();
    }

    fn skips(&self) -> bool {
        self.within.walk.is_beside()
    }

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        if !self.within.walk.is_within() {
            return now;
        }
        // Of the value that is visited next.
        let mut place = self.within.at(parameter.key);
        place.push(Step::Key("present".to_owned()));
        if self.name.is_none() {
            if now {
                self.kept.insert(place, FormerAnswer::Present);
            }
            return now;
        }
        now || matches!(self.kept.get(&place), Some(FormerAnswer::Present))
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        if !self.within.walk.is_within() {
            return now;
        }
        let place_of = |name: &str| choice.alternatives.iter().position(|alternative| alternative.name == name);
        let is_this = self.within.place.is_empty() && choice.what == self.what;
        let key = (self.within.place.clone(), choice.what);
        let chosen = match self.name {
            None => {
                self.places.insert(key, choice.alternatives[now].name);
                now
            }
            Some(name) if is_this => {
                self.outcome = Some(if place_of(name).is_some() { ChoiceOutcome::Done } else { ChoiceOutcome::NoAlternative });
                place_of(name).unwrap_or(now)
            }
            Some(_) => self.places.get(&key).and_then(|name| place_of(name)).unwrap_or(now),
        };
        if is_this {
            self.within.alternative = choice.alternatives[chosen].name;
        }
        chosen
    }

    fn items(&mut self, parameter: &Parameter, now: usize) -> usize {
        if !self.within.walk.is_within() {
            return now;
        }
        let place = self.within.at(parameter.key);
        if self.name.is_none() {
            self.kept.insert(place, FormerAnswer::Items(now));
            return now;
        }
        match self.kept.get(&place) {
            Some(FormerAnswer::Items(kept)) => *kept,
            _ => now,
        }
    }

    fn item(&mut self, parameter: &Parameter, index: usize) {
        let mut place = self.within.at(parameter.key);
        place.push(Step::Item(index));
        self.within.descend(place, |walk| walk.item(parameter.key, index));
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        let mut place = self.within.at(parameter.key);
        place.push(Step::Key(name.to_owned()));
        self.within.descend(place, |walk| walk.named(parameter.key, name));
    }
}
