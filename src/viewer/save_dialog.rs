//! Where to save the picture.
use std::path::{Path, PathBuf};

use egui::{Align2, Button, RichText};
use noisefall::{
    file::{self, replace},
    render::{
        image_file::{check_target, save_shown},
        settings_text::settings_text,
        view::View,
    },
};

use super::{
    app::App,
    darkroom::{Order, Print, develop},
    path::Form,
    path_field::PathField,
};

/// What is saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    Picture,
    CurvesCsv,
    CurvesSvg,
    /// What the path inspector shows.
    Path,
}

/// Asks where something goes.
pub struct SaveDialog {
    target: Target,
    field: PathField,
}

#[cfg(test)]
impl SaveDialog {
    /// What stands in the field.
    pub fn path(&self) -> &str {
        &self.field.path
    }
}

impl Target {
    fn title(self) -> &'static str {
        match self {
            Target::Picture => "Save picture",
            Target::CurvesCsv => "Save figures",
            Target::CurvesSvg => "Save plot",
            Target::Path => "Save path",
        }
    }

    fn explanation(self) -> &'static str {
        match self {
            Target::Picture => {
                "PNG is the picture as shown (of A and B it is A); EXR is linear radiance. Both carry the settings."
            }
            Target::CurvesCsv => "CSV: settings, samples, seconds, errors and bias, a line each.",
            Target::CurvesSvg => "SVG: the curves of all settings, for a page or a slide.",
            Target::Path => "TXT is the path in words and numbers, TEX its nested sum; CSV has the samples of the pixel.",
        }
    }

    /// What its files end in.
    fn extensions(self) -> &'static [&'static str] {
        match self {
            Target::Picture => &["png", "exr"],
            Target::CurvesCsv => &["csv"],
            Target::CurvesSvg => &["svg"],
            Target::Path => &["txt", "tex", "csv"],
        }
    }

    fn check(self, path: &Path) -> Result<(), String> {
        if self == Target::Picture {
            return check_target(path).map_err(|error| error.to_string());
        }
        if self == Target::Path && !self.takes(path) {
            return Err("The name must end in .txt, .tex or .csv.".to_owned());
        }
        file::check(path).map_err(|error| error.to_string())
    }
}

impl App {
    /// Whether what is shown is the full picture of what the controls say.
    pub(super) fn can_save(&self) -> bool {
        let is_found = || self.link.wish().is_some_and(|wish| self.finder.has(&wish.camera));
        let has_features = !self.look.view.shows_features() || is_found();
        let Some(frame) = self.shown.as_ref().filter(|_| has_features) else { return false };
        !frame.is_coarse() && frame.generation == self.link.generation()
    }

    pub(super) fn open_save_dialog(&mut self, target: Target) {
        if self.save_dialog.is_none() {
            let path = self.suggested_path(target.extensions()[0]).display().to_string();
            self.save_dialog = Some(SaveDialog { target, field: PathField::new(path, "path/to/file") });
        }
    }

    /// A name that is not taken, after the last file of this scene or after the scene.
    fn suggested_path(&self, extension: &str) -> PathBuf {
        let of_file = self.opened.as_ref().and_then(|opened| opened.path.as_ref()?.file_stem()?.to_str().map(str::to_owned));
        let name = of_file.unwrap_or_else(|| "cornell_spheres".to_owned());
        let path = self.last_saved.as_ref().filter(|path| extension != "png" || Target::Picture.takes(path));
        let here = || std::env::current_dir().map_or_else(|_| PathBuf::from(&name), |folder| folder.join(&name));
        let path = path.cloned().unwrap_or_else(here);
        let keeps = extension == "png" && Target::Picture.takes(&path);
        free(&if keeps { path } else { path.with_extension(extension) })
    }

    pub(super) fn save_dialog(&mut self, ctx: &egui::Context) {
        let Some(SaveDialog { target, mut field }) = self.save_dialog.take() else { return };
        let (mut open, mut save, mut cancelled) = (true, false, false);
        egui::Window::new(target.title())
            .open(&mut open)
            .collapsible(false)
            .resizable(false)
            .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
            .show(ctx, |ui| (save, cancelled) = dialog_body(ui, target, &mut field));
        if let Some(path) = field.path().filter(|_| save) {
            match target.check(&path) {
                Ok(()) => return self.save_target(target, path),
                Err(error) => field.refusal = Some(error),
            }
        }
        if open && !cancelled {
            self.save_dialog = Some(SaveDialog { target, field });
        }
    }

