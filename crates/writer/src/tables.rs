//! Updates the tables of a file.
use toml_edit::{InlineTable, Item, Key, Table as TomlTable, TableLike, Value};

use super::origin::Origins;
use super::{
    outline::{Entry, Node, Table},
    values::{replace, written, written_node, written_table},
};

/// Updates a file from its old content to its new content.
pub struct Update<'o> {
    /// Positions of objects, materials and textures in the file.
    pub origins: &'o Origins,
}

/// Style of a new table.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// Under a header of its own.
    Root,
    /// On one line.
    Inner,
}

impl Update<'_> {
    /// Updates a table: removes old keys and inserts new ones at their places in reading order.
    pub fn table(&self, table: &mut dyn TableLike, was: &Table, now: &Table, level: Level) {
        let keys = keys_of(table);
        keys.iter().filter(|key| now.get(key).is_none()).for_each(|key| drop(table.remove(key)));
        for (place, entry) in now.entries.iter().enumerate() {
            let before = was.get(entry.key);
            let empties = matches!(&entry.node, Node::List(list) if list.is_empty()) && before.is_some_and(|was| !was.is_default);
            match (table.get_mut(entry.key), before) {
                (Some(_), _) if empties => drop(table.remove(entry.key)),
                (Some(item), Some(was)) => self.item(item, &was.node, entry, level),
                (Some(item), None) => *item = Item::Value(written_node(&entry.node)),
                (None, _) if !entry.is_default => {
                    let before = now.entries[..place].iter().rev().find(|before| table.contains_key(before.key));
                    insert_behind(table, before.map(|before| before.key), entry.key, fresh(entry, level));
                }
                (None, _) => {}
            }
        }
    }

    fn item(&self, item: &mut Item, was: &Node, now: &Entry, level: Level) {
        match (was, &now.node) {
            (Node::Value { value: was, .. }, Node::Value { value, collapses }) => match item {
                _ if was.is_identical(value) => {}
                Item::Value(old) => replace(old, value, *collapses),
                _ => *item = Item::Value(written(value, *collapses)),
            },
            (Node::Table(was), Node::Table(now)) => self.table_item(item, was, now),
            (Node::List(was), Node::List(tables)) if level == Level::Root && now.key == "objects" => {
                self.objects(item, was, tables);
            }
            (Node::List(was), Node::List(now)) => self.list(item, was, now),
            (Node::Named(was), Node::Named(tables)) => self.named(item, now.key, was, tables),
            (_, now) => *item = Item::Value(written_node(now)),
        }
    }

    /// Updates the item that holds a table or its name.
    pub fn table_item(&self, item: &mut Item, was: &Table, now: &Table) {
        match item {
            Item::Value(value) => self.table_value(value, was, now),
            _ if becomes_name(was, now) => *item = Item::Value(written_table(now)),
            Item::Table(table) => self.table(table, was, now, Level::Inner),
            _ => {}
        }
    }

    /// Updates the value that holds a table on one line, or its name.
    pub fn table_value(&self, value: &mut Value, was: &Table, now: &Table) {
        if was.is_identical(now) {
            return;
        }
        match value {
            Value::InlineTable(table) if !becomes_name(was, now) => self.inline(table, was, now),
            _ => {
                let decor = value.decor().clone();
                *value = written_table(now);
                *value.decor_mut() = decor;
            }
        }
    }

    fn inline(&self, table: &mut InlineTable, was: &Table, now: &Table) {
        let keys = keys_of(table);
        let is_one_line = !table.to_string().contains('\n');
        self.table(table, was, now, Level::Inner);
        if is_one_line && keys != keys_of(table) {
            table.fmt();
        }
    }
}

/// Whether a name replaces a table.
fn becomes_name(was: &Table, now: &Table) -> bool {
    now.name.is_some() && now.name != was.name && now.is_default()
}

/// The keys of a table in their order.
pub fn keys_of(table: &dyn TableLike) -> Vec<String> {
    table.iter().map(|(key, _)| key.to_owned()).collect()
}

/// Inserts an item behind the one at a key, or before all others.
fn insert_behind(table: &mut dyn TableLike, before: Option<&str>, key: &str, item: Item) {
    let keys = keys_of(table);
    let place = before.and_then(|before| keys.iter().position(|key| key == before)).map_or(0, |place| place + 1);
    let behind: Vec<(Key, Item)> = keys[place..].iter().filter_map(|key| take(table, key)).collect();
    table.insert(key, item);
    put_back(table, behind);
}

/// Takes an item out, with the format of its key.
pub fn take(table: &mut dyn TableLike, key: &str) -> Option<(Key, Item)> {
    let formatted = table.key(key)?.clone();
    Some((formatted, table.remove(key)?))
}

/// Appends items with the formats of their keys.
pub fn put_back(table: &mut dyn TableLike, items: Vec<(Key, Item)>) {
    for (key, item) in items {
        table.entry_format(&key).or_insert(item);
    }
}

/// A new item in the style of a person.
fn fresh(entry: &Entry, level: Level) -> Item {
    match &entry.node {
        Node::Table(table) if level == Level::Root => Item::Table(section(table)),
        Node::List(tables) if level == Level::Root => Item::ArrayOfTables(tables.iter().map(section).collect()),
        Node::Named(tables) if level == Level::Root => {
            let mut around: TomlTable = tables.iter().map(|(name, table)| (name.as_str(), Item::Table(section(table)))).collect();
            around.set_implicit(true);
            Item::Table(around)
        }
        node => Item::Value(written_node(node)),
    }
}

/// A table under a header.
pub fn section(table: &Table) -> TomlTable {
    let entries = table.entries.iter().filter(|entry| !entry.is_default);
    entries.map(|entry| (entry.key, Item::Value(written_node(&entry.node)))).collect()
}
