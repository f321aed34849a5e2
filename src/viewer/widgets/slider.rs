//! The behaviour of all sliders: Shift drags ten times as slowly, and a double click resets.
use std::ops::RangeInclusive;

use egui::{PointerButton, Pos2, Rect, Response, Ui, emath::Numeric, vec2};

/// The part of a move that a slow drag takes.
const SLOW: f64 = 0.1;

/// The scale of a slider.
#[derive(Clone, Debug)]
pub struct Scale {
    pub range: RangeInclusive<f64>,
    pub is_logarithmic: bool,
}

/// A drag that moves the value from where it was, and not to the pointer.
#[derive(Clone, Copy, Default)]
struct SlowDrag {
    /// The value at the pointer, and that of the slider, when the drag became so fast.
    at_pointer: f64,
    value: f64,
    speed: f64,
}

impl Scale {
    pub fn linear(range: RangeInclusive<f64>) -> Scale {
        Scale { range, is_logarithmic: false }
    }

    /// The value after a part of a move.
    fn moved(&self, drag: &SlowDrag, at_pointer: f64) -> f64 {
        if self.is_logarithmic && [drag.value, drag.at_pointer, at_pointer].iter().all(|x| *x > 0.0) {
            return drag.value * (at_pointer / drag.at_pointer).powf(drag.speed);
        }
        drag.value + (at_pointer - drag.at_pointer) * drag.speed
    }
}

/// Shows a slider that `add` adds, with or without a number field behind it. A double click on the slider gives its value `default`.
pub fn show<N: Numeric>(
    ui: &mut Ui,
    value: &mut N,
    scale: &Scale,
    default: N,
    add: impl FnOnce(&mut Ui, &mut N) -> Response,
) -> Response {
    let (response, is_reset) = show_resettable(ui, value, scale, add);
    if is_reset {
        *value = default;
    }
    response
}

/// Shows a slider whose default takes time to find. Returns whether the default is requested.
pub fn show_resettable<N: Numeric>(
    ui: &mut Ui,
    value: &mut N,
    scale: &Scale,
    add: impl FnOnce(&mut Ui, &mut N) -> Response,
) -> (Response, bool) {
    let before = value.to_f64();
    let response = add(ui, value).on_hover_text("Shift drags slowly. A double click resets.");
    let rail = Rect::from_min_size(response.rect.min, vec2(ui.spacing().slider_width, response.rect.height()));
    let is_on_rail = |at: Option<Pos2>| at.is_some_and(|at| rail.contains(at));
    let id = response.id.with("slow drag");
    let (is_down, is_slow, is_double) = ui.input(|input| {
        let pointer = &input.pointer;
        let is_down = pointer.primary_down() && is_on_rail(pointer.press_origin());
        let is_double = pointer.button_double_clicked(PointerButton::Primary) && is_on_rail(pointer.interact_pos());
        (is_down, input.modifiers.shift, is_double)
    });
    if !is_down || !response.is_pointer_button_down_on() {
        // In the frame of the release, egui moves the value to the pointer once more.
        if ui.data_mut(|data| data.remove_temp::<SlowDrag>(id)).is_some() {
            *value = N::from_f64(before);
        }
        return (response.clone(), is_double && response.contains_pointer() && response.enabled());
    }
    // A value beyond the ends of the slider stays there until it is dragged back.
    let (at_pointer, is_beyond) = (value.to_f64(), !scale.range.contains(&before));
    let drag = ui.data(|data| data.get_temp::<SlowDrag>(id));
    if drag.is_some() || is_slow || is_beyond {
        let speed = if is_slow { SLOW } else { 1.0 };
        let begun = SlowDrag { at_pointer, value: before, speed };
        let drag = drag.filter(|drag| drag.speed == speed).unwrap_or(begun);
        ui.data_mut(|data| data.insert_temp(id, drag));
        *value = N::from_f64(scale.moved(&drag, at_pointer));
    }
    (response, false)
}

#[cfg(test)]
mod tests {
    use egui::{Event, Modifiers, Slider, accesskit::Role};
    use egui_kittest::{Harness, kittest::Queryable};

    use super::*;

    const WIDTH: f32 = 120.0;

    fn slider(start: f64) -> Harness<'static, f64> {
        let draw = |ui: &mut Ui, x: &mut f64| {
            ui.spacing_mut().slider_width = WIDTH;
            show(ui, x, &Scale::linear(-6.0..=6.0), 0.5, |ui, x| {
                ui.add(Slider::new(x, -6.0..=6.0).clamping(egui::SliderClamping::Edits))
            });
        };
        Harness::builder().with_size(vec2(400.0, 100.0)).with_step_dt(1.0 / 60.0).build_ui_state(draw, start)
    }

    fn rail(slider: &Harness<'static, f64>) -> Rect {
        let rect = slider.get_by_role(Role::Slider).rect();
        Rect::from_min_size(rect.min, vec2(WIDTH, rect.height()))
    }

    /// Presses at a point of the rail, moves by some points, and releases.
    fn drag(slider: &mut Harness<'static, f64>, from: Pos2, by: f32, modifiers: Modifiers) {
        let button = |pos, pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers };
        slider.event(Event::ModifiersChanged(modifiers));
        slider.hover_at(from);
        slider.run_steps(2);
        slider.event(button(from, true));
        slider.run_steps(2);
        let to = from + vec2(by, 0.0);
        slider.hover_at(to);
        slider.run_steps(2);
        slider.event(button(to, false));
        slider.run_steps(2);
        slider.event(Event::ModifiersChanged(Modifiers::NONE));
        slider.run_steps(1);
    }

    #[test]
    fn shift_drags_slowly_from_where_the_value_was() {
        let mut slider = slider(0.0);
        let middle = rail(&slider).center();
        drag(&mut slider, middle, 30.0, Modifiers::SHIFT);
        let slow = *slider.state();
        assert!((0.2..0.5).contains(&slow), "{slow}");
        drag(&mut slider, middle, 30.0, Modifiers::NONE);
        assert!((2.5..4.5).contains(slider.state()), "{}", slider.state());
    }

    #[test]
    fn a_value_beyond_the_end_does_not_jump_to_the_pointer() {
        let mut slider = slider(-12.0);
        let middle = rail(&slider).center();
        drag(&mut slider, middle, 20.0, Modifiers::NONE);
        assert!((-11.0..-9.0).contains(slider.state()), "{}", slider.state());
    }

    #[test]
    fn a_double_click_resets() {
        let mut slider = slider(4.0);
        let middle = rail(&slider).center();
        slider.hover_at(middle);
        slider.run_steps(2);
        for pressed in [true, false, true, false] {
            slider.event(Event::PointerButton {
                pos: middle,
                button: PointerButton::Primary,
                pressed,
                modifiers: Modifiers::NONE,
            });
            slider.step();
        }
        slider.run_steps(2);
        assert_eq!(*slider.state(), 0.5);
    }

    #[test]
    fn a_slow_drag_of_a_logarithmic_slider_multiplies() {
        let scale = Scale { range: 0.01..=100.0, is_logarithmic: true };
        let drag = SlowDrag { at_pointer: 1.0, value: 2.0, speed: 0.5 };
        assert!((scale.moved(&drag, 100.0) - 20.0).abs() < 1e-12);
        assert_eq!(scale.moved(&SlowDrag { value: 0.0, ..drag }, 3.0), 1.0);
    }
}
