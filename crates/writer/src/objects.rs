//! Updates the objects of a file. Each one moves with its text, including comments.
use toml_edit::{Array, ArrayOfTables, Item, Table as TomlTable, Value};

use super::{
    lists::Layout,
    outline::Table,
    tables::{Level, Update, section},
    values::written_table,
};

/// Room for the tables of an object between two objects.
const SPREAD: isize = 1 << 20;

impl Update<'_> {
    /// Matches each object with the object of the file that it comes from, if there is one.
    pub fn objects(&self, item: &mut Item, was: &[Table], now: &[Table]) {
        match item {
            Item::ArrayOfTables(tables) => self.object_tables(tables, was, now),
            Item::Value(Value::Array(array)) => self.object_array(array, was, now),
            _ => {}
        }
    }

    /// The place in the file of an object.
    fn origin(&self, place: usize) -> Option<usize> {
        self.origins.objects.get(place).copied().flatten()
    }

    fn object_tables(&self, tables: &mut ArrayOfTables, was: &[Table], now: &[Table]) {
        let mut old: Vec<Option<TomlTable>> = std::mem::take(tables).into_iter().map(Some).collect();
        let is_spaced = old.last().and_then(|last| last.as_ref()).is_none_or(|last| prefix(last).starts_with('\n'));
        let survives: Vec<bool> = {
            let mut survives = vec![false; old.len()];
            (0..now.len()).filter_map(|place| self.origin(place)).for_each(|origin| survives[origin] = true);
            survives
        };
        hand_on_comments(&mut old, &survives);
        let mut new = Vec::new();
        for (place, now) in now.iter().enumerate() {
            let known = self.origin(place).and_then(|origin| Some((old.get_mut(origin)?.take()?, was.get(origin)?)));
            new.push(match known {
                Some((mut table, was)) => {
                    self.table(&mut table, was, now, Level::Inner);
                    table
                }
                None => {
                    let mut table = section(now);
                    table.decor_mut().set_prefix(if is_spaced { "\n" } else { "" });
                    table
                }
            });
        }
        put_in_order(&mut new);
        new.into_iter().for_each(|table| tables.push(table));
    }

    fn object_array(&self, array: &mut Array, was: &[Table], now: &[Table]) {
        let layout = Layout::of(array);
        let mut old: Vec<Option<Value>> = array.iter().cloned().map(Some).collect();
        array.clear();
        for (place, now) in now.iter().enumerate() {
            let known = self.origin(place).and_then(|origin| Some((old.get_mut(origin)?.take()?, was.get(origin)?)));
            array.push_formatted(match known {
                Some((mut value, was)) => {
                    self.table_value(&mut value, was, now);
                    value
                }
                None => written_table(now),
            });
        }
        if self.origins.objects != (0..was.len()).map(Some).collect::<Vec<_>>() {
            layout.apply(array);
        }
    }
}

fn prefix(table: &TomlTable) -> &str {
    table.decor().prefix().and_then(|prefix| prefix.as_str()).unwrap_or_default()
}

/// Comments that an empty line separates from an object do not move with it.
fn hand_on_comments(tables: &mut [Option<TomlTable>], survives: &[bool]) {
    let mut orphans = String::new();
    for (table, survives) in tables.iter_mut().zip(survives) {
        let Some(table) = table else { continue };
        let prefix = prefix(table).to_owned();
        if *survives {
            if !orphans.is_empty() {
                table.decor_mut().set_prefix(std::mem::take(&mut orphans) + &prefix);
            }
        } else if let Some((comments, _)) = prefix.rsplit_once("\n\n").filter(|(comments, _)| comments.contains('#')) {
            orphans += comments;
            orphans.push('\n');
        }
    }
}

/// Gives tables positions in the file by their order.
fn put_in_order(tables: &mut [TomlTable]) {
    let known: Vec<isize> = tables.iter().filter_map(TomlTable::position).collect();
    if !known.is_sorted() {
        let mut slots = known;
        slots.sort_unstable();
        let moved = tables.iter_mut().filter(|table| table.position().is_some());
        for (table, slot) in moved.zip(slots) {
            let mut rank = 0;
            each_position(table, &mut |_| {
                rank += 1;
                slot + rank - 1
            });
        }
    }
    // A new table comes behind the one before it; the first has none.
    let first = tables.iter().find_map(TomlTable::position);
    if let Some(table) = tables.first_mut().filter(|table| table.position().is_none()) {
        table.set_position(first);
    }
}

/// Makes room between the tables of a file.
pub fn spread(root: &mut TomlTable) {
    each_position(root, &mut |position| position * SPREAD);
}

/// Changes the positions of a table and of those in it.
fn each_position(table: &mut TomlTable, change: &mut impl FnMut(isize) -> isize) {
    if let Some(position) = table.position() {
        table.set_position(Some(change(position)));
    }
    for (_, item) in table.iter_mut() {
        match item {
            Item::Table(inner) => each_position(inner, change),
            Item::ArrayOfTables(tables) => tables.iter_mut().for_each(|inner| each_position(inner, change)),
            _ => {}
        }
    }
}
