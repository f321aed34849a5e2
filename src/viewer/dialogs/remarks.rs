//! The window that lists what was not imported exactly from a scene of another program.
use std::path::is_separator;

use egui::{Align2, ScrollArea, style::ScrollStyle};
use noisefall_formats::import::Remarks;

use crate::viewer::widgets::{quotation::with_quotation_marks, style::over_the_picture};

/// Largest number of remarks that are shown. The copied text has all.
const MOST: usize = 200;

/// Shows the list, until it is closed.
pub fn show(ctx: &egui::Context, open: &mut bool, remarks: &Remarks) {
    let copy = || remarks.lines(remarks.len()).join("\n");
    egui::Window::new("Differences from the original scene")
        .open(open)
        .collapsible(false)
        .default_width((ctx.content_rect().width() - 376.0).clamp(300.0, 720.0))
        .anchor(Align2::CENTER_CENTER, over_the_picture(0.0))
        .show(ctx, |ui| {
            // The bar shows that the list goes on.
            ui.spacing_mut().scroll = ScrollStyle::solid();
            ScrollArea::vertical().max_height(320.0).auto_shrink([false, true]).show(ui, |ui| {
                remarks.lines(MOST).iter().for_each(|line| show_remark(ui, line));
            });
            ui.add_space(4.0);
            ui.label("Everything else was imported exactly.");
            ui.add_space(4.0);
            if ui.button("Copy").on_hover_text("Copies the whole list.").clicked() {
                ui.ctx().copy_text(copy());
            }
        });
}

fn show_remark(ui: &mut egui::Ui, line: &str) {
    let (folder, rest) = line.split_at(folder_length(line));
    let label = ui.add(egui::Label::new(with_quotation_marks(rest)).wrap());
    if !folder.is_empty() {
        label.on_hover_text(format!("{folder}{}", place(rest)));
    }
}

/// The start of a line that says where the remark applies.
fn place(line: &str) -> &str {
    line.split_once(": ").map_or(line, |(place, _)| place)
}

/// The number of bytes before the name of the file. The names of materials can have slashes too, but they are quoted.
fn folder_length(line: &str) -> usize {
    let file = place(line).split('"').next().unwrap_or_default();
    file.rfind(is_separator).map_or(0, |last| last + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_begins_with_the_name_of_its_file() {
        let short = |line: &'static str| &line[folder_length(line)..];
        assert_eq!(short("/long/way/a.xml:1:1 and another place: `a/b` → c"), "a.xml:1:1 and another place: `a/b` → c");
        assert_eq!(short("way/a.gltf: material \"x/y\": found"), "a.gltf: material \"x/y\": found");
        assert_eq!(short("material \"x/y\": found"), "material \"x/y\": found");
        assert_eq!(short("… and 3 more"), "… and 3 more");
    }

    #[test]
    fn a_place_ends_before_the_finding() {
        assert_eq!(place("a.xml:1:5: `hair` → plastic: smooth"), "a.xml:1:5");
    }
}
