//! Number fields. A click into a field changes nothing, and Escape discards an edit. Typed arithmetic is evaluated.
use std::ops::RangeInclusive;

use egui::{
    DragValue, Id, Slider, SliderClamping, Ui,
    emath::{Numeric, format_with_decimals_in_range},
};

use super::{decimals::unsigned_zero, explained::Explained, given_up::gave_up};

/// Significant digits of a number that was dragged.
const DRAGGED_DIGITS: usize = 12;

/// A field for a number with a number of decimals. It explains why it refuses a text.
pub fn field<'a, N: Numeric>(ui: &Ui, value: &'a mut N, decimals: usize, range: RangeInclusive<f64>) -> Explained<DragValue<'a>> {
    let now = value.to_f64();
    Explained::new(plain_field(ui, value, decimals, range), now)
}

/// A field for a number without explanations.
pub fn plain_field<'a, N: Numeric>(ui: &Ui, value: &'a mut N, decimals: usize, range: RangeInclusive<f64>) -> DragValue<'a> {
    let field = DragValue::from_get_set(kept(value, decimals, range.clone(), gave_up(ui)));
    let field = field.max_decimals(decimals).range(range).clamp_existing_to_range(false).update_while_editing(false);
    field.custom_formatter(shown)
}

/// A slider with a number field.
pub fn slider<'a, N: Numeric>(ui: &Ui, value: &'a mut N, decimals: usize, range: RangeInclusive<f64>) -> Explained<Slider<'a>> {
    let now = value.to_f64();
    let slider = Slider::from_get_set(range.clone(), kept(value, decimals, range, gave_up(ui)));
    let slider = slider.max_decimals(decimals).clamping(SliderClamping::Edits).update_while_editing(false);
    Explained::new(slider.custom_formatter(shown), now)
}

/// A number that was dragged, without the digits that come from rounding: 0.57 and not 0.5700000000000001, 0 and not −0.
pub fn tidy(x: f64) -> f64 {
    let digits = DRAGGED_DIGITS - 1;
    format!("{x:.digits$e}").parse().unwrap_or(x) + 0.0
}

/// The text of a number. What rounds to zero has no sign.
fn shown(x: f64, decimals: RangeInclusive<usize>) -> String {
    unsigned_zero(format_with_decimals_in_range(x, decimals))
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
            *value = N::from_f64(new + 0.0);
        }
        value.to_f64()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_round_to_zero_have_no_sign() {
        assert_eq!([-0.000_4, -0.0, -0.001, 2.5].map(|x| shown(x, 3..=3)), ["0.000", "0.000", "-0.001", "2.500"]);
        assert_eq!(shown(-1e-17, 0..=3), "0");
    }

    #[test]
    fn a_dragged_number_has_no_digits_of_rounding() {
        assert_eq!([0.44 + 0.13, 0.1 + 0.2, 1.1 * 3.0, 1e-9, 123_456.75].map(tidy), [0.57, 0.3, 3.3, 1e-9, 123_456.75]);
        assert!(tidy(-0.0).is_sign_positive() && tidy(-2.5) == -2.5);
    }
}
