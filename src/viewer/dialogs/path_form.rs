//! The form in which a dialog asks for an existing file: a field that completes paths, what is in the folder, and the buttons.
use std::path::{Path, PathBuf};

use egui::{Align, Align2, Button, Context, Layout, RichText, Ui, Window};

use super::{completion::Completion, question::hold_keyboard};
use crate::viewer::{background::catalogue::in_full, widgets::path_field::PathField};

/// Width of the form and height of the list of the folder, points.
const WIDTH: f32 = 460.0;
const LIST: f32 = 130.0;

/// The path so far.
pub struct PathForm {
    pub field: PathField,
    completion: Completion,
}

/// The texts of a form, and the files that it takes.
pub struct Wanted<'a> {
    /// The sentences above the field.
    pub text: &'a str,
    /// Name of the button that takes the file.
    pub verb: &'static str,
    /// Name of the files in the dialog of the system.
    pub files: &'static str,
    pub extensions: &'static [&'static str],
}

/// The answer of a frame.
#[derive(Default)]
struct FormAnswer {
    /// The path that was chosen or typed, which need not be that of a file.
    path: Option<PathBuf>,
    cancels: bool,
}

/// The result of a dialog in a frame.
pub enum Asked {
    /// A file that exists was chosen.
    File(PathBuf),
    GoesOn,
    GivenUp,
}

/// Shows a form in a window in the middle. What `below` shows under it may choose a path, too.
pub fn ask(
    ctx: &Context,
    title: &str,
    form: &mut PathForm,
    wanted: &Wanted<'_>,
    below: impl FnOnce(&mut Ui) -> Option<PathBuf>,
) -> Asked {
    let mut open = true;
    let window = Window::new(title).open(&mut open).collapsible(false).resizable(false);
    let shown = window.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(ctx, |ui| {
        hold_keyboard(ui);
        let answer = form.show(ui, wanted);
        FormAnswer { path: below(ui).or(answer.path), ..answer }
    });
    let answer = shown.and_then(|shown| shown.inner).unwrap_or_default();
    match answer.path.and_then(|path| form.existing(path)) {
        Some(file) => Asked::File(file),
        None if open && !answer.cancels => Asked::GoesOn,
        None => Asked::GivenUp,
    }
}

impl PathForm {
    /// A form that begins in the folder of the open scene.
    pub fn new(scene: Option<&Path>, hint: &'static str) -> PathForm {
        let path = scene.map(in_full);
        let folder = path.as_ref().and_then(|path| path.parent());
        let start = folder.map_or_else(String::new, |folder| folder.join("").display().to_string());
        PathForm { field: PathField::new(start, hint).with_completion(), completion: Completion::default() }
    }

    /// Whether the folder in the field has been read, and has this many entries to go on with.
    #[cfg(test)]
    pub fn lists(&self, count: usize) -> bool {
        self.completion.matches.len() == count
    }

    fn show(&mut self, ui: &mut Ui, wanted: &Wanted<'_>) -> FormAnswer {
        ui.set_width(WIDTH);
        ui.label(wanted.text);
        ui.add_space(4.0);
        self.completion.follow(ui, &mut self.field, wanted.extensions);
        let entered = self.field.show(ui);
        self.field.remark(ui, "");
        let clicked = self.completion.show(ui, &self.field, LIST);
        let [takes, cancels] = self.buttons(ui, wanted);
        let chosen = clicked.or_else(|| self.completion.chosen(&self.field).filter(|_| entered));
        let path = match chosen {
            Some((path, true)) => Some(path.into()),
            // A folder is listed, and not taken.
            Some((folder, false)) => {
                self.field.set(ui, folder);
                None
            }
            None => self.field.path().filter(|_| takes || entered),
        };
        let folder = path.as_ref().filter(|path| path.is_dir()).map(|path| path.join("").display().to_string());
        let is_folder = folder.is_some();
        folder.into_iter().for_each(|folder| self.field.set(ui, folder));
        FormAnswer { path: path.filter(|_| !is_folder), cancels }
    }

    /// Whether the file is taken, and whether the dialog is given up.
    fn buttons(&mut self, ui: &mut Ui, wanted: &Wanted<'_>) -> [bool; 2] {
        let row = ui.horizontal(|ui| {
            let folder = self.field.path().and_then(|path| path.parent().map(ToOwned::to_owned));
            let (files, extensions) = (wanted.files, wanted.extensions);
            self.field.browse(ui, move |dialog| {
                let dialog = dialog.add_filter(files, extensions);
                folder.into_iter().fold(dialog, rfd::FileDialog::set_directory).pick_file()
            });
            let ends = ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let take = Button::new(RichText::new(wanted.verb).strong());
                [ui.add_enabled(self.field.path().is_some(), take).clicked(), ui.button("Cancel").clicked()]
            });
            ends.inner
        });
        row.inner
    }

    /// The path, if there is a file. Otherwise the form says that there is none.
    fn existing(&mut self, path: PathBuf) -> Option<PathBuf> {
        let is_file = path.is_file();
        if !is_file {
            self.field.refusal = Some(format!("There is no file {}. Check the path, or choose Browse…", path.display()));
        }
        is_file.then_some(path)
    }
}
