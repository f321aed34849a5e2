//! The figures of both sides, and which is more efficient.
use egui::{Grid, RichText, Ui};
use noisefall_kernel::measure::LogRatio;
use noisefall_render::render::{MODEL_ERROR, State, Status};
use noisefall_scene::scene::RenderSettings;

use crate::viewer::background::display_image::ReferenceComparison;
use crate::viewer::instruments::convergence::history::name;
use crate::viewer::widgets::{palette::Palette, style};

/// Figures of one side.
#[derive(Clone, Copy)]
pub struct SideStatus<'a> {
    pub status: &'a Status,
    pub comparison: Option<ReferenceComparison>,
}

/// Shows the figures of both sides, and which is more efficient.
pub fn show(
    ui: &mut Ui,
    [a, b]: [&RenderSettings; 2],
    of_scene: &RenderSettings,
    [of_a, of_b]: [SideStatus; 2],
    error_ratio: Option<LogRatio>,
) {
    let named = |settings, side: SideStatus| name(settings, of_scene, side.status.path_reuse);
    let sides = [Side::of("A", named(a, of_a), a, of_a), Side::of("B", named(b, of_b), b, of_b)];
    Grid::new("A and B").num_columns(8).spacing([18.0, 5.0]).show(ui, |ui| {
        for (heading, doc) in HEADINGS {
            ui.label(RichText::new(heading).weak()).on_hover_text(doc);
        }
        ui.end_row();
        for side in &sides {
            side.row(ui);
        }
    });
    ui.add_space(4.0);
    if let Some(text) = incomparable(&sides) {
        ui.label(RichText::new(text).color(ui.warning()));
    } else if let Some([more, less]) = head_start(&sides) {
        // More samples of the same points can be more efficient.
        ui.weak(match less.is_running {
            true => {
                format!("No verdict yet: {} is catching up; {} has rendered {:.0} s.", less.letter, more.letter, more.seconds)
            }
            false => format!("No verdict: {} had more time. Restart (Ctrl+R) to give both the same.", more.letter),
        });
    } else if sides.iter().all(|side| side.efficiency.is_some()) {
        let ratio = error_ratio.map(|ratio| efficiency_ratio(ratio, &sides, [a, b]));
        let (text, more) = verdict(ratio);
        ui.label(RichText::new(text).color(ui.accent())).on_hover_text(more);
    } else {
        ui.weak("Available after two samples per pixel.");
    }
}

/// The side that had clearly more seconds than the other, if one had, and the other.
fn head_start([a, b]: &[Side; 2]) -> Option<[&Side; 2]> {
    let (more, less) = if a.seconds > b.seconds { (a, b) } else { (b, a) };
    (more.seconds > 1.1 * less.seconds + 0.5).then_some([more, less])
}

const HEADINGS: [(&str, &str); 8] = [
    ("", ""),
    ("settings", "Differences from the settings of the scene file, and what pixels share"),
    ("N", "Samples per pixel"),
    ("time", "Render time. The side that had less goes first, so both get the same"),
    ("estimated error", "The estimated relative error: the root of relMSE, the mean of (x − r)²/(r² + 0.01 · mean r²)"),
    ("error", "Relative error against the reference, if there is one"),
    ("efficiency", "1/(relMSE · seconds). Twice the efficiency gives the same error in half the time"),
    ("converges to", "Whether the expected image is the solution of the light transport equation"),
];

/// The figures of one side.
struct Side {
    letter: &'static str,
    name: String,
    spp: u32,
    seconds: f64,
    is_running: bool,
    noise: Option<f64>,
    reference: Option<f64>,
    efficiency: Option<f64>,
    /// Why it converges to another image, or not at all.
    trouble: Option<String>,
}

impl Side {
    fn of(letter: &'static str, name: String, settings: &RenderSettings, known: SideStatus) -> Side {
        let SideStatus { status, comparison } = known;
        let seconds = status.elapsed.as_secs_f64();
        let trouble = failure_of(status).or_else(|| status.bias(settings).map(|why| format!("biased: {why}")));
        // Noise alone does not see bias; the truth, where it is known, does.
        let tells = trouble.is_none() || comparison.is_some();
        let rel_mse =
            comparison.map(|comparison| comparison.rel_mse).or(status.rel_mse_estimate).filter(|rel_mse| *rel_mse > 0.0);
        Side {
            trouble,
            letter,
            name,
            spp: status.spp,
            seconds,
            is_running: status.state == State::Running,
            noise: status.relative_noise(),
            reference: comparison.map(|comparison| comparison.rel_mse.sqrt()),
            efficiency: rel_mse.filter(|_| status.spp >= 2 && tells).map(|rel_mse| 1.0 / (rel_mse * seconds.max(1e-9))),
        }
    }

