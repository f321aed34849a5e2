//! Sliders and fields for numbers. They accept only values that the reader accepts.
use std::cell::Cell;

use egui::{Id, Response, Slider, SliderClamping, Ui};
use glam::DVec3;
use noisefall_base::declare::{CountRange, Parameter, Problem, Range, SliderScale, Value, check_value, short};

use crate::viewer::widgets::{
    number::tidy,
    refusal,
    slider::{self, Scale},
    typed_number::TypedNumber,
};

/// Largest range of a slider in powers of ten. Its field takes all numbers.
const SLIDER_LEAST: f64 = 1e-3;
const SLIDER_MOST: f64 = 1e3;

/// Widths in points.
const SLIDER_WIDTH: f32 = 76.0;
const ALONE: f32 = 72.0;
const OF_THREE: f32 = 52.0;
const OF_CHANNELS: f32 = 40.0;
const OF_FOUR: f32 = 42.0;

/// Largest count with a slider.
const FEW: u32 = 256;

/// The fields of one value.
pub struct Numbers<'a> {
    pub parameter: &'a Parameter,
    pub label: Id,
    /// Whether the default value is asked for.
    pub resets: &'a Cell<bool>,
}

impl Numbers<'_> {
    /// Shows a number, with a slider if its range is bounded. Returns the new number.
    pub fn number(&self, ui: &mut Ui, old: f64, range: &Range, value: &dyn for<'x> Fn(&'x mut f64) -> Value<'x>) -> Option<f64> {
        let parameter = self.parameter;
        let mut new = old;
        if *range != Range::FINITE {
            ui.spacing_mut().slider_width = SLIDER_WIDTH;
            let [least, most] = slider_ends(range);
            let is_logarithmic = range.scale == SliderScale::Log;
            let scale = Scale { range: least..=most, is_logarithmic };
            self.slider(ui, &mut new, &scale, |ui, new| {
                let slider = Slider::new(new, least..=most).show_value(false).clamping(SliderClamping::Edits);
                let slider = slider.logarithmic(is_logarithmic).smallest_positive(SLIDER_LEAST);
                ui.add(slider).labelled_by(self.label)
            });
            if new != old {
                new = tidy(new).clamp(range.least, range.most);
            }
        }
        let check = |mut x: f64| check_value(parameter, &value(&mut x)).map(message);
        let unit = if fits_field(self.parameter.unit) { self.parameter.unit } else { "" };
        self.field(ui, &mut new, (range.least, range.most), speed(old, range), Look { unit, ..Look::of(ALONE) }, &check);
        Some(new).filter(|new| *new != old)
    }

    /// A whole number. Returns the new one.
    pub fn count(&self, ui: &mut Ui, old: u32, range: &CountRange) -> Option<u32> {
        let parameter = self.parameter;
        let mut new = f64::from(old);
        let (least, most) = (f64::from(range.least), f64::from(range.most));
        if range.most <= FEW {
            ui.spacing_mut().slider_width = SLIDER_WIDTH;
            self.slider(ui, &mut new, &Scale::linear(least..=most), |ui, new| {
                let slider = Slider::new(new, least..=most).integer().show_value(false).clamping(SliderClamping::Edits);
                ui.add(slider).labelled_by(self.label)
            });
        }
        let check = |x: f64| check_count(parameter, x, range);
        self.field(ui, &mut new, (least, most), 0.2, Look::WHOLE, &check);
        Some(new.round() as u32).filter(|new| *new != old)
    }

    fn slider(&self, ui: &mut Ui, value: &mut f64, scale: &Scale, add: impl FnOnce(&mut Ui, &mut f64) -> Response) {
        let (_, resets) = slider::show_resettable(ui, value, scale, add);
        self.resets.set(self.resets.get() || resets);
    }

    /// Two whole numbers, at least 1. Returns the new ones.
    pub fn counts(&self, ui: &mut Ui, old: [u32; 2]) -> Option<[u32; 2]> {
        let parameter = self.parameter;
        let range = CountRange::new(1, u32::MAX);
        let mut new = old.map(f64::from);
        for number in &mut new {
            let check = |x: f64| check_count(parameter, x, &range);
            self.field(ui, number, (1.0, f64::from(u32::MAX)), 1.0, Look::WHOLE, &check);
        }
        Some(new.map(|x| x.round() as u32)).filter(|new| *new != old)
    }

    /// Channels of a colour. Returns the new ones.
    pub fn colour(&self, ui: &mut Ui, old: [f64; 3], range: &Range) -> Option<[f64; 3]> {
        let parameter = self.parameter;
        let mut new = old;
        for channel in &mut new {
            let check = |x: f64| check_value(parameter, &Value::Colour(&mut [x; 3], *range)).map(message);
            let speed = speed(*channel, range);
            self.field(ui, channel, (range.least, range.most), speed, Look::of(OF_CHANNELS), &check);
        }
        Some(new).filter(|new| *new != old)
    }

    /// Three coordinates in a scene of this size. Returns the new ones.
    pub fn metres(&self, ui: &mut Ui, old: DVec3, size: f64, check: &dyn Fn(DVec3) -> Option<Problem>) -> Option<DVec3> {
        let new = self.three(ui, old, |_| size * 0.002, &|x| check(DVec3::splat(x)).map(message));
        Some(new).filter(|new| *new != old)
    }

    /// Three factors. Returns the new ones.
    pub fn factors(&self, ui: &mut Ui, old: DVec3) -> Option<DVec3> {
        let new = self.three(ui, old, |x| (0.01 * x.abs()).max(1e-9), &|_| None);
        Some(new).filter(|new| *new != old)
    }

    /// Two numbers. Returns the new ones.
    pub fn pair(&self, ui: &mut Ui, old: [f64; 2]) -> Option<[f64; 2]> {
        let parameter = self.parameter;
        let mut new = old;
        for number in &mut new {
            self.field(ui, number, (f64::MIN, f64::MAX), 0.01, Look::of(ALONE), &|x| check_finite(parameter, x));
        }
        Some(new).filter(|new| *new != old)
    }

    /// The first three rows of a matrix; the last is fixed. Returns the new matrix.
    pub fn matrix(&self, ui: &mut Ui, old: [[f64; 4]; 4]) -> Option<[[f64; 4]; 4]> {
        let parameter = self.parameter;
        let mut new = old;
        ui.vertical(|ui| {
            for row in new.iter_mut().take(3) {
                ui.horizontal(|ui| {
                    for number in row {
                        self.field(ui, number, (f64::MIN, f64::MAX), 0.01, Look::of(OF_FOUR), &|x| check_finite(parameter, x));
                    }
                });
            }
        });
        Some(new).filter(|new| *new != old)
    }

    fn three(&self, ui: &mut Ui, old: DVec3, speed: impl Fn(f64) -> f64, check: &dyn Fn(f64) -> Option<String>) -> DVec3 {
        let parameter = self.parameter;
        let mut new = old.to_array();
        for coordinate in &mut new {
            let check = |x: f64| check(x).or_else(|| check_finite(parameter, x));
            let speed = speed(*coordinate);
            self.field(ui, coordinate, (f64::MIN, f64::MAX), speed, Look::of(OF_THREE), &check);
        }
        DVec3::from_array(new)
    }

    fn field(
        &self,
        ui: &mut Ui,
        number: &mut f64,
        (least, most): (f64, f64),
        speed: f64,
        look: Look,
        check: &dyn Fn(f64) -> Option<String>,
    ) {
        let (range, Look { unit, width, is_whole }) = (least..=most, look);
        let (key, label) = (self.parameter.key, self.label);
        let field = TypedNumber { key, range, is_whole, speed, unit, width, label, check };
        let (response, refusal) = field.show(ui, number);
        refusal.into_iter().for_each(|message| refusal::show_below(ui, &response, &message));
    }
}

