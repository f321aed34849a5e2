//! Exposure, white balance and tone map. None of them restarts the render.
use egui::{Button, ComboBox, DragValue, Slider, SliderClamping, Ui};
use noisefall_render::render::{Display, ToneMap, WhiteBalance};

use crate::viewer::widgets::{
    explained::Explained,
    list::{explained, value_entry},
    slider::{self, Scale},
    style::{controls, row},
};

/// The stops of the slider, from end to end, and its width in points. Its field takes all numbers.
const LEAST: f64 = -5.0;
const MOST: f64 = 5.0;
const EXPOSURE_WIDTH: f32 = 140.0;

/// A double click gives the exposure its default.
pub fn show(ui: &mut Ui, display: &mut Display, default_exposure: f32) {
    controls(ui, "display", |ui| {
        row(ui, "Exposure", "Exposure in stops. One more doubles the brightness. ([ and ])", |ui, label| {
            let now = display.exposure.into();
            ui.spacing_mut().slider_width = EXPOSURE_WIDTH;
            slider::show(ui, &mut display.exposure, &Scale::linear(LEAST..=MOST), default_exposure, |ui, exposure| {
                let slider = Slider::new(exposure, LEAST as f32..=MOST as f32).fixed_decimals(2).drag_value_speed(0.02);
                let slider = slider.clamping(SliderClamping::Edits);
                ui.add(Explained::new(slider, now).suffix(" EV")).labelled_by(label)
            });
        });
        white_balance(ui, &mut display.white_balance);
        row(ui, "Tone map", "Maps radiance, which has no upper bound, to display light.", |ui, label| {
            let tone_map = &mut display.tone_map;
            let combo = ComboBox::from_id_salt("Tone map").selected_text(tone_map.title()).show_ui(ui, |ui| {
                for (map, word) in ToneMap::ALL.map(|map| (map, map.word())) {
                    explained(value_entry(ui, tone_map, map, word.title), word.doc);
                }
            });
            combo.response.labelled_by(label);
        });
    });
    ui.add_space(8.0);
}

/// One row: the panel has no room for more.
fn white_balance(ui: &mut Ui, balance: &mut WhiteBalance) {
    let range = |[low, high]: [f32; 2]| low..=high;
    let doc = "The light that appears white: its colour temperature and its tint. Applied before the tone map.";
    row(ui, "White balance", doc, |ui, label| {
        ui.horizontal(|ui| {
            let now = balance.kelvin.into();
            let kelvin = DragValue::new(&mut balance.kelvin).range(range(WhiteBalance::KELVIN)).speed(20.0).fixed_decimals(0);
            let kelvin = ui.add(Explained::new(kelvin, now).suffix(" K")).labelled_by(label);
            kelvin.on_hover_text("Colour temperature of white light in kelvin. Lower values make the image bluer.");
            let now = balance.tint.into();
            let tint = DragValue::new(&mut balance.tint).range(range(WhiteBalance::TINT)).speed(0.5).fixed_decimals(0);
            let tint = ui.add(Explained::new(tint, now)).labelled_by(label);
            tint.on_hover_text("Tint. Shifts the image from green (negative) to magenta (positive).");
            let reset = ui.add_enabled(*balance != WhiteBalance::NEUTRAL, Button::new("Neutral"));
            if reset.on_hover_text("Resets the white balance: colours stay as they are.").clicked() {
                *balance = WhiteBalance::NEUTRAL;
            }
        });
    });
}
