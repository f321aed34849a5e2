//! Completes a path by the entries of its folder.
use std::path::{Path, is_separator};

use egui::{Button, Key, Modifiers, RichText, ScrollArea, Ui, vec2};

use crate::viewer::{
    background::folder::{FolderEntry, FolderReader},
    widgets::path_field::PathField,
};

/// Most rows of the list.
const MOST: usize = 200;

/// The list below the field: what the typed path can go on with.
#[derive(Default)]
pub struct Completion {
    reader: FolderReader,
    /// The entries that begin as the typed name does.
    pub matches: Vec<FolderEntry>,
    /// The row that was chosen by arrows.
    chosen: Option<usize>,
    /// The text and the list of the folder that the rows are of.
    of: (String, u64),
}

impl Completion {
    /// Follows the field, and the keys in it: arrows choose a row, Tab completes the text. Precedes the field.
    pub fn follow(&mut self, ui: &Ui, field: &mut PathField, extensions: &'static [&str]) {
        let (folder, name) = split(&field.path);
        let (entries, revision) = self.reader.of(ui.ctx(), Path::new(folder), extensions);
        if self.of != (field.path.clone(), revision) {
            self.matches = entries.iter().filter(|entry| is_match(entry, name)).cloned().collect();
            (self.of, self.chosen) = ((field.path.clone(), revision), None);
        }
        if field.has_keyboard(ui) {
            let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
            let (down, up, tab) = (pressed(Key::ArrowDown), pressed(Key::ArrowUp), pressed(Key::Tab));
            self.step(down, up);
            if tab {
                self.complete(ui, field);
            }
        }
    }

    /// The path of the chosen row, and whether it is a file.
    pub fn chosen(&self, field: &PathField) -> Option<(String, bool)> {
        self.chosen.map(|row| self.path(field, &self.matches[row]))
    }

    fn rows(&self) -> usize {
        self.matches.len().min(MOST)
    }

    fn step(&mut self, down: bool, up: bool) {
        let last = self.rows().checked_sub(1);
        self.chosen = match (self.chosen, last) {
            (_, None) => None,
            (None, Some(_)) if down => Some(0),
            (None, Some(last)) if up => Some(last),
            (Some(row), Some(last)) if down => Some((row + 1).min(last)),
            // Above the first row is the text itself.
            (Some(row), _) if up => row.checked_sub(1),
            (chosen, _) => chosen,
        };
    }

    /// Completes the text as far as all matches agree, or to the chosen row.
    fn complete(&mut self, ui: &Ui, field: &mut PathField) {
        if let Some((path, _)) = self.chosen(field) {
            return field.set(ui, path);
        }
        let (folder, _) = split(&field.path);
        match self.matches.as_slice() {
            [] => {}
            [only] => {
                let (path, _) = self.path(field, only);
                field.set(ui, path);
            }
            [first, others @ ..] => {
                let common = others.iter().fold(first.name.as_str(), |common, entry| common_start(common, &entry.name));
                // Names that differ only in case have fewer letters in common than the text has.
                if common.chars().count() >= split(&field.path).1.chars().count() {
                    let path = format!("{folder}{common}");
                    field.set(ui, path);
                }
            }
        }
    }

    /// The path of an entry: that of a folder ends in a separator.
    fn path(&self, field: &PathField, entry: &FolderEntry) -> (String, bool) {
        let (folder, _) = split(&field.path);
        let end = if entry.is_file { "" } else { std::path::MAIN_SEPARATOR_STR };
        (format!("{folder}{}{end}", entry.name), entry.is_file)
    }

    /// Shows the list. Returns the path of the row that was clicked, and whether it is a file.
    pub fn show(&self, ui: &mut Ui, field: &PathField, height: f32) -> Option<(String, bool)> {
        let mut clicked = None;
        let scroll = ScrollArea::vertical().id_salt("completion").max_height(height).min_scrolled_height(height);
        scroll.auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            for (row, entry) in self.matches.iter().take(MOST).enumerate() {
                let name = if entry.is_file { entry.name.clone() } else { format!("{}/", entry.name) };
                let is_chosen = self.chosen == Some(row);
                let button = Button::selectable(is_chosen, name).truncate().min_size(vec2(ui.available_width(), 0.0));
                let response = ui.add(button);
                if is_chosen {
                    response.scroll_to_me(None);
                }
                if response.clicked() {
                    clicked = Some(self.path(field, entry));
                }
            }
            if self.matches.len() > MOST {
                ui.label(RichText::new(format!("and {} more; type more letters to see them", self.matches.len() - MOST)).weak());
            }
            if self.matches.is_empty() {
                ui.label(RichText::new("No scene, mesh or image here starts with this name.").weak());
            }
        });
        clicked
    }
}

/// Whether an entry begins as a typed name does. Hidden ones are asked for by their point.
fn is_match(entry: &FolderEntry, name: &str) -> bool {
    let is_shown = name.starts_with('.') || !entry.name.starts_with('.');
    is_shown && entry.name.to_lowercase().starts_with(&name.to_lowercase())
}

/// The folder of a typed path, with the separator, and what follows it.
fn split(path: &str) -> (&str, &str) {
    let path = path.trim_start();
    let end = path.rfind(is_separator).map_or(0, |last| last + 1);
    path.split_at(end)
}

/// The start that two names have in common.
fn common_start<'a>(a: &'a str, b: &str) -> &'a str {
    let same = a.chars().zip(b.chars()).take_while(|(a, b)| a == b).map(|(letter, _)| letter.len_utf8()).sum();
    &a[..same]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_its_folder_and_a_name() {
        assert_eq!(split("scenes/fur"), ("scenes/", "fur"));
        assert_eq!([split("fur"), split("/"), split("")], [("", "fur"), ("/", ""), ("", "")]);
        assert_eq!(common_start("räume.toml", "räder.toml"), "rä");
    }

    #[test]
    fn arrows_go_through_the_rows_and_back_to_the_text() {
        let entry = |name: &str| FolderEntry { is_file: true, name: name.to_owned() };
        let mut list = Completion { matches: vec![entry("a"), entry("b")], ..Completion::default() };
        let mut after = |down: bool| {
            list.step(down, !down);
            list.chosen
        };
        let rows = [true, true, true, false, false, false].map(&mut after);
        assert_eq!(rows, [Some(0), Some(1), Some(1), Some(0), None, Some(1)]);
        list.matches.clear();
        list.step(true, false);
        assert_eq!(list.chosen, None);
    }
}
