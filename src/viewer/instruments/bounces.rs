//! The bounces instrument: the image as a series, term by term.
use egui::{Color32, Label, RichText, Sense, Slider, Ui, vec2};
use noisefall_kernel::integrator::TERMS;
use noisefall_render::render::{Frame, Series, view::View};
use noisefall_scene::scene::Strategy;

use super::strategies;

use crate::viewer::widgets::{
    counted::counted,
    palette::Palette,
    slider::{self, Scale},
};

/// The part of the series that is displayed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounces {
    pub k: usize,
    /// All light of at most `k` bounces, and not of exactly `k`.
    pub up_to: bool,
    /// The strategy of bidirectional paths to show in place of the series.
    pub strategy: Option<Strategy>,
}

impl Default for Bounces {
    /// The first term beyond the lights themselves.
    fn default() -> Bounces {
        Bounces { k: 1, up_to: false, strategy: None }
    }
}

const LAST: usize = TERMS - 1;
/// Larger images would take gigabytes: a pixel takes about a hundred bytes in the film and as many in a frame.
const MOST_PIXELS: u64 = 4_200_000;
/// The last bar counts this many bounces and more.
const BARS: usize = 16;

/// Whether an image is small enough to be split into its series.
pub fn has_room_for_series(resolution: [u32; 2]) -> bool {
    resolution.map(u64::from).iter().product::<u64>() <= MOST_PIXELS
}

/// The image whose series is shown.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The frame that has the series.
    pub frame: Option<&'a Frame>,
    /// The view of the canvas.
    pub view: View,
    pub resolution: [u32; 2],
    /// The image beside takes light paths, too.
    pub has_light_paths: bool,
    /// Why there are no strategies to show, if so.
    pub without_strategies: Option<&'a str>,
}

/// Shows the bars and the choice of a term.
pub fn show(ui: &mut Ui, bounces: &mut Bounces, subject: Subject<'_>) {
    let Subject { frame, view, resolution, .. } = subject;
    if !has_room_for_series(resolution) {
        let [width, height] = resolution;
        ui.label(format!("{width} × {height} pixels are too many. Choose a resolution of at most 4 million pixels (Camera)."));
        return;
    }
    choose_part(ui, bounces, subject.without_strategies);
    if !view.shows_light() {
        let view = view.title();
        ui.label(
            RichText::new(format!("The view {view} shows the whole image. Choose Radiance to see bounces.")).color(ui.warning()),
        );
    }
    match &mut bounces.strategy {
        Some(strategy) => strategies::show(ui, strategy, frame.map(|frame| frame.spp)),
        None => show_series(ui, bounces, subject),
    }
}

/// Chooses between the series and single strategies.
fn choose_part(ui: &mut Ui, bounces: &mut Bounces, without_strategies: Option<&str>) {
    ui.horizontal(|ui| {
        let mut part = (bounces.up_to, bounces.strategy.is_some());
        ui.selectable_value(&mut part, (false, false), "Bounce k alone")
            .on_hover_text("Shows T^k L_e, the light with exactly k bounces: term k of the series that solves the equation.");
        ui.selectable_value(&mut part, (true, false), "Bounces up to k")
            .on_hover_text("Shows L_e + T L_e + … + T^k L_e, the image with a cap of k bounces.");
        ui.add_enabled_ui(without_strategies.is_none(), |ui| {
            let choice = ui.selectable_value(&mut part, (bounces.up_to, true), "Strategies (s, t)");
            choice
                .on_hover_text(
                    "Shows the light that bidirectional paths find with s vertices from a light and t from the camera.",
                )
                .on_disabled_hover_text(without_strategies.unwrap_or_default());
        });
        bounces.up_to = part.0;
        bounces.strategy = part.1.then(|| bounces.strategy.unwrap_or(strategies::FIRST));
    });
}

/// Shows the bars of the series and the choice of a term.
fn show_series(ui: &mut Ui, bounces: &mut Bounces, Subject { frame, has_light_paths, .. }: Subject<'_>) {
    ui.horizontal(|ui| {
        let label = ui.label("k").on_hover_text("k is the number of bounces, reflections and refractions alike.");
        let scale = Scale::linear(0.0..=LAST as f64);
        slider::show(ui, &mut bounces.k, &scale, Bounces::default().k, |ui, k| {
            ui.add(Slider::new(k, 0..=LAST)).labelled_by(label.id)
        });
        ui.add(Label::new(RichText::new(meaning(*bounces)).weak()).truncate());
    });
    // While the camera moves there are no figures. Bars and lines keep their places.
    let known = frame.and_then(|frame| Some((frame, frame.series.as_ref()?)));
    ui.add_space(6.0);
    bars(ui, known.map(|(_, series)| series), bounces);
    ui.add_space(4.0);
    let text = known.map_or_else(|| " ".to_owned(), |(_, series)| shares(series, *bounces));
    // One line each, however narrow the window is: they must not move when the figures come.
    ui.add(Label::new(RichText::new(text).color(ui.accent())).truncate());
    let remark = match known {
        Some((frame, _)) => {
            let samples = counted(frame.spp, "sample");
            let how = if has_light_paths { "by camera paths (MIS)" } else { "without path reuse" };
            format!("After {samples} per pixel {how}. Shares are fractions of the luminance of the image.")
        }
        None => "Available after one sample per pixel.".to_owned(),
    };
    ui.add(Label::new(RichText::new(remark).weak()).truncate());
}