    fn save_target(&mut self, target: Target, path: PathBuf) {
        let bytes = match target {
            Target::Picture => return self.save_to(path),
            Target::CurvesCsv => self.history.csv(),
            Target::CurvesSvg => Ok(self.history.svg().into_bytes()),
            Target::Path => {
                let extension = path.extension().unwrap_or_default().to_string_lossy();
                let text = Form::of_extension(&extension).and_then(|form| self.inspected(form));
                text.map(String::into_bytes).ok_or_else(|| "No path is traced yet. Try again in a moment.".to_owned())
            }
        };
        self.saver.save(path, move |path| replace(path, &bytes?).map_err(|error| error.to_string()));
    }

    /// Saves what is shown.
    pub(super) fn save_to(&mut self, path: PathBuf) {
        if !self.can_save() {
            self.tell("Not saved: the new picture has no sample everywhere yet. Try again in a moment.".to_owned(), true);
            return;
        }
        let (Some(frame), Some(wish)) = (self.shown.clone(), self.link.wish()) else { return };
        let wish = wish.clone();
        let order = self.what_to_develop(frame.clone());
        let remarks = remarks(&order, &path);
        let settings = settings_text(&wish.scene, &wish.camera, &wish.settings, self.look.display, &frame, &remarks);
        self.saver.save(path, move |path| {
            let Print { frame, pixels, .. } = develop(order);
            save_shown(&frame, &pixels, &settings, path).map_err(|error| error.to_string())
        });
    }
}

impl Target {
    /// Whether a file ends as it should.
    fn takes(self, path: &Path) -> bool {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        extension.is_some_and(|extension| self.extensions().contains(&extension.as_str()))
    }
}

/// What of the picture a file shows, where that is not all of it: an EXR has all of it.
fn remarks(order: &Order, path: &Path) -> Vec<(&'static str, String)> {
    let view = order.look.view;
    let mut remarks = Vec::new();
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr")) {
        return remarks;
    }
    if view != View::Radiance {
        remarks.push(("view", view.name().to_owned()));
    }
    if let Some(term) = order.term.as_ref().filter(|_| matches!(view, View::Radiance | View::Difference)) {
        let relation = if term.up_to { "at most" } else { "exactly" };
        let bounces = if term.k == 1 { "bounce" } else { "bounces" };
        remarks.push(("light", format!("{relation} {} {bounces}, {} spp", term.k, term.of.spp)));
    }
    remarks
}

/// The path, or the first of `name-2`, `name-3`, … that is not taken.
fn free(path: &Path) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    // A number that was added here before is counted on.
    let stem = stem.rsplit_once('-').filter(|(_, n)| n.parse::<u32>().is_ok()).map_or(&*stem, |(stem, _)| stem);
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let numbered = (2..10_000).map(|n| path.with_file_name(format!("{stem}-{n}.{extension}")));
    std::iter::once(path.to_owned()).chain(numbered).find(|path| !path.exists()).unwrap_or_else(|| path.to_owned())
}

