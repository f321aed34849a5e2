//! The plot of errors and its controls.
use egui::{Color32, Label, RichText, Ui};
use egui_plot::{AxisHints, GridInput, GridMark, HLine, Line, LineStyle, Plot, PlotPoints, Points};

use super::{colours::COLOURS, curve::Curve, curve::HorizontalAxis, history::History, history::Quantity};
use crate::viewer::widgets::style;

/// A file that the curves are to be saved as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveFile {
    Csv,
    Svg,
}

/// Shows the curves and their figures. `latest` are the generations of the two views; a hint says how to get a reference where
/// `has_reference` is false.
pub fn show(ui: &mut Ui, history: &mut History, latest: [Option<u64>; 2], has_reference: bool) -> Option<CurveFile> {
    let room = ui.available_size();
    if room.x < FIGURES_WIDTH + LEAST_PLOT {
        let scroll = egui::ScrollArea::vertical().auto_shrink(false);
        let contents = |ui: &mut Ui| {
            ui.allocate_ui(egui::vec2(ui.available_width(), room.y), |ui| plot(ui, history));
            figures_column(ui, history, latest, has_reference)
        };
        return scroll.show(ui, contents).inner;
    }
    let panel = egui::Panel::right("convergence figures").resizable(false).exact_size(FIGURES_WIDTH);
    let file = panel.show(ui, |ui| {
        let scroll = egui::ScrollArea::vertical();
        scroll.show(ui, |ui| figures_column(ui, history, latest, has_reference)).inner
    });
    plot(ui, history);
    file.inner
}

/// Width of the figures, and the least width of a plot beside them, points. In less room they stand below it.
const FIGURES_WIDTH: f32 = 270.0;
const LEAST_PLOT: f32 = 220.0;

/// Shows the choice of axes, the buttons and the legend.
fn figures_column(ui: &mut Ui, history: &mut History, latest: [Option<u64>; 2], has_reference: bool) -> Option<CurveFile> {
    axis_choice(ui, history);
    // Above the figures, whose lines break elsewhere as the numbers grow.
    let file = buttons(ui, history, latest);
    legend(ui, history, latest);
    if !has_reference {
        ui.add_space(4.0);
        ui.weak("Drop a reference EXR on the window to see the true error and the bias.");
    }
    file
}

fn axis_choice(ui: &mut Ui, history: &mut History) {
    ui.horizontal(|ui| {
        ui.selectable_value(&mut history.what, Quantity::Error, "Error").on_hover_text(
            "Relative error, the root of relMSE. Lines are estimated from the samples, points are measured against the reference.",
        );
        ui.selectable_value(&mut history.what, Quantity::Bias, "Bias").on_hover_text(
            "Mean of the image minus that of the reference, in standard errors. An unbiased estimate stays within ±2 in 95 % of cases.",
        );
        ui.separator();
        ui.selectable_value(&mut history.over, HorizontalAxis::Samples, "over N").on_hover_text("Plots over samples per pixel N.");
        ui.selectable_value(&mut history.over, HorizontalAxis::Seconds, "over time").on_hover_text("Plots over render time.");
    });
    ui.add_space(4.0);
}

const FIGURES: &str = "Samples per pixel, render time and estimated relative error. Against the reference: true error, and bias of the mean in \
                       standard errors. The slope is that of log error, with its 95 % interval; independent samples have −0.5.";

/// Names the curves and gives their last figures.
fn legend(ui: &mut Ui, history: &History, latest: [Option<u64>; 2]) {
    for (number, curve) in history.curves.iter().enumerate() {
        let name = history.name(curve);
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| {
                ui.add_space(2.0);
                style::swatch(ui, COLOURS[number % COLOURS.len()]);
            });
            let text = RichText::new(&name);
            ui.vertical(|ui| {
                ui.set_max_width(236.0);
                ui.add(Label::new(if latest.contains(&Some(curve.generation)) { text.strong() } else { text }).wrap());
            });
        });
        ui.indent(number, |ui| ui.weak(figures(curve, history.over)).on_hover_text(FIGURES));
    }
    if history.curves.is_empty() {
        ui.weak("Available after two samples per pixel. Curves of earlier settings stay.");
    }
    if !history.curves.is_empty() {
        let root = if history.over == HorizontalAxis::Samples { "1/√N" } else { "1/√time" };
        ui.weak(match history.what {
            Quantity::Error => {
                format!("Lines: estimated. Points: against the reference. Dashed: {root} through the current curve, the rate of independent samples.")
            }
            Quantity::Bias => "Dashed: 0 and ±2 σ. Unbiased means stay within ±2 σ in 95 % of cases.".to_owned(),
        });
    }
    ui.add_space(6.0);
}

