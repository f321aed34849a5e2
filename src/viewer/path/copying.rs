//! Copying and saving what is inspected, for a report.
use egui::Ui;
use noisefall::render::{
    path_samples::SampleTable,
    path_text::{self, PathId},
};

use crate::viewer::{app::App, save_dialog::Target};

/// In what form a path or the samples of its pixel leave the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum Form {
    Text,
    Latex,
    Samples,
}

impl Form {
    const ALL: [Form; 3] = [Form::Text, Form::Latex, Form::Samples];

    fn name(self) -> &'static str {
        match self {
            Form::Text => "Text",
            Form::Latex => "LaTeX",
            Form::Samples => "Samples",
        }
    }

    fn explanation(self) -> &'static str {
        match self {
            Form::Text => "Copies the path as text: settings, nested sum, every term",
            Form::Latex => "Copies the nested sum with its numbers as LaTeX",
            Form::Samples => "Copies the samples of the pixel as CSV, with running mean and variance",
        }
    }

    /// The form of a file by its extension.
    pub(in crate::viewer) fn of_extension(extension: &str) -> Option<Form> {
        match extension.to_ascii_lowercase().as_str() {
            "txt" => Some(Form::Text),
            "tex" => Some(Form::Latex),
            "csv" => Some(Form::Samples),
            _ => None,
        }
    }
}

impl App {
    /// Buttons that copy or save the path, or the samples of the pixel.
    pub(super) fn copy_buttons(&mut self, ui: &mut Ui) {
        if self.inspector.replay().is_none() {
            return;
        }
        let has_samples = self.inspector.samples().is_some_and(|samples| !samples.is_empty());
        ui.horizontal_wrapped(|ui| {
            ui.label("Copy");
            for form in Form::ALL.into_iter().filter(|form| has_samples || *form != Form::Samples) {
                if ui.button(form.name()).on_hover_text(form.explanation()).clicked()
                    && let Some(text) = self.inspected(form)
                {
                    ui.ctx().copy_text(text);
                }
            }
            let explanation = "Saves the path as text or LaTeX, or the samples of the pixel as CSV";
            if ui.button("Save as…").on_hover_text(explanation).clicked() {
                self.open_save_dialog(Target::Path);
            }
        });
    }

    /// The path that is shown, or the samples of its pixel; `None` until they have been traced.
    pub(in crate::viewer) fn inspected(&self, form: Form) -> Option<String> {
        let (wish, (sample, replay)) = (self.link.wish()?, self.inspector.replay()?);
        let pixel = self.inspector.pixel?;
        let id = PathId { scene: &wish.scene, camera: &wish.camera, settings: &wish.settings, pixel, sample };
        match form {
            Form::Text => Some(path_text::text(&id, replay)),
            Form::Latex => Some(path_text::latex(&id, replay)),
            Form::Samples => {
                let samples = self.inspector.samples().filter(|samples| !samples.is_empty())?;
                let mut table = SampleTable::default();
                table.extend(0, samples);
                Some(table.csv())
            }
        }
    }
}
