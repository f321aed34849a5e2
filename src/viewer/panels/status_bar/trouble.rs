//! Problems of a render: invalid samples, cut paths and failures.
use std::path::PathBuf;

use egui::{Label, RichText};
use noisefall_render::render::{State, Status, pass::SampleId, replay_command::replay_command};
use noisefall_scene::scene::RenderSettings;

use super::StatusBar;
use crate::viewer::background::{
    catalogue::{BUILT_IN_STEM, file_stem},
    opened_scene::OpenedScene,
};
use crate::viewer::widgets::{counted::counted, palette::Palette, quotation::with_quotation_marks};

impl StatusBar<'_> {
    /// Reports what must not be overlooked.
    pub(super) fn trouble_label(&self, ui: &mut egui::Ui) {
        let Status { invalid_samples, first_invalid, cut_paths, .. } = *self.status;
        let mut trouble = |text: String, more: String| {
            ui.separator();
            let text = RichText::new(text).color(ui.bad());
            ui.add(Label::new(text).truncate()).on_hover_text(more);
        };
        if let Some(at) = first_invalid {
            let size = self.request.map_or([0; 2], |request| request.camera.resolution);
            let command = self.replay_command(at, size);
            trouble(counted(invalid_samples, "invalid sample"), format!("Replay the first: {command}"));
        }
        if cut_paths > 0 {
            let longest = self.request.map_or(RenderSettings::LONGEST_PATH, |request| request.settings.last_bounce());
            let text = format!("paths cut after {}", counted(longest, "bounce"));
            trouble(text, "Choose a roulette, so that paths end by themselves.".to_owned());
        }
        if let State::Failed(failure) = &self.status.state {
            let [x, y] = failure.at.pixel;
            let (place, advice) = if failure.replays {
                ("pixel", format!("Replay it: {}", self.replay_command(failure.at, failure.resolution)))
            } else {
                ("the tile at", "None of its samples fails alone.".to_owned())
            };
            trouble(format!("{place} {x},{y}, sample {}: {}", failure.at.sample, with_quotation_marks(&failure.message)), advice);
        }
    }

    fn replay_command(&self, at: SampleId, size: [u32; 2]) -> String {
        let Some(request) = self.request else { return String::new() };
        // A scene that is not saved is called as it will be; the built-in one is found by its name.
        let named = |opened: &OpenedScene| match file_stem(&opened.name) {
            stem if stem == BUILT_IN_STEM => PathBuf::from(stem),
            stem => PathBuf::from(stem).with_extension("toml"),
        };
        let file = self.opened.map(|opened| opened.path.clone().unwrap_or_else(|| named(opened))).unwrap_or_default();
        replay_command(&file, &request.scene, size, &request.settings, at)
    }
}
