//! The legend of the plot: names and last figures. A click hides a curve, a menu renames or removes it.
use egui::{Button, Key, Response, RichText, TextEdit, Ui};

use super::{
    colours::COLOURS,
    curve::{Curve, HorizontalAxis},
    history::{History, Quantity},
};
use crate::viewer::widgets::{list::closing, style};

const FIGURES: &str = "Samples per pixel, render time and estimated error. Against the reference: error, and bias of the mean in standard errors. \
                       The slope is that of the logarithm of the estimated error, with its 95 % interval; independent samples have −0.5. \
                       Heavy tails: the estimated error once fell more slowly than 1/√N, because rare outliers were found late. It \
                       and the slope are then too optimistic.";
const CLICK: &str = "A click hides or shows the curve. Right click or double click: rename, remove.";
/// The widest name, in points.
const NAME: f32 = 236.0;

/// An action on a curve.
enum Act {
    Toggle,
    Rename,
    Remove,
}

/// Names the curves and gives their last figures. Those of the `latest` generations are emphasized.
pub fn show(ui: &mut Ui, history: &mut History, latest: [Option<u64>; 2]) {
    let mut acts = Vec::new();
    for number in 0..history.curves.len() {
        let is_latest = latest.contains(&Some(history.curves[number].generation));
        let act = entry(ui, history, number, is_latest);
        acts.extend(act.map(|act| (number, act)));
        let curve = &history.curves[number];
        if !curve.is_hidden {
            let text = figures(curve, history.over, history.bias_of_cap(curve));
            ui.indent(number, |ui| ui.weak(text).on_hover_text(FIGURES));
        }
    }
    acts.into_iter().for_each(|(number, act)| history.follow(number, &act));
    if history.curves.is_empty() {
        ui.weak("Available after two samples per pixel. Curves of earlier settings stay.");
    } else {
        ui.weak(explanation(history));
    }
    ui.add_space(6.0);
}

fn explanation(history: &History) -> String {
    let root = if history.over == HorizontalAxis::Samples { "1/√N" } else { "1/√time" };
    match history.what {
        Quantity::Error => {
            let points = if history.is_measured() { " Points: error against the reference." } else { "" };
            let has_floor = history.shown().any(|curve| history.bias_of_cap(curve).is_some());
            let floor = if has_floor { " Long dashes: bias of the cap, which stays." } else { "" };
            format!(
                "Lines: estimated error.{points}{floor} Dashed: {root} through the current curve, the rate of independent samples."
            )
        }
        Quantity::Bias => "Dashed: 0 and ±2 σ. Unbiased means stay within ±2 σ in 95 % of cases.".to_owned(),
    }
}

/// Shows the key and the name of a curve, or the field that renames it.
fn entry(ui: &mut Ui, history: &mut History, number: usize, is_latest: bool) -> Option<Act> {
    let (settings, colour) = (history.curves[number].settings, COLOURS[history.curves[number].colour]);
    let (name, is_hidden) = (history.name(&history.curves[number]), history.curves[number].is_hidden);
    let row = ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            ui.add_space(2.0);
            style::swatch(ui, colour, !is_hidden);
        });
        if let Some((_, text)) = history.renaming.as_mut().filter(|(of, _)| *of == settings) {
            let field = ui.add(TextEdit::singleline(text).desired_width(NAME).hint_text("name of the settings"));
            if field.lost_focus() {
                let is_kept = !ui.input(|input| input.key_pressed(Key::Escape));
                history.end_renaming(is_kept);
            } else if !field.has_focus() {
                field.request_focus();
            }
            return None;
        }
        let text = RichText::new(name);
        let text = if is_hidden { text.weak().strikethrough() } else { text };
        let text = if is_latest { text.strong() } else { text };
        let name = ui.vertical(|ui| {
            ui.set_max_width(NAME);
            ui.add(Button::new(text).frame(false).wrap()).on_hover_text(CLICK)
        });
        asked(&name.inner)
    });
    row.inner
}

