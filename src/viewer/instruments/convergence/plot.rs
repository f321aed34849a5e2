//! The plot of errors and its controls.
use egui::{Color32, Ui};
use egui_plot::{AxisHints, GridInput, GridMark, HLine, Line, LineStyle, Plot, PlotPoints, PlotUi, Points};

use super::{colours::COLOURS, curve::HorizontalAxis, history::History, history::Quantity, legend};

/// A file that the curves are to be saved as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveFile {
    Csv,
    Svg,
}

/// Width of a curve in points.
const CURVE: f32 = 2.2;
/// Opacity of the strongest lines of the grid.
const GRID: f32 = 0.3;

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
    legend::show(ui, history, latest);
    if !has_reference {
        ui.add_space(4.0);
        ui.weak("The estimated error does not include bias. Render or open a reference (panel Display) to see the error and the bias.");
    }
    file
}

fn axis_choice(ui: &mut Ui, history: &mut History) {
    ui.horizontal(|ui| {
        ui.selectable_value(&mut history.what, Quantity::Error, "Error").on_hover_text(
            "Lines are the estimated error: the root of relMSE, estimated from the samples. It does not include bias. Points are the error \
             against the reference. Long dashes are the bias of a cap.",
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
    if history.what == Quantity::Bias && history.shown().all(|curve| curve.values(history.over, |moment| moment.bias).is_empty())
    {
        ui.label("The bias needs a reference. Render or open one (panel Display).");
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
        Quantity::Error => y.label(history.error_title()).formatter(power),
        Quantity::Bias => y.label("bias in standard errors").formatter(plain),
    };
    let plot = Plot::new(("convergence", over == HorizontalAxis::Samples, what == Quantity::Error))
        .custom_x_axes(vec![x])
        .custom_y_axes(vec![y])
        .x_grid_spacer(|input| decades(&input))
        // Fainter than the curves on dark and on light ground.
        .grid_color(ui.visuals().text_color().gamma_multiply(GRID))
        .show_crosshair(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .label_formatter(|_| None);
    let plot =
        if what == Quantity::Error { plot.y_grid_spacer(|input| decades(&input)) } else { plot.include_y(-3.0).include_y(3.0) };
    // Numbers below the axis may stand out at its end.
    let room = egui::Frame::new().inner_margin(egui::Margin { right: 14, ..egui::Margin::ZERO });
    let draw = |plot: &mut PlotUi<'_>| match what {
        Quantity::Error => draw_errors(plot, history),
        Quantity::Bias => draw_bias(plot, history),
    };
    room.show(ui, |ui| plot.show(ui, draw));
}

fn draw_errors(plot: &mut PlotUi<'_>, history: &History) {
    let over = history.over;
    for curve in history.shown() {
        let (colour, name) = (COLOURS[curve.colour], history.name(curve));
        let noise = logarithms(&curve.errors(over, |moment| moment.noise));
        plot.line(Line::new(name.clone(), noise).color(colour).width(CURVE));
        let measured = logarithms(&curve.errors(over, |moment| moment.true_error));
        plot.points(Points::new(name.clone(), measured).color(colour).radius(2.2));
        if let Some(bias) = history.bias_of_cap(curve) {
            plot.hline(HLine::new(name, bias.log10()).color(colour).style(LineStyle::Dashed { length: 14.0 }));
        }
    }
    let guide = Line::new("independent: 1/√N", logarithms(&history.guide()));
    plot.line(guide.color(Color32::GRAY).style(LineStyle::dashed_loose()));
}

fn draw_bias(plot: &mut PlotUi<'_>, history: &History) {
    for curve in history.shown() {
        let bias = curve.values(history.over, |moment| moment.bias).into_iter().map(|(x, bias)| [x.log10(), bias]);
        let line = Line::new(history.name(curve), PlotPoints::from_iter(bias));
        plot.line(line.color(COLOURS[curve.colour]).width(CURVE));
    }
    for at in [-2.0, 0.0, 2.0] {
        plot.hline(HLine::new("", at).color(Color32::GRAY).style(LineStyle::dashed_loose()));
    }
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
    use super::*;

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