    fn row(&self, ui: &mut Ui) {
        let percent = |x: Option<f64>| x.map_or_else(|| "–".to_owned(), |x| format!("{:.2} %", 100.0 * x));
        ui.strong(self.letter);
        style::elided(ui, 330.0, self.name.as_str());
        let figures = [
            self.spp.to_string(),
            format!("{:.1} s", self.seconds),
            percent(self.noise),
            percent(self.reference),
            self.efficiency.map_or_else(|| "–".to_owned(), significant),
        ];
        for (figure, (_, doc)) in figures.into_iter().zip(&HEADINGS[2..]) {
            ui.monospace(figure).on_hover_text(*doc);
        }
        match &self.trouble {
            None => ui.label(RichText::new("the solution").color(ui.good())),
            Some(trouble) => ui.label(RichText::new(trouble).color(ui.warning())),
        }
        .on_hover_text(HEADINGS[7].1);
        ui.end_row();
    }
}

fn failure_of(status: &Status) -> Option<String> {
    if let State::Failed(failure) = &status.state { Some(format!("failed: {}", failure.message)) } else { None }
}

/// Why efficiencies say nothing: noise alone does not see that one side converges to another image.
fn incomparable(sides: &[Side; 2]) -> Option<String> {
    let biased = sides.iter().find(|side| side.trouble.is_some() && side.reference.is_none())?;
    let letter = biased.letter;
    Some(format!(
        "{letter} does not converge to the solution, so its efficiency cannot be compared. The layout Difference shows what is missing."
    ))
}

/// Three digits that count.
fn significant(x: f64) -> String {
    match x {
        0.01..10_000.0 => format!("{:.*}", (2.0 - x.log10().floor()).max(0.0) as usize, x),
        _ => format!("{x:.2e}"),
    }
}

/// ln of the efficiency of B over that of A. Where errors are estimated from samples that are not independent, the estimate of each side
/// has an error of its own.
fn efficiency_ratio(errors: LogRatio, sides: &[Side; 2], settings: [&RenderSettings; 2]) -> LogRatio {
    let [a, b] = sides.each_ref().map(|side| side.seconds.max(1e-9));
    let is_known = sides.iter().all(|side| side.reference.is_some());
    let guessed = settings.iter().filter(|settings| !is_known && !settings.sampler.is_independent()).count();
    let model_error = (guessed as f64).sqrt() * MODEL_ERROR;
    LogRatio { value: errors.value + (a / b).ln(), model_error, ..errors }
}

/// Which is better, and what that means. `ratio` is the efficiency of B over that of A.
fn verdict(ratio: Option<LogRatio>) -> (String, String) {
    const EXPLANATION: &str = "95 % confidence interval by the jackknife over blocks of 32 × 32 pixels.";
    let Some(ratio) = ratio else {
        return ("No difference yet.".to_owned(), "The images have no estimated error, or are too small to tell.".to_owned());
    };
    let (better, other) = if ratio.value > 0.0 { ("B", "A") } else { ("A", "B") };
    let [ratio, low, high] = LogRatio { value: ratio.value.abs(), ..ratio }.interval();
    let is_clear = low > 1.0;
    let [ratio, low, high] = [ratio, low, high].map(times);
    let interval = format!("{ratio} times as efficient (95 % interval {low} to {high})");
    if is_clear {
        let cost = format!("{other} needs {ratio} times the time for the same error, which falls as 1/√time.");
        (format!("{better} is {interval}."), format!("{cost} {EXPLANATION}"))
    } else {
        (format!("No difference yet: {better} seems {interval}."), format!("The interval contains 1. {EXPLANATION}"))
    }
}

/// A ratio with two digits that count.
fn times(ratio: f64) -> String {
    match ratio {
        ratio if ratio < 2.0 => format!("{ratio:.2}"),
        ratio if ratio < 10.0 => format!("{ratio:.1}"),
        ratio if ratio < 1e4 => format!("{ratio:.0}"),
        ratio => format!("{ratio:.1e}"),
    }
}

#[cfg(test)]
mod tests {
    use noisefall_scene::sampling::Sampler;

    use super::*;

    fn side(status: &Status, settings: &RenderSettings, reference: Option<f64>) -> Side {
        let comparison = reference.map(|rel_mse| ReferenceComparison { rel_mse, bias: None });
        Side::of("A", "a name".to_owned(), settings, SideStatus { status, comparison })
    }

    #[test]
    fn a_head_start_counts_where_it_is_large() {
        let started = |seconds: f64| {
            let elapsed = std::time::Duration::from_secs_f64(seconds);
            side(&Status { spp: 7, elapsed, ..Status::default() }, &RenderSettings::default(), None)
        };
        for (a, b, apart) in [(10.0, 11.4, false), (11.6, 10.0, true), (0.1, 0.6, false), (0.7, 0.1, true)] {
            assert_eq!(head_start(&[a, b].map(started)).is_some(), apart, "{a} {b}");
        }
    }

