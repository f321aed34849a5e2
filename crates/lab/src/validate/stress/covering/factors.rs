//! The factors of scenes: what the declarations say that can vary.
use std::collections::HashMap;

use super::{
    array::Factor,
    place::{Place, growth, is_left_out},
};
use noisefall_base::declare::{Choice, Declare, Family, Form, Parameter, Parameters, Value};
use noisefall_scene::scene::description::SceneDescription;

/// A factor of scenes.
#[derive(Clone, Debug)]
pub struct SceneFactor {
    /// The path of the parameter. Alternatives of a choice may have parameters of the same path, of which one exists at a time.
    pub path: String,
    pub levels: Vec<String>,
    pub factor: Factor,
    /// The level in the description without changes.
    pub base: usize,
    /// Whether it is a number, and no choice between things.
    pub is_number: bool,
}

/// The factors of a description. Names of materials that are empty can be any of `materials`.
pub fn factors(description: &SceneDescription, materials: &[String]) -> Vec<SceneFactor> {
    let mut collector = Collector { materials, ..Collector::default() };
    description.clone().parameters(&mut collector);
    collector.factors
}

/// The suffixes of the paths of factors that are no values: presence of an optional value, presence of an item of a list, kind, whether a
/// value is a texture, and whether factors mirror.
pub const PRESENCE: &str = "?";
pub const ITEM: &str = "+";
pub const KIND: &str = ":";
pub const TEXTURE: &str = "~";
pub const MIRROR: &str = "-";

const OFF_ON: [&str; 2] = ["no", "yes"];
const CHANGED: [&str; 2] = ["default", "changed"];

type Scope = Option<(usize, usize)>;

#[derive(Default)]
struct Collector<'m> {
    materials: &'m [String],
    factors: Vec<SceneFactor>,
    place: Place,
    /// The level at which what is visited next exists; the last is that of the current table.
    scopes: Vec<Scope>,
    /// The presence of what is visited next.
    pending: Scope,
    /// The choices whose alternatives are visited, each with the next one.
    choices: Vec<(usize, usize)>,
    /// The present items and the scopes of further ones, by the path of the list.
    lists: HashMap<String, (usize, Vec<Scope>)>,
}

impl Collector<'_> {
    fn scope(&mut self) -> Scope {
        self.pending.take().or_else(|| self.scopes.last().copied().flatten())
    }

    fn add(&mut self, path: String, levels: &[&str], base: usize, is_number: bool) -> usize {
        let factor = Factor { levels: levels.len(), parent: self.scope(), is_choice: path.ends_with(KIND) };
        let levels = levels.iter().map(|level| (*level).to_owned()).collect();
        self.factors.push(SceneFactor { path, levels, factor, base, is_number });
        self.factors.len() - 1
    }
}

impl Parameters for Collector<'_> {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        let path = self.place.path_of(parameter.key);
        if is_left_out(parameter) {
            self.pending = None;
            return;
        }
        match value {
            Value::Flag(flag) => _ = self.add(path, &OFF_ON, usize::from(*flag), false),
            Value::Word(place, words) => {
                let words: Vec<&str> = words.iter().map(|word| word.name).collect();
                self.add(path, &words, *place, false);
            }
            Value::Name(name, Family::Material) if name.is_empty() => {
                let names: Vec<&str> = self.materials.iter().map(String::as_str).collect();
                self.add(path, &names, 0, false);
            }
            Value::Textured(..) | Value::TexturedNumber(..) => {
                let factor = self.add(path.clone() + TEXTURE, &OFF_ON, 0, false);
                self.pending = Some((factor, 0));
                self.add(path, &CHANGED, 0, true);
            }
            Value::Factors(_) => {
                let scope = self.scope();
                for (path, levels, is_number) in [(path.clone() + MIRROR, &OFF_ON, false), (path, &CHANGED, true)] {
                    self.pending = scope;
                    self.add(path, levels, 0, is_number);
                }
            }
            Value::Colour(..)
            | Value::Number(..)
            | Value::Count(..)
            | Value::Point(_)
            | Value::Vector(_)
            | Value::Pair(_)
            | Value::Matrix(_) => _ = self.add(path, &CHANGED, 0, true),
            Value::Text(_) | Value::File(_) | Value::Name(..) | Value::Counts(_) | Value::Points(_) | Value::Triangles(_) => {
                self.pending = None;
            }
        }
    }

    fn enter(&mut self, parameter: &Parameter, _: Form) {
        let scope = self.scope();
        self.scopes.push(scope);
        self.place.enter(parameter);
    }

    fn leave(&mut self) {
        self.scopes.pop();
        self.place.leave();
    }

    fn skips(&self) -> bool {
        self.place.is_fixed()
    }

    fn present(&mut self, parameter: &Parameter, now: bool) -> bool {
        if is_left_out(parameter) {
            return now;
        }
        let factor = self.add(self.place.path_of(parameter.key) + PRESENCE, &OFF_ON, usize::from(now), false);
        self.pending = Some((factor, 1));
        true
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        let names: Vec<&str> = choice.alternatives.iter().map(|alternative| alternative.name).collect();
        let factor = self.add(self.place.path_of(choice.what) + KIND, &names, now, false);
        self.choices.push((factor, 0));
        self.scopes.push(None);
        now
    }

    fn alternative(&mut self, name: Option<&'static str>) {
        self.scopes.pop();
        match (name, self.choices.last_mut()) {
            (Some(_), Some((factor, next))) => {
                self.scopes.push(Some((*factor, *next)));
                *next += 1;
            }
            _ => _ = self.choices.pop(),
        }
    }

    fn items(&mut self, parameter: &Parameter, now: usize) -> usize {
        let path = self.place.path_of(parameter.key);
        let mut scopes = Vec::new();
        for item in now..now + growth(&self.place, now) {
            let factor = self.add(format!("{path}.{item}{ITEM}"), &OFF_ON, 0, false);
            scopes.push(Some((factor, 1)));
            self.pending = Some((factor, 1));
        }
        self.pending = None;
        let count = now + scopes.len();
        self.lists.insert(path, (now, scopes));
        count
    }

    fn item(&mut self, parameter: &Parameter, index: usize) {
        let (now, scopes) = self.lists.get(&self.place.path_of(parameter.key)).cloned().unwrap_or_default();
        let is_fixed = index < now && !(self.place.is_top() && index > 0);
        let scope = if index < now { self.scope() } else { scopes[index - now] };
        self.scopes.push(scope);
        self.place.enter_item(parameter, index, is_fixed);
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        let scope = self.scope();
        self.scopes.push(scope);
        self.place.enter_named(parameter, name);
    }

    fn sees_all(&self) -> bool {
        true
    }

    fn reads_outlines(&self) -> bool {
        false
    }
}
