//! The reference that the image is compared with, and its sources.
use egui::{Button, DragValue, Ui};

use crate::viewer::widgets::{
    explained::Explained,
    style::{controls, elided, row_with_note},
};

/// The reference of the image.
pub enum ReferenceSource<'a> {
    /// A file or a rendered image, and its relative noise, if that is known. It may be of another camera or scene.
    Given {
        name: &'a str,
        noise: Option<f64>,
        is_in_force: bool,
    },
    Scene,
    /// The scene has one, for another camera.
    SceneElsewhere,
    None,
}

/// The command of a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReferenceCommand {
    Forget,
    Render,
    UseImage,
    Open,
}

/// The reference, and what can be done.
pub struct ReferenceRow<'a> {
    pub source: ReferenceSource<'a>,
    /// Relative noise at which the render of a reference ends.
    pub noise: &'a mut f64,
    /// One is being rendered.
    pub is_rendering: bool,
    /// Why the image cannot be the reference, if it cannot.
    pub unusable: Option<&'a str>,
}

/// Shows the row of the display panel about the reference.
pub fn row(ui: &mut Ui, reference: ReferenceRow<'_>) -> Option<ReferenceCommand> {
    let doc = "Image that the render must converge to. It gives the error, the bias and the z-scores.";
    let mut command = None;
    controls(ui, "reference", |ui| row_with_note(ui, "Reference", doc, |ui, label| command = show(ui, reference, label)));
    command
}

/// Shows the reference and the buttons. `label` names the field.
fn show(ui: &mut Ui, reference: ReferenceRow<'_>, label: egui::Id) -> Option<ReferenceCommand> {
    let ReferenceRow { source, noise, is_rendering, unusable } = reference;
    let column = ui.vertical(|ui| {
        let forgets = ui.horizontal(|ui| show_source(ui, &source)).inner.then_some(ReferenceCommand::Forget);
        let renders = ui.horizontal(|ui| render_button(ui, noise, is_rendering, label)).inner;
        let doc = "Makes the image as it is now the reference. Compare images with another seed or other settings with it: with the \
                   same seed they share samples.";
        let uses = ui.add_enabled(unusable.is_none(), Button::new("Use this image as the reference")).on_hover_text(doc);
        let uses = uses.on_disabled_hover_text(unusable.unwrap_or_default()).clicked();
        let opens = ui.button("Open reference…").on_hover_text("Opens a linear image (EXR, HDR) of the same size.").clicked();
        let chosen = [(renders, ReferenceCommand::Render), (uses, ReferenceCommand::UseImage), (opens, ReferenceCommand::Open)];
        forgets.or(chosen.into_iter().find(|(is_clicked, _)| *is_clicked).map(|(_, command)| command))
    });
    column.inner
}

fn render_button(ui: &mut Ui, noise: &mut f64, is_rendering: bool, label: egui::Id) -> bool {
    let doc = "Renders the scene without bias, with samples of its own, until its estimated error is as low as this. It goes on beside the image, \
               and can be stopped and continued.";
    let button = ui.add_enabled(!is_rendering, Button::new("Render a reference")).on_hover_text(doc);
    let is_clicked = button.on_disabled_hover_text("It is being rendered: see the line at the bottom.").clicked();
    let (mut percent, now) = (100.0 * *noise, 100.0 * *noise);
    let field = DragValue::new(&mut percent).range(0.01..=50.0).speed(0.02).max_decimals(2);
    let field = ui.add(Explained::new(field, now).suffix(" %")).labelled_by(label);
    if field.on_hover_text("Estimated error at which the reference is done.").changed() {
        *noise = percent / 100.0;
    }
    is_clicked
}

/// Says what the reference is. Returns whether it is to be forgotten.
fn show_source(ui: &mut Ui, source: &ReferenceSource) -> bool {
    match source {
        ReferenceSource::Given { name, noise, is_in_force } => {
            elided(ui, 96.0, *name);
            let (text, doc) = match (is_in_force, noise) {
                (false, _) => ("elsewhere".to_owned(), "It is of another camera or scene than the image."),
                (true, Some(noise)) => (
                    format!("estimated error {:.2} %", 100.0 * noise),
                    "The error of the reference itself. Errors near it are partly its own.",
                ),
                (true, None) => {
                    ("estimated error unknown".to_owned(), "The file does not state its error and is assumed to be exact.")
                }
            };
            ui.weak(text).on_hover_text(doc);
            return ui.small_button("Remove").on_hover_text("Returns to the reference of the scene, if it has one.").clicked();
        }
        ReferenceSource::Scene => ui.weak("from the scene"),
        ReferenceSource::SceneElsewhere => ui.weak("for the scene's camera only (Home)"),
        ReferenceSource::None => ui.weak("none"),
    };
    false
}