    #[test]
    fn efficiency_is_one_over_rel_mse_and_seconds() {
        let elapsed = std::time::Duration::from_millis(2500);
        let status = Status { spp: 7, elapsed, rel_mse_estimate: Some(0.0016), ..Status::default() };
        let unbiased = RenderSettings::default();
        let is =
            |found: Option<f64>, exact: f64| assert!(found.is_some_and(|x| (x / exact - 1.0).abs() < 1e-12), "{found:?} {exact}");
        let estimated = side(&status, &unbiased, None);
        is(estimated.efficiency, 1.0 / (0.0016 * 2.5));
        is(estimated.noise, 0.04);
        assert!(estimated.reference.is_none() && estimated.trouble.is_none() && estimated.spp == 7 && estimated.seconds == 2.5);
        // A known error counts instead of an estimated one.
        let known = side(&status, &unbiased, Some(0.0025));
        is(known.efficiency, 1.0 / (0.0025 * 2.5));
        is(known.reference, 0.05);
        // Noise alone does not see bias, and one sample not even noise.
        let capped = RenderSettings { max_bounces: Some(2), ..unbiased };
        assert!(side(&status, &capped, None).efficiency.is_none());
        is(side(&status, &capped, Some(0.0025)).efficiency, 160.0);
        assert!(side(&Status { spp: 1, ..status.clone() }, &unbiased, None).efficiency.is_none());
        assert!(side(&Status { rel_mse_estimate: Some(0.0), ..status.clone() }, &unbiased, None).efficiency.is_none());
        let of = |settings, truth| [side(&status, &unbiased, truth), side(&status, settings, truth)];
        assert!(incomparable(&of(&capped, None)).is_some_and(|text| text.starts_with('A')));
        assert!(incomparable(&of(&capped, Some(0.1))).is_none() && incomparable(&of(&unbiased, None)).is_none());
    }

    #[test]
    fn three_digits_count() {
        assert_eq!(
            [0.012_34, 1.0, 160.0, 9999.4, 12_345.0, 0.001].map(significant),
            ["0.0123", "1.00", "160", "9999", "1.23e4", "1.00e-3"]
        );
    }

    fn ratio(value: f64, standard_error: f64) -> Option<LogRatio> {
        Some(LogRatio { value: value.ln(), standard_error, degrees: 1e6, model_error: 0.0 })
    }

    #[test]
    fn the_verdict_names_the_better_one_when_its_interval_excludes_1() {
        // exp(±1.96 · 0.1) = 0.82, 1.22.
        assert_eq!(verdict(ratio(3.0, 0.1)).0, "B is 3.0 times as efficient (95 % interval 2.5 to 3.6).");
        let (text, more) = verdict(ratio(1.0 / 12.0, 0.1));
        assert_eq!(text, "A is 12 times as efficient (95 % interval 9.9 to 15).");
        assert!(more.starts_with("B needs 12 times the time"), "{more}");
        assert_eq!(
            verdict(ratio(1.2, 0.1)).0,
            "No difference yet: B seems 1.20 times as efficient (95 % interval 0.99 to 1.46)."
        );
        assert!(verdict(ratio(0.82, 0.1)).0.starts_with("A is 1.22 times as efficient (95 % interval 1.00 to "));
        assert!(verdict(None).0.starts_with("No difference yet"));
    }

    #[test]
    fn efficiencies_differ_by_error_and_time_and_guesses_widen_their_interval() {
        let status = |seconds| Status { spp: 7, elapsed: std::time::Duration::from_secs(seconds), ..Status::default() };
        let sobol = RenderSettings::default();
        let independent = RenderSettings { sampler: Sampler::Independent, ..sobol };
        let (short, long) = (status(2), status(8));
        let sides = |truth| [side(&short, &sobol, truth), side(&long, &sobol, truth)];
        let errors = ratio(3.0, 0.1).expect("it is one");
        let of = |truth, settings: [&RenderSettings; 2]| efficiency_ratio(errors, &sides(truth), settings);
        assert!((of(None, [&sobol; 2]).value - (3.0f64 / 4.0).ln()).abs() < 1e-12, "A took a quarter of the time");
        let model =
            [of(None, [&sobol; 2]), of(None, [&sobol, &independent]), of(None, [&independent; 2]), of(Some(0.1), [&sobol; 2])];
        let [both, one, none, known] = model.map(|ratio| ratio.model_error);
        assert!((both - 2f64.sqrt() * MODEL_ERROR).abs() < 1e-12 && one == MODEL_ERROR && (none, known) == (0.0, 0.0));
    }
}
