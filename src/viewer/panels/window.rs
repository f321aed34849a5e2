//! Settings of the window and the machine; none of them changes the image.
use egui::{ComboBox, Slider, ThemePreference, Ui};

use crate::viewer::widgets::{
    list::{entry, value_entry},
    slider::{self, Scale},
    style::{controls, row},
};

const THEMES: [(ThemePreference, &str); 3] =
    [(ThemePreference::System, "As the system"), (ThemePreference::Dark, "Dark"), (ThemePreference::Light, "Light")];

/// Sizes of the interface to choose from.
const SCALES: [f32; 6] = [0.75, 1.0, 1.25, 1.5, 1.75, 2.0];

/// The number of cores of this machine.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The number of cores that render at first: one is left for the window and other programs.
pub fn all_but_one(cores: usize) -> usize {
    cores.saturating_sub(1).max(1)
}

/// Returns the theme that was chosen, by the name to save: none for that of the system.
pub fn show(ui: &mut Ui, threads: &mut usize, shows_frame_times: &mut bool) -> Option<Option<String>> {
    let mut chosen = None;
    controls(ui, "window", |ui| {
        let doc = "Number of render threads. It does not change the image.";
        row(ui, "Threads", doc, |ui, label| {
            let most = cores().max(*threads);
            let scale = Scale::linear(1.0..=most as f64);
            slider::show(ui, threads, &scale, all_but_one(cores()), |ui, threads| {
                ui.add(Slider::new(threads, 1..=most)).labelled_by(label)
            });
        });
        row(ui, "Theme", "Light, dark, or the theme of the system.", |ui, label| chosen = theme(ui, label));
        row(ui, "Frame times", "Shows how long the window takes to draw. (F12)", |ui, label| {
            ui.checkbox(shows_frame_times, "").labelled_by(label);
        });
        row(ui, "Scale", "Size of text and controls. (Ctrl and + or -; Ctrl+0 resets)", scale);
    });
    chosen
}

fn theme(ui: &mut Ui, label: egui::Id) -> Option<Option<String>> {
    let (mut chosen, mut theme) = (None, ui.ctx().options(|options| options.theme_preference));
    let name = THEMES.iter().find(|(preference, _)| *preference == theme).map_or("", |(_, name)| name);
    let combo = ComboBox::from_id_salt("Theme").selected_text(name).show_ui(ui, |ui| {
        for (preference, name) in THEMES {
            if value_entry(ui, &mut theme, preference, name).clicked() {
                ui.ctx().set_theme(preference);
                chosen = Some((preference != ThemePreference::System).then(|| name.to_lowercase()));
            }
        }
    });
    combo.response.labelled_by(label);
    chosen
}

fn scale(ui: &mut Ui, label: egui::Id) {
    let (now, percent) = (ui.ctx().zoom_factor(), |scale: f32| format!("{:.0} %", 100.0 * scale));
    let combo = ComboBox::from_id_salt("Scale").selected_text(percent(now)).show_ui(ui, |ui| {
        for scale in SCALES {
            if entry(ui, scale == now, percent(scale)).clicked() {
                ui.ctx().set_zoom_factor(scale);
            }
        }
    });
    combo.response.labelled_by(label);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_core_is_left_unless_it_is_the_only_one() {
        assert_eq!([0, 1, 2, 16].map(all_but_one), [1, 1, 1, 15]);
    }
}
