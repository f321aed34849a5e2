//! Visits of the values, tables, choices and lists that a declaration consists of.
use std::{collections::BTreeMap, mem};

use glam::DVec3;

use super::{
    declared::{Declare, OneOf},
    lister::outline,
    outline::{Alternative, Choice, Outline},
    parameter::{CountRange, Parameter, Range},
    value::{Textured, Value, Word, Words},
    visitor::{Form, Parameters, Rearrangement},
};

impl dyn Parameters + '_ {
    /// Visits the parameters of `table` in a table at a key.
    pub fn table(&mut self, parameter: &Parameter, table: &mut dyn Declare) {
        self.enter(parameter, Form::Table);
        if !self.skips() {
            table.parameters(self);
        }
        self.leave();
    }

    /// Visits a value that may be absent. `fresh` makes it when it is added.
    pub fn optional<T>(
        &mut self,
        parameter: &Parameter,
        slot: &mut Option<T>,
        fresh: impl FnOnce() -> T,
        visit: impl FnOnce(&mut dyn Parameters, &mut T),
    ) {
        if !self.present(parameter, slot.is_some()) {
            *slot = None;
            return;
        }
        visit(self, slot.get_or_insert_with(fresh));
    }

    /// Visits a table that may be absent.
    pub fn optional_table<T: Declare + Default>(&mut self, parameter: &Parameter, slot: &mut Option<T>) {
        self.optional(parameter, slot, T::default, |p, table| p.table(parameter, table));
    }

    /// Visits a table that keeps its defaults if its key is absent.
    pub fn optional_part<T: Declare>(&mut self, parameter: &Parameter, table: &mut T) {
        if self.given(parameter) {
            self.table(parameter, table);
        }
    }

    /// Visits one of several alternatives, whose keys are in the current table.
    pub fn one_of<T: OneOf>(&mut self, value: &mut T) {
        let mut alternatives = T::alternatives();
        let reads = self.reads_outlines();
        let seen = |alternative: &mut T| {
            let outline = if reads { outline(|p| alternative.chosen(p)) } else { Outline::new() };
            Alternative { name: alternative.name(), title: alternative.about().title, outline }
        };
        let choice = Choice { what: T::WHAT, alternatives: alternatives.iter_mut().map(seen).collect() };
        if self.sees_all() {
            self.choose(&choice, value.place());
            for alternative in &mut alternatives {
                self.alternative(Some(alternative.name()));
                alternative.chosen(self);
            }
            return self.alternative(None);
        }
        let place = self.choose(&choice, value.place());
        if place != value.place() {
            *value = alternatives.swap_remove(place);
        }
        value.chosen(self);
    }

    /// Visits one of several alternatives in a table at a key, or its name if it needs no values.
    pub fn choice<T: OneOf>(&mut self, parameter: &Parameter, form: Form, value: &mut T) {
        self.enter(parameter, form);
        if !self.skips() {
            self.one_of(value);
        }
        self.leave();
    }

    /// Visits a choice that keeps its default if its key is absent.
    pub fn optional_choice<T: OneOf>(&mut self, parameter: &Parameter, form: Form, value: &mut T) {
        if self.given(parameter) {
            self.choice(parameter, form, value);
        }
    }

    /// A list of tables at a key.
    pub fn list<T: Declare + Default>(&mut self, parameter: &Parameter, list: &mut Vec<T>) {
        match self.rearrange(parameter, list.len()) {
            Some(Rearrangement::Insert(place)) => list.insert(place, T::default()),
            Some(Rearrangement::Remove(place)) => drop(list.remove(place)),
            Some(Rearrangement::Move(from, to)) => {
                let item = list.remove(from);
                list.insert(to, item);
            }
            None => {}
        }
        let count = self.items(parameter, list.len());
        list.resize_with(count, T::default);
        for (index, item) in list.iter_mut().enumerate() {
            self.item(parameter, index);
            if !self.skips() {
                item.parameters(self);
            }
            self.leave();
        }
    }

    /// A table of named tables at a key.
    pub fn map<T: Declare + Default>(&mut self, parameter: &Parameter, map: &mut BTreeMap<String, T>) {
        let names = self.names(parameter, map.keys().cloned().collect());
        let mut known = mem::take(map);
        for name in names {
            self.named(parameter, &name);
            let mut table = known.remove(&name).unwrap_or_default();
            if !self.skips() {
                table.parameters(self);
            }
            map.insert(name, table);
            self.leave();
        }
    }

    /// A number in a range.
    pub fn number(&mut self, parameter: &Parameter, value: &mut f64, range: Range) {
        self.value(parameter, Value::Number(value, range));
    }

    /// A number that is kept in single precision: it reads as it is written.
    pub fn single(&mut self, parameter: &Parameter, value: &mut f32, range: Range) {
        let mut number = value.to_string().parse().unwrap_or(f64::from(*value));
        self.number(parameter, &mut number, range);
        *value = number as f32;
    }

    /// A whole number in a range.
    pub fn count(&mut self, parameter: &Parameter, value: &mut u32, range: CountRange) {
        self.value(parameter, Value::Count(value, range));
    }

    /// True or false.
    pub fn flag(&mut self, parameter: &Parameter, value: &mut bool) {
        self.value(parameter, Value::Flag(value));
    }

    /// A colour or the name of a texture.
    pub fn textured(&mut self, parameter: &Parameter, value: &mut Textured, range: Range) {
        self.value(parameter, Value::Textured(value, range));
    }

    /// A number or the name of a texture whose luminance it is.
    pub fn textured_number(&mut self, parameter: &Parameter, value: &mut Textured<f64>, range: Range) {
        self.value(parameter, Value::TexturedNumber(value, range));
    }

    /// A colour, linear Rec. 709.
    pub fn colour(&mut self, parameter: &Parameter, value: &mut [f64; 3], range: Range) {
        self.value(parameter, Value::Colour(value, range));
    }

    /// A position or a direction, in metres.
    pub fn point(&mut self, parameter: &Parameter, value: &mut DVec3) {
        self.value(parameter, Value::Point(value));
    }

    /// One of a few words.
    pub fn word<T: Words>(&mut self, parameter: &Parameter, value: &mut T) {
        let words = T::words();
        let mut place = words.iter().position(|(_, word)| word == value).unwrap_or(0);
        let list: Vec<Word> = words.iter().map(|(word, _)| *word).collect();
        self.value(parameter, Value::Word(&mut place, &list));
        *value = words[place].1;
    }
}
