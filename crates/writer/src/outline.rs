//! The content of a file for a description: values by key, and which of them equal the reader's defaults.
use std::collections::BTreeMap;

use super::tree::{Answer, Tree};
use noisefall_base::declare::{Choice, Declare, Form, OwnedValue, Parameter, Parameters, Value};
use noisefall_scene::scene::description::SceneDescription;

/// A table of a file.
#[derive(Debug, Default)]
pub struct Table {
    /// Entries in reading order.
    pub entries: Vec<Entry>,
    /// The name that may replace the table if it has no other content.
    pub name: Option<&'static str>,
}

/// The entry at a key.
#[derive(Debug)]
pub struct Entry {
    pub key: &'static str,
    pub node: Node,
    /// Whether the reader assumes the same if the key is absent.
    pub is_default: bool,
}

/// A value, a table or several.
#[derive(Debug)]
pub enum Node {
    Value {
        value: OwnedValue,
        /// Three equal numbers may be written as one.
        collapses: bool,
    },
    Table(Table),
    List(Vec<Table>),
    Named(BTreeMap<String, Table>),
}

impl Table {
    /// The outline of a whole scene.
    pub fn of(description: &SceneDescription) -> Table {
        let answers = Tree::of(&mut description.clone()).0;
        // The default description is led through the same choices: what it says then is what a reader assumes.
        let mut outliner = Outliner { answers: answers.into_iter(), frames: vec![OutlineFrame::default()] };
        SceneDescription::default().parameters(&mut outliner);
        outliner.frames.pop().map(|frame| frame.table).unwrap_or_default()
    }

    /// The entry at a key.
    pub fn get(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    /// Whether no entry needs to be written.
    pub fn is_default(&self) -> bool {
        self.entries.iter().all(|entry| entry.is_default)
    }

    /// Whether both have the same content, bit for bit.
    pub fn is_identical(&self, other: &Table) -> bool {
        let same = |(a, b): (&Entry, &Entry)| a.key == b.key && a.node.is_identical(&b.node);
        self.name == other.name && self.entries.len() == other.entries.len() && self.entries.iter().zip(&other.entries).all(same)
    }
}

impl Node {
    /// Whether both have the same content, bit for bit.
    pub fn is_identical(&self, other: &Node) -> bool {
        match (self, other) {
            (Node::Value { value: a, .. }, Node::Value { value: b, .. }) => a.is_identical(b),
            (Node::Table(a), Node::Table(b)) => a.is_identical(b),
            (Node::List(a), Node::List(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.is_identical(b)),
            (Node::Named(a), Node::Named(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.0 == b.0 && a.1.is_identical(b.1))
            }
            _ => false,
        }
    }
}

/// Destination of the visited table.
#[derive(Default)]
enum Destination {
    #[default]
    Key,
    Item,
    Named(String),
}

#[derive(Default)]
struct OutlineFrame {
    table: Table,
    key: &'static str,
    place: Destination,
    form: Option<Form>,
    /// Whether the table must be written even if all of its values are defaults.
    is_needed: bool,
    /// Keys of the alternatives that are not the reader's default.
    needed_keys: Vec<&'static str>,
    /// Whether the part that is visited next is absent by default.
    next_is_needed: bool,
}

/// Visits a default description and gives it the structure of another.
struct Outliner {
    answers: std::vec::IntoIter<Answer>,
    frames: Vec<OutlineFrame>,
}

impl Outliner {
    fn frame(&mut self) -> &mut OutlineFrame {
        self.frames.last_mut().expect("the whole file is around")
    }

    /// Whether the entry at a key must be written.
    fn needs(&mut self, parameter: &Parameter) -> bool {
        let frame = self.frame();
        let appears = std::mem::take(&mut frame.next_is_needed);
        appears || parameter.is_required || frame.needed_keys.contains(&parameter.key)
    }

    fn add(&mut self, key: &'static str, node: Node, is_default: bool) {
        self.frame().table.entries.push(Entry { key, node, is_default });
    }
}

impl Parameters for Outliner {
    fn value(&mut self, parameter: &Parameter, value: Value<'_>) {
        let collapses = matches!(value, Value::Colour(..) | Value::Textured(..) | Value::Factors(_));
        let assumed = OwnedValue::of(&value);
        let is_needed = self.needs(parameter);
        if let Some(Answer::Value(value)) = self.answers.next() {
            let is_default = !is_needed && value.is_identical(&assumed);
            self.add(parameter.key, Node::Value { value, collapses }, is_default);
        }
    }

    fn enter(&mut self, parameter: &Parameter, form: Form) {
        let is_needed = self.needs(parameter);
        self.frames.push(OutlineFrame { key: parameter.key, form: Some(form), is_needed, ..OutlineFrame::default() });
    }

    fn leave(&mut self) {
        let Some(OutlineFrame { table, key, place, is_needed, .. }) = self.frames.pop() else { return };
        let entries = &mut self.frame().table.entries;
        match (place, entries.last_mut().map(|entry| &mut entry.node)) {
            (Destination::Item, Some(Node::List(list))) => list.push(table),
            (Destination::Named(name), Some(Node::Named(tables))) => drop(tables.insert(name, table)),
            _ => {
                let is_default = !is_needed && table.is_default();
                self.add(key, Node::Table(table), is_default);
            }
        }
    }

    fn present(&mut self, _: &Parameter, now: bool) -> bool {
        let Some(Answer::Present(is_present)) = self.answers.next() else { return now };
        self.frame().next_is_needed = is_present;
        is_present
    }

    fn choose(&mut self, choice: &Choice, now: usize) -> usize {
        let Some(Answer::Choose(place)) = self.answers.next() else { return now };
        let chosen = &choice.alternatives[place];
        let frame = self.frame();
        if frame.form == Some(Form::NameOrTable) {
            frame.table.name = Some(chosen.name);
            frame.is_needed |= place != now;
        } else if place != now && !chosen.outline.iter().any(|entry| entry.parameter.is_required) {
            frame.needed_keys.extend(chosen.outline.iter().map(|entry| entry.parameter.key));
        }
        place
    }

    fn items(&mut self, parameter: &Parameter, now: usize) -> usize {
        let Some(Answer::Items(count)) = self.answers.next() else { return now };
        self.add(parameter.key, Node::List(Vec::new()), count == 0);
        count
    }

    fn item(&mut self, parameter: &Parameter, _: usize) {
        self.frames.push(OutlineFrame { key: parameter.key, place: Destination::Item, ..OutlineFrame::default() });
    }

    fn names(&mut self, parameter: &Parameter, now: Vec<String>) -> Vec<String> {
        let Some(Answer::Names(names)) = self.answers.next() else { return now };
        self.add(parameter.key, Node::Named(BTreeMap::new()), names.is_empty());
        names
    }

    fn named(&mut self, parameter: &Parameter, name: &str) {
        self.frames.push(OutlineFrame {
            key: parameter.key,
            place: Destination::Named(name.to_owned()),
            ..OutlineFrame::default()
        });
    }
}
