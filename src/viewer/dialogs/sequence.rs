//! The dialog that renders a turntable or a camera path as numbered images.
use std::path::{Path, PathBuf};

use egui::{Align, Align2, Button, DragValue, Layout, RichText, Ui};
use noisefall_base::file::numbered;
use noisefall_render::render::image_file::check_target;
use noisefall_scene::scene::CameraSequence;

use super::question::{Choice, ask, hold_keyboard};
use crate::viewer::background::sequence_task::ExistingFrames;
use crate::viewer::widgets::{
    path_field::PathField,
    style::{choices, controls, row},
};

const DEFAULT_FRAMES: u32 = 36;
const DEFAULT_SPP: u32 = 64;

/// The source of the cameras.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CameraSource {
    Turntable,
    Path,
}

const SOURCES: [(CameraSource, &str, &str); 2] = [
    (CameraSource::Turntable, "Turntable", "Turns the camera once around its look-at point."),
    (CameraSource::Path, "Camera path", "Follows the cameras of a TOML file."),
];

/// Asks for the frames and their files.
pub struct SequenceDialog {
    source: CameraSource,
    frames: u32,
    spp: u32,
    path: PathField,
    files: PathField,
}

/// Frames to render, and their files.
pub struct SequenceAnswer {
    pub cameras: CameraSequence,
    pub spp: u32,
    pub files: PathBuf,
}

impl SequenceDialog {
    /// A dialog that suggests a name after the scene, and the samples at which the render stops.
    pub fn new(scene: Option<&Path>, spp: Option<u32>) -> SequenceDialog {
        let stem = scene.and_then(Path::file_stem).map_or_else(|| "frame".into(), |stem| stem.to_string_lossy());
        let files = std::env::current_dir().unwrap_or_default().join(format!("{stem}-####.png"));
        SequenceDialog {
            source: CameraSource::Turntable,
            frames: DEFAULT_FRAMES,
            spp: spp.unwrap_or(DEFAULT_SPP).max(1),
            path: PathField::new(String::new(), "path/to/cameras.toml"),
            files: PathField::new(files.display().to_string(), "path/to/frame-####.png"),
        }
    }

    /// Returns the answer in the fields. A field with a wrong path shows the error.
    fn answer(&mut self) -> Option<SequenceAnswer> {
        let files = self.files.path()?;
        let checked = match numbered(&files, 1) {
            Some(first) => check_target(&first).map_err(|error| error.to_string()),
            None => Err("The name needs # for the number, such as frame-####.png.".to_owned()),
        };
        self.files.refusal = checked.err();
        let cameras = match self.source {
            CameraSource::Turntable => CameraSequence::Turntable(self.frames),
            CameraSource::Path => {
                let path = self.path.path().filter(|path| path.is_file());
                self.path.refusal = path.is_none().then(|| "There is no such file.".to_owned());
                CameraSequence::Path(path?)
            }
        };
        self.files.refusal.is_none().then_some(SequenceAnswer { cameras, spp: self.spp, files })
    }
}

/// Shows the dialog until it is answered. Returns what to render.
pub fn show(ctx: &egui::Context, dialog: &mut Option<SequenceDialog>) -> Option<SequenceAnswer> {
    let mut asked = dialog.take()?;
    let (mut open, mut renders, mut cancelled) = (true, false, false);
    egui::Window::new("Render turntable")
        .open(&mut open)
        .collapsible(false)
        .resizable(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| (renders, cancelled) = dialog_body(ui, &mut asked));
    let answer = if renders { asked.answer() } else { None };
    if answer.is_none() && open && !cancelled {
        *dialog = Some(asked);
    }
    answer
}

/// Returns whether to render, and whether to close.
fn dialog_body(ui: &mut Ui, asked: &mut SequenceDialog) -> (bool, bool) {
    hold_keyboard(ui);
    ui.set_width(460.0);
    ui.label("Renders numbered images with the settings of the window. The main render pauses meanwhile.");
    ui.add_space(4.0);
    choices(ui, &mut asked.source, &SOURCES);
    let mut renders = false;
    controls(ui, "sequence", |ui| {
        if asked.source == CameraSource::Turntable {
            row(ui, "Frames", "Number of images of the turn", |ui, label| {
                _ = ui.add(DragValue::new(&mut asked.frames).range(2..=10_000)).labelled_by(label);
            });
        }
        row(ui, "Samples", "Samples per pixel of every image", |ui, label| {
            _ = ui.add(DragValue::new(&mut asked.spp).range(1..=16_777_216).suffix(" spp")).labelled_by(label);
        });
    });
    if asked.source == CameraSource::Path {
        ui.label("Camera path");
        _ = asked.path.show(ui);
        asked.path.remark(ui, "");
    }
    ui.label("Images: # stands for a digit of the number; PNG as displayed, or EXR");
    renders |= asked.files.show(ui);
    asked.files.remark(ui, "");
    let mut cancelled = false;
    ui.horizontal(|ui| {
        let name = asked.files.path().and_then(|path| path.file_name().map(|name| name.to_string_lossy().into_owned()));
        asked.files.browse(ui, move |dialog| name.into_iter().fold(dialog, rfd::FileDialog::set_file_name).save_file());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            renders |=
                ui.add_enabled(asked.files.path().is_some(), Button::new(RichText::new("Render frames").strong())).clicked();
            cancelled = ui.button("Cancel").clicked();
        });
    });
    (renders, cancelled)
}

/// Asks about frames whose files exist. The answer [`ExistingFrames::Ask`] renders nothing.
pub fn ask_about_existing(ctx: &egui::Context, existing: usize, frames: usize) -> Option<ExistingFrames> {
    let keep = "Renders the images that are missing.";
    let choices = [
        Choice::new("Keep them", keep, ExistingFrames::Keep),
        Choice::new("Replace them", "Renders all images.", ExistingFrames::Replace),
        Choice::new("Cancel", "Renders nothing. (Esc)", ExistingFrames::Ask),
    ];
    let explain = |ui: &mut Ui| _ = ui.label(format!("{existing} of {frames} images exist."));
    ask(ctx, "Images exist", 380.0, explain, choices, ExistingFrames::Ask)
}