/// The share of the chosen term, and of all light that a cap there would lose.
fn shares(series: &Series, Bounces { k, up_to, .. }: Bounces) -> String {
    let lost = series.lost_by_cap(k);
    if k == LAST && up_to {
        return "This is all of the light.".to_owned();
    }
    if k == LAST {
        return format!("{LAST} or more bounces contribute {} of the light.", percent(series.shares.iter().skip(LAST).sum()));
    }
    let [own, up_to, lost] = [series.shares[k], 1.0 - lost, lost].map(percent);
    format!("k = {k} contributes {own} of the light; up to k it is {up_to}. A cap of {k} would lose {lost}.")
}

/// Draws a bar for the share of each number of bounces; a click chooses the term.
fn bars(ui: &mut Ui, series: Option<&Series>, bounces: &mut Bounces) {
    const HEIGHT: f32 = 64.0;
    const MOST_WIDTH: f32 = 40.0;
    const GAP: f32 = 3.0;
    let of_term = |k: usize| {
        let shares = &series?.shares;
        Some(if k < BARS { shares[k] } else { shares.iter().skip(BARS).sum() })
    };
    let most = series.map_or(1.0, |series| series.shares.iter().copied().fold(1e-12, f64::max));
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        let width = ((ui.available_width() - GAP * BARS as f32) / (BARS + 1) as f32).min(MOST_WIDTH);
        for k in 0..=BARS {
            let share = of_term(k);
            let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT + 32.0), Sense::click());
            let part = (share.unwrap_or(0.0) / most) as f32;
            let term = k.min(LAST);
            let chosen = term == bounces.k || (bounces.up_to && term < bounces.k);
            let colour = if chosen { ui.accent() } else { Color32::GRAY };
            let base = rect.top() + HEIGHT;
            let bar = egui::Rect::from_min_max(
                egui::pos2(rect.left(), base - HEIGHT * part.clamp(0.0, 1.0)),
                egui::pos2(rect.right(), base),
            );
            ui.painter().rect_filled(bar, 1.0, colour);
            let font = egui::FontId::proportional(11.0);
            let (middle, ink) = (rect.center().x, ui.visuals().text_color());
            let name = if k < BARS { k.to_string() } else { format!("≥ {BARS}") };
            let below = |dy: f32| egui::pos2(middle, base + dy);
            ui.painter().text(below(2.0), egui::Align2::CENTER_TOP, name, font.clone(), ink);
            ui.painter().text(
                below(16.0),
                egui::Align2::CENTER_TOP,
                share.map_or_else(|| "–".to_owned(), short),
                font,
                ui.visuals().weak_text_color(),
            );
            let doc = format!("{}: {}", number(k), share.map_or_else(|| "not known yet".to_owned(), percent));
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &doc));
            if response.on_hover_text(&doc).clicked() {
                bounces.k = term;
            }
        }
    });
}

/// The number of bounces of a bar.
fn number(k: usize) -> String {
    if k < BARS { counted(k, "bounce") } else { format!("{BARS} and more bounces") }
}

/// The displayed part in words.
fn meaning(Bounces { k, up_to, .. }: Bounces) -> String {
    match (k, up_to) {
        (LAST, true) => "all of the light".to_owned(),
        (LAST, false) => format!("{LAST} bounces and more"),
        (0, _) => "light without a bounce".to_owned(),
        (1, false) => "direct light: one bounce".to_owned(),
        (k, false) => format!("light after {k} bounces"),
        (1, true) => "lights, and light after one bounce".to_owned(),
        (k, true) => format!("light after at most {k} bounces"),
    }
}

fn percent(x: f64) -> String {
    if x > 0.0 && x < 1e-4 { "less than 0.01 %".to_owned() } else { format!("{:.2} %", 100.0 * x.max(0.0)) }
}

fn short(x: f64) -> String {
    match 100.0 * x {
        x if x >= 9.95 => format!("{x:.0} %"),
        x if x >= 0.05 => format!("{x:.1} %"),
        _ => "–".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_are_said_in_words() {
        let said = |k, up_to| meaning(Bounces { k, up_to, strategy: None });
        assert_eq!(said(0, false), said(0, true));
        assert!(said(1, false).contains("direct") && said(1, true).contains("lights"));
        assert!(said(5, false).contains("5 bounces") && !said(5, false).contains("most"));
        assert!(said(5, true).contains("at most 5 bounces"));
        assert!(said(LAST, true).contains("all") && said(LAST, false).contains("and more"));
    }

    #[test]
    fn shares_have_the_digits_that_count() {
        assert_eq!((percent(0.125).as_str(), percent(0.00005).as_str()), ("12.50 %", "less than 0.01 %"));
        assert_eq!((percent(0.0).as_str(), percent(-1e-17).as_str()), ("0.00 %", "0.00 %"));
        assert_eq!([0.123, 0.0996, 0.0123, 0.0005, 0.0004].map(short), ["12 %", "10 %", "1.2 %", "0.1 %", "–"]);
    }
}
