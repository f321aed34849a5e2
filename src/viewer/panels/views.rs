//! The choice of a view, and the image that a difference is to.
use std::sync::Arc;

use egui::{ComboBox, Ui};
use noisefall_render::render::{Frame, colour_map::ColourMap, view::View};

use crate::viewer::widgets::{
    list::{explained, value_entry},
    style::{choices, controls, row},
};

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

/// Shows the rows of the display panel about views.
pub fn rows(ui: &mut Ui, map: &mut ColourMap, shown: Option<&Arc<Frame>>, pinned: &mut Option<Arc<Frame>>) {
    controls(ui, "views", |ui| {
        row(ui, "Colours", "Colour map of numeric views. Differences and z-scores have their own.", |ui, _| {
            choices(ui, map, &ColourMap::CHOICE);
        });
        row(ui, "Pinned", "The view Difference subtracts the pinned image, or the reference if none is pinned.", |ui, _| {
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
    });
}

/// The view after this one, or before it.
pub fn next(view: View, back: bool) -> View {
    let count = View::ALL.len();
    let at = View::ALL.iter().position(|other| *other == view).unwrap_or(0);
    View::ALL[(at + if back { count - 1 } else { 1 }) % count]
}
