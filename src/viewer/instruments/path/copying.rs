//! Copies a path or the samples of a pixel, and writes them for a file.
use egui::Ui;
use noisefall_render::render::{
    RenderRequest,
    path_samples::SampleTable,
    path_text::{self, PathId},
};

use super::inspector::PathInspector;

/// The form in which a path or the samples of its pixel leave the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathForm {
    Text,
    Latex,
    Samples,
}

impl PathForm {
    const ALL: [PathForm; 3] = [PathForm::Text, PathForm::Latex, PathForm::Samples];

    fn name(self) -> &'static str {
        match self {
            PathForm::Text => "Text",
            PathForm::Latex => "LaTeX",
            PathForm::Samples => "Samples",
        }
    }

    fn explanation(self) -> &'static str {
        match self {
            PathForm::Text => "Copies the path as text: settings, nested sum, every term",
            PathForm::Latex => "Copies the nested sum with its numbers as LaTeX",
            PathForm::Samples => "Copies the samples of the pixel as CSV, with running mean and variance",
        }
    }

    /// The form of a file by its extension.
    pub fn of_extension(extension: &str) -> Option<PathForm> {
        match extension.to_ascii_lowercase().as_str() {
            "txt" => Some(PathForm::Text),
            "tex" => Some(PathForm::Latex),
            "csv" => Some(PathForm::Samples),
            _ => None,
        }
    }
}

/// Shows buttons that copy or save the path, or the samples of the pixel. Returns whether to save.
pub fn show(ui: &mut Ui, inspector: &PathInspector, request: &RenderRequest) -> bool {
    if inspector.replay().is_none() {
        return false;
    }
    let has_samples = inspector.samples().is_some_and(|samples| !samples.is_empty());
    let mut saves = false;
    ui.horizontal_wrapped(|ui| {
        ui.label("Copy");
        for form in PathForm::ALL.into_iter().filter(|form| has_samples || *form != PathForm::Samples) {
            if ui.button(form.name()).on_hover_text(form.explanation()).clicked()
                && let Some(text) = written(inspector, request, form)
            {
                ui.ctx().copy_text(text);
            }
        }
        let explanation = "Saves the path as text or LaTeX, or the samples of the pixel as CSV";
        saves = ui.button("Save as…").on_hover_text(explanation).clicked();
    });
    saves
}

/// The path that is shown, or the samples of its pixel; `None` until they have been traced.
pub fn written(inspector: &PathInspector, request: &RenderRequest, form: PathForm) -> Option<String> {
    let ((sample, replay), pixel) = (inspector.replay()?, inspector.pixel?);
    let id = PathId { scene: &request.scene, camera: &request.camera, settings: &request.settings, pixel, sample };
    match form {
        PathForm::Text => Some(path_text::text(&id, replay)),
        PathForm::Latex => Some(path_text::latex(&id, replay)),
        PathForm::Samples => {
            let samples = inspector.samples().filter(|samples| !samples.is_empty())?;
            let mut table = SampleTable::default();
            table.extend(0, samples);
            Some(table.csv())
        }
    }
}
