//! Number fields. A click into a field changes nothing, and Escape discards an edit.
use std::ops::RangeInclusive;

use egui::{
    DragValue, Id, Key, Slider, SliderClamping, Ui,
    emath::{Numeric, format_with_decimals_in_range},
};

/// A field for a number with a number of decimals.
pub fn field<'a, N: Numeric>(ui: &Ui, value: &'a mut N, decimals: usize, range: RangeInclusive<f64>) -> DragValue<'a> {
    let field = DragValue::from_get_set(kept(value, decimals, range.clone(), gave_up(ui)));
    field.max_decimals(decimals).range(range).clamp_existing_to_range(false).update_while_editing(false)
}

/// A slider with a number field.
pub fn slider<'a, N: Numeric>(ui: &Ui, value: &'a mut N, decimals: usize, range: RangeInclusive<f64>) -> Slider<'a> {
    let slider = Slider::from_get_set(range.clone(), kept(value, decimals, range, gave_up(ui)));
    slider.max_decimals(decimals).clamping(SliderClamping::Edits).update_while_editing(false)
}

/// A field for an optional number, with a text for `None` and a suffix.
pub fn optional<N: Numeric>(
    ui: &mut Ui,
    label: Id,
    value: &mut Option<N>,
    (none, unit): (&str, &str),
    default: N,
    decimals: usize,
    range: RangeInclusive<f64>,
) {
    ui.horizontal(|ui| {
        let mut present = value.is_some();
        if ui.checkbox(&mut present, "").labelled_by(label).changed() {
            *value = present.then_some(default);
        }
        match value {
            Some(number) => {
                let field = field(ui, number, decimals, range);
                ui.add(field).labelled_by(label);
                ui.weak(if number.to_f64() == 1.0 { unit.trim_end_matches('s') } else { unit });
            }
            None => drop(ui.weak(none)),
        }
    });
}

/// Reads and writes a value. A field shows it rounded and returns the rounded value even without an edit, so a value that rounds
/// to the same text does not count as an edit.
fn kept<N: Numeric>(value: &mut N, decimals: usize, range: RangeInclusive<f64>, gave_up: bool) -> impl FnMut(Option<f64>) -> f64 {
    move |new| {
        let old = value.to_f64();
        let shown = |least: usize| format_with_decimals_in_range(old, least..=decimals).parse::<f64>().unwrap_or(old);
        let is_shown = |new: f64| (0..=decimals).any(|least| shown(least).clamp(*range.start(), *range.end()) == new);
        if let Some(new) = new.filter(|new| !gave_up && !is_shown(*new)) {
            *value = N::from_f64(new);
        }
        value.to_f64()
    }
}

/// Whether Escape was pressed in this frame or the last one, because egui applies the typed text in the frame after Escape.
fn gave_up(ui: &Ui) -> bool {
    let (frame, escape) = (ui.ctx().cumulative_frame_nr(), ui.input(|input| input.key_pressed(Key::Escape)));
    ui.data_mut(|data| {
        let until = data.get_temp_mut_or_default::<u64>(Id::unique("edits were given up"));
        if escape {
            *until = frame + 2;
        }
        frame < *until
    })
}
