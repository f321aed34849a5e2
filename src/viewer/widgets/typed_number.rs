//! Number fields that explain why they reject an input.
use std::{cell::RefCell, ops::RangeInclusive};

use egui::{Id, Response, Ui, Widget};

use super::{arithmetic::evaluate, explained::without, given_up::gave_up, number, quotation::with_quotation_marks, refusal};

/// A field of a number, and what it accepts.
pub struct TypedNumber<'a> {
    /// Key of the number in scene files.
    pub key: &'a str,
    pub range: RangeInclusive<f64>,
    /// Shows no decimals.
    pub is_whole: bool,
    /// Change per point of a drag.
    pub speed: f64,
    pub unit: &'a str,
    /// Width in points.
    pub width: f32,
    /// Names the field.
    pub label: Id,
    /// The error of a number, if it has one.
    pub check: &'a dyn Fn(f64) -> Option<String>,
}

/// Width of a digit in points, with its share of the margins.
const DIGIT: f32 = 12.0;

impl TypedNumber<'_> {
    /// Shows the field. It takes only numbers that are in range. Returns its message if the one that was typed last is not, until the
    /// next press of a key or a button.
    pub fn show(&self, ui: &mut Ui, value: &mut f64) -> (Response, Option<String>) {
        let before = *value;
        let refused = RefCell::new(None);
        let parse = |text: &str| {
            let parsed = evaluate(without(text, self.unit)).map_err(|why| format!("“{}”: {why}", self.key));
            let checked = parsed.and_then(|x| self.checked(x));
            checked.map_err(|refusal| *refused.borrow_mut() = Some(refusal)).ok()
        };
        let decimals = if self.is_whole { 0 } else { decimals(before, self.width) };
        let suffix = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let field = number::plain_field(ui, value, decimals, self.range.clone());
        let field = field.speed(self.speed).suffix(suffix).clip_text(true).custom_parser(parse);
        let response = sized(ui, self.width, field).labelled_by(self.label);
        // Screen readers set numbers without typing.
        let set = Some(*value).filter(|value| *value != before).and_then(|value| self.checked(value).err());
        if set.is_some() {
            *value = before;
        }
        let typed = refused.into_inner().filter(|_| !gave_up(ui));
        if let Some(message) = typed.or(set) {
            refusal::remember(ui, response.id, *value, message);
        }
        let message = refusal::of(ui, response.id, *value);
        (response, message)
    }

    fn checked(&self, x: f64) -> Result<f64, String> {
        (self.check)(x).map_or(Ok(x), |refusal| Err(with_quotation_marks(&refusal)))
    }
}

/// Decimals that a field of some width has room for.
fn decimals(value: f64, width: f32) -> usize {
    let magnitude = if value == 0.0 || !value.is_finite() { 0 } else { value.abs().log10().floor() as i32 };
    let digits = (width / DIGIT) as i32;
    (digits - 1 - magnitude).clamp(0, 15) as usize
}

fn sized(ui: &mut Ui, width: f32, field: impl Widget) -> Response {
    ui.add_sized([width, ui.spacing().interact_size.y], field)
}

#[cfg(test)]
mod tests {
    use egui::{Event, Key, Modifiers, accesskit::Role};
    use egui_kittest::{Harness, kittest::Queryable};

    use super::*;

    #[derive(Default)]
    struct State {
        value: f64,
        refusal: Option<String>,
    }

    fn field() -> Harness<'static, State> {
        let draw = |ui: &mut Ui, state: &mut State| {
            let label = ui.label("fov").id;
            let check = |x: f64| (!(1.0..=170.0).contains(&x)).then(|| format!("`fov` is out of range: {x}"));
            let (speed, width) = (0.1, 80.0);
            let (range, is_whole) = (1.0..=170.0, false);
            let field = TypedNumber { key: "fov", range, is_whole, speed, unit: "°", width, label, check: &check };
            (_, state.refusal) = field.show(ui, &mut state.value);
        };
        Harness::builder().build_ui_state(draw, State { value: 40.0, ..State::default() })
    }

    fn type_in(field: &mut Harness<'static, State>, text: &str) {
        field.get_by_role(Role::SpinButton).click();
        field.run_steps(4);
        field.key_press_modifiers(Modifiers::COMMAND, Key::A);
        field.event(Event::Text(text.to_owned()));
        field.run_steps(3);
        field.key_press(Key::Enter);
        field.run_steps(3);
    }

    #[test]
    fn a_typed_number_out_of_range_changes_nothing_and_says_so_until_the_next() {
        let mut field = field();
        type_in(&mut field, "200");
        assert_eq!((field.state().value, field.state().refusal.as_deref()), (40.0, Some("“fov” is out of range: 200")));
        type_in(&mut field, "wide");
        assert_eq!(field.state().refusal.as_deref(), Some("“fov”: expected a number, found “wide”"));
        type_in(&mut field, "55.25°");
        assert_eq!((field.state().value, field.state().refusal.as_deref()), (55.25, None));
        type_in(&mut field, " 60.5° ");
        assert_eq!((field.state().value, field.state().refusal.as_deref()), (60.5, None), "spaces do not count");
        type_in(&mut field, "55.25");
        type_in(&mut field, "−3");
        assert_eq!((field.state().value, field.state().refusal.as_deref()), (55.25, Some("“fov” is out of range: -3")));
    }

    #[test]
    fn arithmetic_and_a_decimal_comma_are_numbers() {
        let mut field = field();
        for (text, value) in [("3/2", 1.5), ("20,25", 20.25), ("2*(10 + 5.5)°", 31.0), ("1e1", 10.0)] {
            type_in(&mut field, text);
            assert_eq!((field.state().value, field.state().refusal.as_deref()), (value, None), "{text}");
        }
        type_in(&mut field, "0,25,5");
        assert!(field.state().refusal.as_ref().is_some_and(|refusal| refusal.starts_with("“fov”: expected one number")));
        assert_eq!(field.state().value, 10.0);
    }

    #[test]
    fn a_refusal_ends_when_the_field_is_edited_again() {
        let mut field = field();
        type_in(&mut field, "200");
        field.run_steps(5);
        assert!(field.state().refusal.is_some(), "it stays while nothing is done");
        field.get_by_role(Role::SpinButton).click();
        field.run_steps(4);
        assert_eq!(field.state().refusal, None);
    }

    #[test]
    fn a_screen_reader_sets_no_number_out_of_range_either() {
        let mut field = field();
        field.get_by_role(Role::SpinButton).set_value_accesskit(300.0);
        field.run_steps(3);
        assert_eq!((field.state().value, field.state().refusal.as_deref()), (40.0, Some("“fov” is out of range: 300")));
        field.get_by_role(Role::SpinButton).set_value_accesskit(60.0);
        field.run_steps(3);
        assert_eq!((field.state().value, field.state().refusal.as_deref()), (60.0, None));
    }

    #[test]
    fn small_and_large_numbers_show_their_digits() {
        assert_eq!([0.0, 1.5, 0.000_123, 123_456.0, 1e9, 1e-20].map(|x| decimals(x, 72.0)), [5, 5, 9, 0, 0, 15]);
        assert_eq!([0.725, 15.25].map(|x| decimals(x, 40.0)), [3, 1]);
    }
}
