//! Updates the materials and textures of a file.
use std::collections::BTreeMap;

use toml_edit::{Item, Key, TableLike};

use super::{
    outline::Table,
    tables::{Update, keys_of, put_back, section, take},
    values::written_table,
};

impl Update<'_> {
    /// Renames, removes and appends tables. New ones have the style of the others.
    pub fn named(&self, item: &mut Item, map: &str, was: &BTreeMap<String, Table>, now: &BTreeMap<String, Table>) {
        let Some(tables) = item.as_table_like_mut() else { return };
        self.rename(tables, map, now);
        for (name, now) in now {
            let origin = self.origins.name(map, name).and_then(|origin| was.get(origin));
            match (tables.get_mut(name), origin) {
                (Some(item), Some(was)) => self.table_item(item, was, now),
                _ => {
                    let fresh = in_style_of(tables, now);
                    tables.insert(name, fresh);
                }
            }
        }
    }

    fn rename(&self, tables: &mut dyn TableLike, map: &str, now: &BTreeMap<String, Table>) {
        let renamed: BTreeMap<&str, &str> =
            now.keys().filter_map(|name| Some((self.origins.name(map, name)?, name.as_str()))).collect();
        let keys = keys_of(tables);
        if keys.iter().all(|key| renamed.get(key.as_str()) == Some(&key.as_str())) {
            return;
        }
        // A renamed table keeps its place.
        let taken: Vec<(Key, Item)> = keys.iter().filter_map(|key| take(tables, key)).collect();
        let kept = taken.into_iter().filter_map(|(key, item)| {
            let name = *renamed.get(key.get())?;
            let is_same = name == key.get();
            let fresh = || Key::new(name).with_leaf_decor(key.leaf_decor().clone()).with_dotted_decor(key.dotted_decor().clone());
            Some((if is_same { key.clone() } else { fresh() }, item))
        });
        put_back(tables, kept.collect());
    }
}

/// A new table in the style of its neighbours.
fn in_style_of(tables: &dyn TableLike, table: &Table) -> Item {
    let headers = tables.iter().filter_map(|(_, item)| item.as_table()).filter(|table| !table.is_dotted());
    let has_lines = tables.iter().any(|(_, item)| item.is_value() || item.as_table().is_some_and(toml_edit::Table::is_dotted));
    let last = headers.last();
    if last.is_none() && has_lines {
        return Item::Value(written_table(table));
    }
    let mut fresh = section(table);
    if let Some(prefix) = last.and_then(|last| last.decor().prefix()?.as_str()) {
        fresh.decor_mut().set_prefix(if prefix.starts_with('\n') { "\n" } else { "" });
    }
    Item::Table(fresh)
}
