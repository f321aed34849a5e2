//! The choice of a view, and what an image is compared with.
use std::sync::Arc;

use egui::{ComboBox, Ui};
use noisefall::render::{Frame, colour_map::ColourMap, view::View};

use crate::viewer::widgets::{
    list::{explained, value_entry},
    style::{choices, controls, elided, row},
};

/// The reference of the picture.
pub enum ReferenceSource<'a> {
    /// A file that was dropped on the window.
    Dropped(&'a str),
    Scene,
    /// The scene has one, for another camera.
    SceneElsewhere,
    None,
}

/// The list of views.
pub fn choice(ui: &mut Ui, view: &mut View) {
    let combo = ComboBox::from_id_salt("View").selected_text(view.title()).width(150.0).height(400.0).show_ui(ui, |ui| {
        for of in View::ALL {
            explained(value_entry(ui, view, of, of.title()), of.word().doc);
        }
    });
    let label = ui.label("View").on_hover_text("Quantity to display. Changing it does not restart the render. (V)");
    combo.response.labelled_by(label.id);
}

/// Shows the rows of the display panel about views. Returns whether the dropped reference is to be forgotten.
pub fn rows(
    ui: &mut Ui,
    map: &mut ColourMap,
    shown: Option<&Arc<Frame>>,
    pinned: &mut Option<Arc<Frame>>,
    reference: &ReferenceSource,
) -> bool {
    let mut drops = false;
    controls(ui, "views", |ui| {
        row(ui, "Colours", "Colour map of numeric views. Differences and z-scores have their own.", |ui, _| {
            choices(ui, map, &ColourMap::CHOICE);
        });
        row(ui, "Pinned", "The view Difference subtracts the pinned image.", |ui, _| {
            ui.horizontal(|ui| {
                let can = shown.is_some_and(|frame| !frame.is_coarse());
                if ui.add_enabled(can, egui::Button::new("Pin this")).clicked() {
                    *pinned = shown.cloned();
                }
                match pinned {
                    Some(pinned) => {
                        drop(ui.weak(format!("{} spp", pinned.spp)).on_hover_text("Samples per pixel of the pinned image."));
                    }
                    None => drop(ui.weak("none")),
                }
            });
        });
        row(ui, "Reference", "Image that the render must converge to. It gives the true error and the z-scores.", |ui, _| {
            drops = reference_row(ui, reference);
        });
    });
    drops
}

fn reference_row(ui: &mut Ui, reference: &ReferenceSource) -> bool {
    let row = ui.horizontal(|ui| {
        match reference {
            ReferenceSource::Dropped(name) => {
                elided(ui, 120.0, *name);
                return ui.small_button("Drop").on_hover_text("Returns to the reference of the scene.").clicked();
            }
            ReferenceSource::Scene => ui.weak("from the scene"),
            ReferenceSource::SceneElsewhere => ui.weak("for the scene's camera only (Home)"),
            ReferenceSource::None => {
                ui.weak("none; drop an EXR here").on_hover_text("A reference is a linear image of the same size.")
            }
        };
        false
    });
    row.inner
}

/// The view after this one, or before it.
pub fn next(view: View, back: bool) -> View {
    let count = View::ALL.len();
    let at = View::ALL.iter().position(|other| *other == view).unwrap_or(0);
    View::ALL[(at + if back { count - 1 } else { 1 }) % count]
}
