//! What concerns the window and the machine, and not the picture.
use egui::{ComboBox, Slider, ThemePreference, Ui};

use super::{
    app::App,
    look::{controls, row},
};

const THEMES: [(ThemePreference, &str); 3] =
    [(ThemePreference::System, "As the system"), (ThemePreference::Dark, "Dark"), (ThemePreference::Light, "Light")];

/// As many as the machine has cores.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Of so many cores, those that render at first: one is left for the window and everything else.
pub fn all_but_one(cores: usize) -> usize {
    cores.saturating_sub(1).max(1)
}

impl App {
    pub(super) fn window_panel(&mut self, ui: &mut Ui) {
        controls(ui, "window", |ui| {
            let doc =
                "Cores that render; one is left for the rest of the machine at first. Another number never changes the picture.";
            row(ui, "Threads", doc, |ui, label| {
                let most = cores().max(self.threads);
                ui.add(Slider::new(&mut self.threads, 1..=most)).labelled_by(label);
            });
            row(ui, "Theme", "Light or dark, or as the system has it.", |ui, label| self.theme(ui, label));
            row(ui, "Frame times", "How long the window itself takes to draw. (F12)", |ui, label| {
                ui.checkbox(&mut self.pace.shown, "").labelled_by(label);
            });
        });
    }

    fn theme(&mut self, ui: &mut Ui, label: egui::Id) {
        let mut theme = ui.ctx().options(|options| options.theme_preference);
        let name = THEMES.iter().find(|(preference, _)| *preference == theme).map_or("", |(_, name)| name);
        let combo = ComboBox::from_id_salt("Theme").selected_text(name).show_ui(ui, |ui| {
            for (preference, name) in THEMES {
                if ui.selectable_value(&mut theme, preference, name).clicked() {
                    ui.ctx().set_theme(preference);
                    let named = (preference != ThemePreference::System).then(|| name.to_lowercase());
                    self.preferences.change(|preferences| preferences.theme = named);
                }
            }
        });
        combo.response.labelled_by(label);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_core_is_left_unless_it_is_the_only_one() {
        assert_eq!([0, 1, 2, 16].map(all_but_one), [1, 1, 1, 15]);
    }
}