/// Whether a unit is short enough to stand behind the number in its field.
pub fn fits_field(unit: &str) -> bool {
    unit.chars().count() <= 3
}

/// Format of a field.
struct Look<'a> {
    unit: &'a str,
    width: f32,
    is_whole: bool,
}

impl Look<'_> {
    const WHOLE: Look<'static> = Look { is_whole: true, ..Look::of(ALONE) };

    const fn of(width: f32) -> Look<'static> {
        Look { unit: "", width, is_whole: false }
    }
}

fn check_count(parameter: &Parameter, x: f64, range: &CountRange) -> Option<String> {
    if x.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(&x) {
        return Some(format!("“{}”: expected a whole number, 0 or more, found “{}”", parameter.key, short(x)));
    }
    check_value(parameter, &Value::Count(&mut (x as u32), *range)).map(message)
}

fn check_finite(parameter: &Parameter, mut x: f64) -> Option<String> {
    check_value(parameter, &Value::Number(&mut x, Range::FINITE)).map(message)
}

/// The message of the reader for a problem.
fn message(problem: Problem) -> String {
    let rest = [problem.label, problem.help].into_iter().filter(|text| !text.is_empty());
    [problem.message].into_iter().chain(rest).collect::<Vec<_>>().join("; ")
}

/// The ends of a slider.
fn slider_ends(range: &Range) -> [f64; 2] {
    let widest = if range.scale == SliderScale::Log { SLIDER_LEAST } else { -SLIDER_MOST };
    let least = if range.least == 0.0 { 0.0 } else { range.least.max(widest.min(range.most)) };
    [least, range.most.min(SLIDER_MOST).max(least)]
}

/// The change per point of a drag.
fn speed(old: f64, range: &Range) -> f64 {
    match range.scale {
        SliderScale::Log => (0.01 * old.abs()).max(1e-4 * range.most.min(1.0)).max(range.least),
        SliderScale::Linear if range.most - range.least <= SLIDER_MOST => (range.most - range.least) / 400.0,
        SliderScale::Linear => (0.01 * old.abs()).max(0.1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slider_has_the_ends_of_a_short_range_and_the_middle_of_a_long_one() {
        assert_eq!(slider_ends(&Range::UNIT), [0.0, 1.0]);
        assert_eq!(slider_ends(&Range::INDEX), [0.05, 20.0]);
        assert_eq!(slider_ends(&Range::LENGTH), [1e-3, 1e3]);
        assert_eq!(slider_ends(&Range::RADIANCE), [0.0, 1e3]);
        assert_eq!(slider_ends(&Range::linear(-1e6, 1e6)), [-1e3, 1e3]);
        assert_eq!(slider_ends(&Range::log(5e3, 1e6)), [5e3, 5e3]);
    }

    #[test]
    fn a_drag_changes_large_numbers_faster_and_leaves_none_behind() {
        assert!(speed(0.0, &Range::RADIANCE) > 0.0 && speed(1e6, &Range::RADIANCE) == 1e4);
        assert_eq!((speed(0.5, &Range::UNIT), speed(0.0, &Range::FINITE)), (0.0025, 0.1));
    }
}