fn buttons(ui: &mut Ui, history: &mut History, latest: [Option<u64>; 2]) -> Option<CurveFile> {
    let mut file = None;
    ui.horizontal(|ui| {
        let any = !history.curves.is_empty();
        ui.add_enabled_ui(any, |ui| {
            if ui.button("CSV…").on_hover_text("Saves all figures as CSV.").clicked() {
                file = Some(CurveFile::Csv);
            }
            if ui.button("SVG…").on_hover_text("Saves the plot as SVG.").clicked() {
                file = Some(CurveFile::Svg);
            }
            if ui.button("Clear").on_hover_text("Removes the curves of earlier settings.").clicked() {
                history.curves.retain(|curve| latest.contains(&Some(curve.generation)));
            }
        });
    });
    ui.add_space(4.0);
    file
}

fn plot(ui: &mut Ui, history: &History) {
    if history.what == Quantity::Bias
        && history.curves.iter().all(|curve| curve.values(history.over, |moment| moment.bias).is_empty())
    {
        ui.label("The bias needs a reference: open a scene with [truth], or drop a reference EXR on the window.");
        return;
    }
    let (over, what) = (history.over, history.what);
    let power = |mark: GridMark, _: &std::ops::RangeInclusive<f64>| label(10f64.powf(mark.value));
    let plain = |mark: GridMark, _: &std::ops::RangeInclusive<f64>| format!("{:.0}", mark.value);
    let x = AxisHints::new_x()
        .label(if over == HorizontalAxis::Samples { "samples per pixel N" } else { "seconds" })
        .formatter(power);
    let y = AxisHints::new_y().min_thickness(44.0);
    let y = match what {
        Quantity::Error => y.label("relative error").formatter(power),
        Quantity::Bias => y.label("bias in standard errors").formatter(plain),
    };
    let plot = Plot::new(("convergence", over == HorizontalAxis::Samples, what == Quantity::Error))
        .custom_x_axes(vec![x])
        .custom_y_axes(vec![y])
        .x_grid_spacer(|input| decades(&input))
        .show_crosshair(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .label_formatter(|_| None);
    let plot =
        if what == Quantity::Error { plot.y_grid_spacer(|input| decades(&input)) } else { plot.include_y(-3.0).include_y(3.0) };
    // Numbers below the axis may stand out at its end.
    let room = egui::Frame::new().inner_margin(egui::Margin { right: 14, ..egui::Margin::ZERO });
    let draw = |plot: &mut egui_plot::PlotUi<'_>| {
        for (number, curve) in history.curves.iter().enumerate() {
            let (colour, name) = (COLOURS[number % COLOURS.len()], history.name(curve));
            match what {
                Quantity::Error => {
                    let estimated = logarithms(&curve.errors(over, |moment| moment.estimated));
                    plot.line(Line::new(name.clone(), estimated).color(colour).width(1.8));
                    let truth = logarithms(&curve.errors(over, |moment| moment.true_error));
                    plot.points(Points::new(name, truth).color(colour).radius(2.2));
                }
                Quantity::Bias => {
                    let bias = curve.values(over, |moment| moment.bias).into_iter().map(|(x, bias)| [x.log10(), bias]);
                    plot.line(Line::new(name, PlotPoints::from_iter(bias)).color(colour).width(1.8));
                }
            }
        }
        if what == Quantity::Error {
            let guide = Line::new("independent: 1/√N", logarithms(&history.guide()));
            plot.line(guide.color(Color32::GRAY).style(LineStyle::dashed_loose()));
        } else {
            for at in [-2.0, 0.0, 2.0] {
                plot.hline(HLine::new("", at).color(Color32::GRAY).style(LineStyle::dashed_loose()));
            }
        }
    };
    room.show(ui, |ui| plot.show(ui, draw));
}

/// The last figures of a curve.
fn figures(curve: &Curve, over: HorizontalAxis) -> String {
    let Some(last) = curve.moments.last() else { return "no samples yet".to_owned() };
    let percent = |x: f64| format!("{:.2} %", 100.0 * x);
    let mut text = format!("N {}, {:.1} s, error {}", last.spp, last.seconds, last.estimated.map_or("–".to_owned(), percent));
    if let Some(error) = last.true_error {
        text += &format!("\ntrue {}", percent(error));
    }
    if let Some(bias) = last.bias {
        // Farther out no probability is a number any more.
        text += &if bias.abs() > 37.0 {
            format!(", bias beyond {} 37 σ", if bias > 0.0 { "+" } else { "-" })
        } else {
            format!(", bias {bias:+.1} σ")
        };
    }
    if let Some(slope) = curve.slope(over).filter(|slope| slope.half_width < 0.5) {
        text += &format!("\nslope {:.2} ± {:.2}", slope.slope, slope.half_width);
    }
    text
}

