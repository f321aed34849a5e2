//! A snapshot of a part of a description, which can be restored bit for bit.
use super::walk::Walk;
use noisefall_base::declare::{Choice, Declare, Form, OwnedValue, Parameter, Parameters, Path, Value};

/// A value, a table or a list with all that is in it: the answers that a visitor gets, in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree(pub Vec<Answer>);

/// An answer of a description to a visitor.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    Value(OwnedValue),
    Present(bool),
    Choose(usize),
    Items(usize),
    Names(Vec<String>),
}

impl Tree {
    /// A snapshot of a whole description.
    pub fn of(description: &mut dyn Declare) -> Tree {
        let everything = Path::default();
        Tree::at(description, &everything).unwrap_or(Tree(Vec::new()))
    }

    /// A snapshot of the content at a path, if there is any.
    pub fn at(description: &mut dyn Declare, path: &Path) -> Option<Tree> {
        let is_everything = path.0.is_empty();
        let mut recorder = Recorder { walk: Walk::to(path), answers: Vec::new(), is_found: is_everything };
        description.parameters(&mut recorder);
        recorder.is_found.then_some(Tree(recorder.answers))
    }

    /// Whether both hold the same bits.
    pub fn is_identical(&self, other: &Tree) -> bool {
        let same = |(a, b): (&Answer, &Answer)| match (a, b) {
            (Answer::Value(a), Answer::Value(b)) => a.is_identical(b),
            _ => a == b,
        };
        self.0.len() == other.0.len() && self.0.iter().zip(&other.0).all(same)
    }

    /// The value, if it is one.
    pub fn value(&self) -> Option<&OwnedValue> {
        match &self.0[..] {
            [Answer::Value(value)] => Some(value),
            _ => None,
        }
    }
}

struct Recorder<'p> {
    walk: Walk<'p>,
    answers: Vec<Answer>,
    is_found: bool,
}

impl Recorder<'_> {
    fn note(&mut self, key: &str, answer: impl FnOnce() -> Answer) {
        if self.walk.takes(key) {
            self.answers.push(answer());
            self.is_found = true;
        }
    }
}

impl Parameters for Recorder<'_> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        self.note(parameter.key, || Answer::Value(OwnedValue::of(&value)));
    }

    fn enter(&mut self, parameter: &Parameter, _: Form) {
        self.walk.enter(parameter.key);
        self.is_found |= self.walk.is_within();
    }

    fn leave(&mut self) {
        self.walk.leave();
    }

    fn skips(&self) -> bool {
        self.walk.is_beside()
    }

    fn present(&mut self, _: &Parameter, now: bool) -> bool {
        if self.walk.is_within() {
            self.answers.push(Answer::Present(now));
        }
        now
    }

    fn choose(&mut self, _: &Choice, now: usize) -> usize {
        if self.walk.is_within() {
            self.answers.push(Answer::Choose(now));
        }
        now
    }

    fn items(&mut self, parameter: &Parameter, now: usize) -> usize {
        self.note(parameter.key, || Answer::Items(now));
        now
    }

    fn item(&mut self, parameter: &Parameter, index: usize) {
        self.walk.item(parameter.key, index);
        self.is_found |= self.walk.is_within();
    }

    fn names(&mut self, parameter: &Parameter, now: Vec<String>) -> Vec<String> {
        self.note(parameter.key, || Answer::Names(now.clone()));
        now
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        self.walk.named(parameter.key, name);
        self.is_found |= self.walk.is_within();
    }
}