/// Whether to save, and whether to close. A file is replaced by the button that says so, never by Enter.
fn dialog_body(ui: &mut egui::Ui, target: Target, field: &mut PathField) -> (bool, bool) {
    ui.set_width(460.0);
    ui.label(target.explanation());
    ui.add_space(4.0);
    let entered = field.show(ui);
    let exists = field.path().is_some_and(|path| path.is_file());
    field.remark(ui, if exists { "This file exists. Replace it?" } else { "" });
    let (mut save, mut cancel) = (entered && !exists, false);
    ui.horizontal(|ui| {
        let choice = if target.extensions().len() > 1 { target.extensions() } else { &[] };
        for extension in choice {
            let chosen = field.path.trim().to_ascii_lowercase().ends_with(&format!(".{extension}"));
            if ui.selectable_label(chosen, extension.to_uppercase()).clicked() {
                field.path = PathBuf::from(&field.path).with_extension(extension).display().to_string();
                field.refusal = None;
            }
        }
        let name = field.path().and_then(|path| path.file_name().map(|name| name.to_string_lossy().into_owned()));
        field.browse(ui, move |dialog| {
            let dialog = dialog.add_filter(target.extensions().join(" or ").to_uppercase(), target.extensions());
            name.into_iter().fold(dialog, rfd::FileDialog::set_file_name).save_file()
        });
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let name = RichText::new(if exists { "Replace" } else { "Save" }).strong();
            save |= ui.add_enabled(field.path().is_some(), Button::new(name)).clicked();
            cancel = ui.button("Cancel").clicked();
        });
    });
    (save, cancel)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use noisefall::render::{Frame, view::Look};

    use super::*;
    use crate::viewer::darkroom::Term;

    #[test]
    fn a_png_says_what_of_the_picture_it_shows_and_an_exr_shows_all() {
        let said = |view, (k, up_to), path: &str| {
            let frame = Arc::new(Frame { spp: 9, ..Frame::default() });
            let order = Order {
                term: Some(Term { of: frame.clone(), k, up_to }),
                frame,
                beside: None,
                shows_beside: false,
                look: Look { view, ..Look::default() },
                truth: None,
                pinned: None,
                features: None,
                materials: Arc::from([]),
                most_side: 1,
            };
            remarks(&order, Path::new(path)).into_iter().map(|(_, text)| text).collect::<Vec<_>>()
        };
        assert_eq!(said(View::Radiance, (3, true), "a.png"), ["at most 3 bounces, 9 spp"]);
        assert_eq!(said(View::Radiance, (1, false), "a.png"), ["exactly 1 bounce, 9 spp"]);
        assert_eq!(said(View::Depth, (1, false), "a.png"), [View::Depth.name()], "no term is seen");
        assert!(said(View::Radiance, (3, true), "a.EXR").is_empty());
    }

    #[test]
    fn a_name_that_is_taken_is_numbered_on() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        let write = |name: &str| std::fs::write(path(name), "taken").expect("it is written");
        assert_eq!(free(&path("shot.png")), path("shot.png"));
        write("shot.png");
        assert_eq!(free(&path("shot.png")), path("shot-2.png"));
        write("shot-2.png");
        assert_eq!(free(&path("shot.png")), path("shot-3.png"));
        assert_eq!(free(&path("shot-2.png")), path("shot-3.png"), "a number is counted on, and not added to");
        write("two-balls.exr");
        assert_eq!(free(&path("two-balls.exr")), path("two-balls-2.exr"));
    }

    #[test]
    fn files_end_as_what_they_are() {
        let takes = |target: Target, name: &str| target.takes(Path::new(name));
        assert!(takes(Target::Picture, "a.png") && takes(Target::Picture, "a.EXR") && !takes(Target::Picture, "a.csv"));
        assert!(takes(Target::CurvesCsv, "a.csv") && !takes(Target::CurvesCsv, "a.svg") && !takes(Target::CurvesCsv, "csv"));
        assert!(takes(Target::CurvesSvg, "a.svg") && !takes(Target::CurvesSvg, "a.png"));
        for extension in Target::Path.extensions() {
            assert!(takes(Target::Path, &format!("a.{extension}")) && Form::of_extension(extension).is_some());
        }
        assert!(!takes(Target::Path, "a.png") && Target::Path.check(Path::new("a.png")).is_err());
    }

    #[test]
    fn a_folder_that_is_not_there_is_refused_before_anything_is_written() {
        let folder = tempfile::tempdir().expect("a folder");
        for (target, name) in [(Target::Picture, "a.png"), (Target::CurvesCsv, "a.csv"), (Target::CurvesSvg, "a.svg")] {
            assert_eq!(target.check(&folder.path().join(name)), Ok(()));
            assert!(target.check(&folder.path().join("nowhere").join(name)).is_err_and(|error| error.contains("nowhere")));
        }
        assert_eq!(Target::CurvesCsv.check(Path::new("a.csv")), Ok(()), "the current folder is there");
    }
}
