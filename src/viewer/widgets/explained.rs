//! A number field or slider that takes arithmetic. Below it stands why it refused a text.
use std::{cell::RefCell, rc::Rc};

use egui::{DragValue, Response, Slider, Ui, Widget};

use super::{arithmetic::evaluate, given_up::gave_up, refusal};

/// A field that parses typed texts by a function, once they are entered.
pub trait Typed: Widget {
    fn parsed_by(self, parse: impl Fn(&str) -> Option<f64> + 'static) -> Self;
    fn with_suffix(self, suffix: &str) -> Self;
}

impl Typed for DragValue<'_> {
    fn parsed_by(self, parse: impl Fn(&str) -> Option<f64> + 'static) -> Self {
        self.custom_parser(parse).update_while_editing(false)
    }

    fn with_suffix(self, suffix: &str) -> Self {
        self.suffix(suffix)
    }
}

impl Typed for Slider<'_> {
    fn parsed_by(self, parse: impl Fn(&str) -> Option<f64> + 'static) -> Self {
        self.custom_parser(parse).update_while_editing(false)
    }

    fn with_suffix(self, suffix: &str) -> Self {
        self.suffix(suffix)
    }
}

/// The field, and what its messages need to know.
pub struct Explained<W> {
    field: W,
    value: f64,
    suffix: String,
}

impl<W: Typed> Explained<W> {
    /// A field that has a value.
    pub fn new(field: W, value: f64) -> Explained<W> {
        Explained { field, value, suffix: String::new() }
    }

    /// Shows a unit behind the number. It may be typed too.
    pub fn suffix(self, suffix: &str) -> Explained<W> {
        Explained { field: self.field.with_suffix(suffix), suffix: suffix.trim().to_owned(), ..self }
    }
}

impl<'a> Explained<DragValue<'a>> {
    /// Sets the change per point of a drag.
    pub fn speed(self, speed: f64) -> Explained<DragValue<'a>> {
        Explained { field: self.field.speed(speed), ..self }
    }
}

impl<'a> Explained<Slider<'a>> {
    /// Makes the slider logarithmic.
    pub fn logarithmic(self, is_logarithmic: bool) -> Explained<Slider<'a>> {
        Explained { field: self.field.logarithmic(is_logarithmic), ..self }
    }
}

impl<W: Typed> Widget for Explained<W> {
    fn ui(self, ui: &mut Ui) -> Response {
        let Explained { field, value, suffix } = self;
        // A slider answers by the identity of its number field while that has the keyboard.
        let id = ui.next_auto_id();
        let refused = Rc::new(RefCell::new(None));
        let note = refused.clone();
        let is_given_up = gave_up(ui);
        let parse = move |text: &str| {
            if is_given_up {
                return None;
            }
            let number = evaluate(without(text, &suffix));
            number.map_err(|refusal| *note.borrow_mut() = Some(refusal)).ok()
        };
        let response = ui.add(field.parsed_by(parse));
        if let Some(message) = refused.take() {
            refusal::remember(ui, id, value, message);
        }
        if let Some(message) = refusal::of(ui, id, value) {
            refusal::show_below(ui, &response, &message);
        }
        response
    }
}

/// The text without a unit at its end.
pub fn without<'t>(text: &'t str, unit: &str) -> &'t str {
    let text = text.trim();
    if unit.is_empty() { text } else { text.strip_suffix(unit).unwrap_or(text).trim_end() }
}

#[cfg(test)]
mod tests {
    use egui::{Event, Key, Modifiers, accesskit::Role};
    use egui_kittest::{Harness, kittest::Queryable};

    use super::*;

    type Fields = Harness<'static, [f64; 2]>;

    fn fields() -> Fields {
        let draw = |ui: &mut Ui, state: &mut [f64; 2]| {
            let [first, second] = state;
            for (number, name, unit) in [(first, "Length", " m"), (second, "Count", "")] {
                let (label, value) = (ui.label(name).id, *number);
                ui.add(Explained::new(DragValue::new(number), value).suffix(unit)).labelled_by(label);
            }
        };
        Harness::builder().with_size(egui::vec2(400.0, 300.0)).build_ui_state(draw, [1.0, 2.0])
    }

    fn type_in(fields: &mut Fields, place: usize, text: &str) {
        fields.get_all_by_role(Role::SpinButton).nth(place).expect("there are two").click();
        fields.run_steps(4);
        fields.key_press_modifiers(Modifiers::COMMAND, Key::A);
        fields.event(Event::Text(text.to_owned()));
        fields.run_steps(3);
        fields.key_press(Key::Enter);
        fields.run_steps(3);
    }

    const REFUSAL: &str = "expected a number, found “far”";

    fn explains(fields: &Fields) -> bool {
        fields.query_by_label(REFUSAL).is_some()
    }

    #[test]
    fn arithmetic_and_units_are_typed() {
        let mut fields = fields();
        for (text, value) in [("3/2", 1.5), ("0,25 m", 0.25), ("2*0.25", 0.5)] {
            type_in(&mut fields, 0, text);
            assert_eq!(fields.state()[0], value, "{text}");
        }
    }

    #[test]
    fn an_edit_that_is_given_up_is_neither_taken_nor_refused() {
        let mut fields = fields();
        for text in ["far", "7"] {
            fields.get_all_by_role(Role::SpinButton).next().expect("there are two").click();
            fields.run_steps(4);
            fields.key_press_modifiers(Modifiers::COMMAND, Key::A);
            fields.event(Event::Text(text.to_owned()));
            fields.run_steps(3);
            fields.key_press(Key::Escape);
            fields.run_steps(4);
            assert!(fields.query_by_label_contains("expected a number").is_none() && *fields.state() == [1.0, 2.0], "{text}");
        }
    }

    #[test]
    fn a_refusal_ends_with_the_next_edit_of_any_field_and_with_another_value() {
        let mut fields = fields();
        for place in [0, 1] {
            type_in(&mut fields, 0, "far");
            fields.run_steps(5);
            assert!(explains(&fields) && *fields.state() == [1.0, 2.0], "it stays while nothing is done");
            fields.get_all_by_role(Role::SpinButton).nth(place).expect("there are two").click();
            fields.run_steps(4);
            assert!(!explains(&fields), "field {place}");
            fields.key_press(Key::Escape);
            fields.run_steps(3);
        }
        type_in(&mut fields, 0, "far");
        assert!(explains(&fields));
        fields.state_mut()[0] = 3.0;
        fields.run_steps(3);
        assert!(!explains(&fields));
    }
}