fn logarithms(points: &[(f64, f64)]) -> PlotPoints<'static> {
    PlotPoints::from_iter(points.iter().map(|(x, y)| [x.log10(), y.log10()]))
}

/// Marks at powers of ten, thinner ones at their multiples.
fn decades(input: &GridInput) -> Vec<GridMark> {
    const FARTHEST: f64 = 30.0;
    let [low, high] = [input.bounds.0.floor(), input.bounds.1.ceil()].map(|end| end.clamp(-FARTHEST, FARTHEST) as i32);
    // In wide plots multiples would be a grey area.
    let multiples = if high - low > 8 { 1 } else { 10 };
    let marks = (low..=high).flat_map(|decade| (1..multiples.max(2)).map(move |m| (decade, m)));
    marks
        .map(|(decade, m)| GridMark {
            value: f64::from(decade) + f64::from(m).log10(),
            step_size: if m == 1 { 1.0 } else { 0.1 },
        })
        // Those beyond would be written beside the plot.
        .filter(|mark| (input.bounds.0..=input.bounds.1).contains(&mark.value))
        .collect()
}

/// A power of ten as people write it.
fn label(x: f64) -> String {
    match x {
        x if (0.0009..99_999.0).contains(&x) => format!("{}", (x * 1e6).round() / 1e6),
        x => format!("{x:.0e}"),
    }
}

#[cfg(test)]
mod tests {
    use noisefall::scene::{RenderSettings, Sharing};

    use super::*;
    use crate::viewer::instruments::convergence::curve::Moment;

    #[test]
    fn a_curve_says_its_last_figures_each_by_its_name() {
        let last = Moment {
            spp: 16,
            seconds: 2.0,
            estimated: Some(0.125),
            true_error: Some(0.0625),
            bias: Some(-1.5),
            sharing: Sharing::Nothing,
        };
        let curve = |bias| {
            let moments = vec![Moment { spp: 8, seconds: 1.0, ..last }, Moment { bias: Some(bias), ..last }];
            let mut curve = Curve::new(RenderSettings::default(), 1);
            curve.moments = moments;
            figures(&curve, HorizontalAxis::Samples)
        };
        assert_eq!(curve(-1.5), "N 16, 2.0 s, error 12.50 %\ntrue 6.25 %, bias -1.5 σ");
        assert!(curve(40.0).ends_with(", bias beyond + 37 σ") && curve(-40.0).ends_with(", bias beyond - 37 σ"));
    }

    #[test]
    fn lines_of_the_grid_are_powers_of_ten_and_where_there_is_room_their_multiples() {
        let marks = |low: f64, high: f64| -> Vec<(f64, f64)> {
            let marks = decades(&GridInput { bounds: (low, high), base_step_size: 1.0 });
            marks.iter().map(|mark| (10f64.powf(mark.value).round(), mark.step_size)).collect()
        };
        // From 5 to 20.
        assert_eq!(marks(0.69, 1.31), [(5.0, 0.1), (6.0, 0.1), (7.0, 0.1), (8.0, 0.1), (9.0, 0.1), (10.0, 1.0), (20.0, 0.1)]);
        assert_eq!(marks(-0.1, 9.1).len(), 10);
    }

    #[test]
    fn labels_are_plain_where_they_are_short() {
        assert_eq!([0.01, 0.3, 2.0, 50_000.0].map(label), ["0.01", "0.3", "2", "50000"]);
        assert_eq!([1e-4, 1e5].map(label), ["1e-4", "1e5"]);
        // Of a power of ten that rounding has missed.
        assert_eq!(label(10f64.powf(-0.300_000_000_000_000_04) * 2.0), "1.002374");
    }

    #[test]
    fn the_grid_reaches_to_its_last_decade_and_no_farther_than_numbers_do() {
        let marks = |low: f64, high: f64| decades(&GridInput { bounds: (low, high), base_step_size: 1.0 });
        let decade = marks(0.0, 1.0);
        assert_eq!((decade.len(), decade.last().map(|mark| (mark.value, mark.step_size))), (10, Some((1.0, 1.0))));
        assert!(decade[1..9].iter().all(|mark| mark.step_size == 0.1));
        assert_eq!([marks(0.0, 8.0).len(), marks(0.0, 9.0).len()], [8 * 9 + 1, 10]);
        let far = marks(-400.0, 400.0);
        assert_eq!((far.len(), far[0].value), (61, -30.0));
    }
}