fn asked(name: &Response) -> Option<Act> {
    let mut of_menu = None;
    name.context_menu(|ui| {
        let rename = ui.button("Rename").clicked().then_some(Act::Rename);
        let remove = ui.button("Remove").on_hover_text("Removes the curve. One that grows begins anew.").clicked();
        of_menu = closing(ui, rename.or(remove.then_some(Act::Remove)));
    });
    let of_click = if name.double_clicked() {
        // Its first click has hidden it, and the second one shows it again.
        Some(Act::Rename)
    } else {
        name.clicked().then_some(Act::Toggle)
    };
    of_menu.or(of_click)
}

impl History {
    fn follow(&mut self, number: usize, act: &Act) {
        match act {
            Act::Toggle => self.curves[number].is_hidden ^= true,
            Act::Rename => {
                let curve = &mut self.curves[number];
                curve.is_hidden = false;
                self.renaming = Some((self.curves[number].settings, self.name(&self.curves[number])));
            }
            Act::Remove => drop(self.curves.remove(number)),
        }
    }

    /// Gives the curve its new name, if that is kept; an empty one, or its own, returns it to its own.
    fn end_renaming(&mut self, is_kept: bool) {
        let Some((settings, name)) = self.renaming.take().filter(|_| is_kept) else { return };
        let Some(number) = self.curves.iter().position(|curve| curve.settings == settings) else { return };
        let name = name.trim().to_owned();
        let is_given = !name.is_empty() && name != self.own_name(&self.curves[number]);
        self.curves[number].given_name = is_given.then_some(name);
    }
}

/// The last figures of a curve.
fn figures(curve: &Curve, over: HorizontalAxis, bias_of_cap: Option<f64>) -> String {
    let Some(last) = curve.moments.last() else { return "no samples yet".to_owned() };
    let percent = |x: f64| format!("{:.2} %", 100.0 * x);
    let at_least = if curve.noise_is_lower_bound() { "≥ " } else { "" };
    let noise = last.noise.map_or("–".to_owned(), |noise| format!("{at_least}{}", percent(noise)));
    let mut text = format!("N {}, {:.1} s, estimated error {noise}", last.spp, last.seconds);
    if let Some(error) = last.true_error {
        text += &format!("\nerror {}", percent(error));
    }
    if let Some(bias) = last.bias {
        // Farther out no probability is a number any more.
        text += &if bias.abs() > 37.0 {
            format!(", bias beyond {} 37 σ", if bias > 0.0 { "+" } else { "-" })
        } else {
            format!(", bias {bias:+.1} σ")
        };
    }
    if let Some(bias) = bias_of_cap {
        text += &format!("\nbias of the cap {}", percent(bias));
    }
    if let Some(slope) = slope_text(curve, over) {
        text += &format!("\n{slope}");
    }
    text
}

/// The slope of a curve in words, if it is known.
pub fn slope_text(curve: &Curve, over: HorizontalAxis) -> Option<String> {
    let slope = curve.slope(over)?;
    let tail = if curve.has_heavy_tail() { " (heavy tails)" } else { "" };
    Some(format!("slope {:.2} ± {:.2}{tail}", slope.slope, slope.half_width))
}

#[cfg(test)]
mod tests {
    use noisefall_scene::scene::{PathReuse, RenderSettings};

    use super::*;
    use crate::viewer::instruments::convergence::curve::Moment;

    #[test]
    fn a_curve_says_its_last_figures_each_by_its_name() {
        let last = Moment {
            spp: 16,
            seconds: 2.0,
            noise: Some(0.125),
            true_error: Some(0.0625),
            bias: Some(-1.5),
            path_reuse: PathReuse::Off,
            is_lower_bound: false,
        };
        let curve = |bias| {
            let moments = vec![Moment { spp: 8, seconds: 1.0, ..last }, Moment { bias: Some(bias), ..last }];
            let mut curve = Curve::new(RenderSettings::default(), 1, 0);
            curve.moments = moments;
            figures(&curve, HorizontalAxis::Samples, None)
        };
        assert_eq!(curve(-1.5), "N 16, 2.0 s, estimated error 12.50 %\nerror 6.25 %, bias -1.5 σ");
        assert!(curve(40.0).ends_with(", bias beyond + 37 σ") && curve(-40.0).ends_with(", bias beyond - 37 σ"));
    }
}
