//! Updates the lists of tables in a file: transforms, motions.
use toml_edit::{Array, Item, Value};

use super::{
    outline::Table,
    tables::{Level, Update, section},
    values::written_table,
};

impl Update<'_> {
    /// Matches each item of a list with the item of the file at the same index.
    pub fn list(&self, item: &mut Item, was: &[Table], now: &[Table]) {
        match item {
            Item::Value(Value::Array(array)) => self.array(array, was, now),
            Item::ArrayOfTables(tables) => {
                while tables.len() > now.len() {
                    tables.remove(tables.len() - 1);
                }
                for (place, now) in now.iter().enumerate() {
                    match (tables.get_mut(place), was.get(place)) {
                        (Some(table), Some(was)) => self.table(table, was, now, Level::Inner),
                        _ => tables.push(section(now)),
                    }
                }
            }
            _ => {}
        }
    }

    fn array(&self, array: &mut Array, was: &[Table], now: &[Table]) {
        let layout = Layout::of(array);
        let length = array.len();
        while array.len() > now.len() {
            array.remove(array.len() - 1);
        }
        for (place, now) in now.iter().enumerate() {
            match (array.get_mut(place), was.get(place)) {
                (Some(value), Some(was)) => self.table_value(value, was, now),
                _ => array.push_formatted(written_table(now)),
            }
        }
        if length != now.len() {
            layout.apply(array);
        }
    }
}

/// Layout of the items of an array.
pub struct Layout {
    /// The text before an item on a line of its own.
    indent: Option<String>,
}

impl Layout {
    /// The layout of an array.
    pub fn of(array: &Array) -> Layout {
        let prefix = |value: &Value| value.decor().prefix().and_then(|prefix| prefix.as_str()).map(str::to_owned);
        let own_line = array.iter().filter_map(prefix).find(|prefix| prefix.contains('\n'));
        // Of what stands before the first item only the last line is its indent.
        Layout { indent: own_line.and_then(|prefix| prefix.rsplit_once('\n').map(|(_, indent)| format!("\n{indent}"))) }
    }

    /// Lays out an array whose items have changed.
    pub fn apply(&self, array: &mut Array) {
        let Some(indent) = &self.indent else { return array.fmt() };
        for value in array.iter_mut() {
            let is_bare =
                |text: Option<&toml_edit::RawString>| text.and_then(|text| text.as_str()).is_none_or(|text| !text.contains('#'));
            if is_bare(value.decor().prefix()) {
                value.decor_mut().set_prefix(indent);
            }
            if is_bare(value.decor().suffix()) {
                value.decor_mut().set_suffix("");
            }
        }
        array.set_trailing_comma(true);
        if array.trailing().as_str().is_none_or(|trailing| !trailing.contains('\n')) {
            array.set_trailing("\n");
        }
    }
}
