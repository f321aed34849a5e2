//! Findings as sentences and numbers, for the report and the terminal.
use std::fmt;

use super::{Eligibility, Findings, Outcome, Slope, labels::label, outcome::MeanError};
use noisefall_render::render::settings_text::options;

/// Formats a number with three significant digits.
pub fn significant(x: f64) -> String {
    let digits = if x == 0.0 { 0.0 } else { x.abs().log10().floor() };
    match digits {
        d if (-3.0..5.0).contains(&d) => format!("{x:.*}", (2.0 - d).max(0.0) as usize),
        _ if x.is_finite() => format!("{x:.2e}"),
        _ => "–".to_owned(),
    }
}

/// The root of a relMSE, as a percentage.
pub fn percent(rel_mse: f64) -> String {
    format!("{} %", significant(100.0 * rel_mse.sqrt()))
}

/// The error at the end of the curve.
pub fn error(outcome: &Outcome) -> String {
    if outcome.is_exact() { "no noise".to_owned() } else { percent(outcome.last().rel_mse) }
}

pub fn slope(slope: Option<Slope>) -> String {
    slope.map_or_else(|| "–".to_owned(), |slope| exponent(slope).join(" ± "))
}

/// An exponent and half the width of its interval, as texts.
pub fn exponent(Slope { slope, half_width }: Slope) -> [String; 2] {
    [format!("{slope:.2}").replace('-', "−"), format!("{half_width:.2}")]
}

/// A mean and its standard error, if that is known, as one text.
pub fn mean_error(error: MeanError) -> String {
    match mean_and_error(error) {
        (mean, Some(standard_error)) => format!("{mean} ± {standard_error}"),
        (mean, None) => mean,
    }
}

/// A mean and its standard error, if that is known, rounded to two digits of the standard error.
pub fn mean_and_error(MeanError { mean, standard_error, .. }: MeanError) -> (String, Option<String>) {
    let minus = |text: String| text.replace('-', "−");
    if !(standard_error > 0.0 && standard_error.is_finite()) {
        return (minus(format!("{mean:+.1e}")), None);
    }
    let power = standard_error.log10().floor() as i32 - 1;
    match power {
        -6..0 => {
            let digits = power.unsigned_abs() as usize;
            (minus(format!("{mean:+.digits$}")), Some(format!("{standard_error:.digits$}")))
        }
        _ => (minus(format!("{mean:+.1e}")), Some(minus(format!("{standard_error:.1e}")))),
    }
}

/// The best settings, in one sentence.
pub fn verdict(findings: &Findings) -> String {
    let Some(best) = findings.best() else {
        return "No combination is unbiased and clearly closer to the reference than a black image: take more samples."
            .to_owned();
    };
    let (last, settings) = (best.last(), label(&best.settings));
    let place = match findings.rivals().count() {
        0 => "Best".to_owned(),
        rivals => format!("First of {} that cannot be told apart", rivals + 1),
    };
    let seconds = significant(last.seconds);
    if best.is_exact() {
        return format!("{place}: {settings} – no noise but rounding from the first sample on, which takes {seconds} s.");
    }
    format!("{place}: {settings} – an error of {} after {seconds} s ({} samples per pixel).", error(best), last.spp)
}

/// The uncertainty of the verdict, and the gain.
pub fn certainty(findings: &Findings) -> String {
    let Some(best) = findings.best() else { return String::new() };
    let lead = findings.outcomes.get(1).filter(|next| next.eligibility == best.eligibility).and_then(|next| findings.ratio(next));
    let lead = lead.map(f64::recip);
    let mut text = match (findings.uncertainty(), lead) {
        (_, None) if best.is_exact() => "All others have noise.".to_owned(),
        (_, None) => "No other combination is ranked.".to_owned(),
        (None, Some(lead)) => {
            format!("It is {} times as efficient as the next; a single repeat gives no confidence interval.", significant(lead))
        }
        (Some(factor), Some(lead)) if findings.rivals().next().is_none() => {
            let [low, lead, high] = [lead / factor, lead, lead * factor].map(significant);
            format!("It is {lead} times as efficient as the next (95 %, by the spread of repeats: {low} to {high}).")
        }
        (Some(factor), Some(_)) => format!(
            "By the spread of repeats, ratios of efficiencies are known to a factor of {} (95 %). These cannot be told apart from it: {}.",
            significant(factor),
            some_of(findings.rivals().map(|outcome| label(&outcome.settings)).collect())
        ),
    };
    if let Some(own) = findings.find(&findings.of_scene).filter(|own| own.settings != best.settings)
        && let Some(ratio) = findings.ratio(own)
    {
        text.push_str(&format!(
            " The scene opens with {}, which has {} of the efficiency.",
            label(&own.settings),
            significant(ratio)
        ));
    }
    text
}

/// The first of many names, and the number of the others.
fn some_of(names: Vec<String>) -> String {
    const SHOWN: usize = 3;
    let more = names.len().saturating_sub(SHOWN);
    let shown: Vec<String> = names.into_iter().take(SHOWN).collect();
    if more == 0 { shown.join("; ") } else { format!("{}; and {more} more", shown.join("; ")) }
}

/// The command that renders with the best settings.
pub fn command(findings: &Findings) -> Option<String> {
    let best = findings.best()?;
    Some(format!("noisefall render {} -o image.exr{}", findings.path.display(), options(&best.settings, &findings.of_scene)))
}

/// A line of the table.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let last = self.last();
        write!(f, "{}: {} after {} s, {} spp", label(&self.settings), error(self), significant(last.seconds), last.spp)?;
        if self.bias.is_empty() { Ok(()) } else { write!(f, ", biased: {}", self.bias) }
    }
}

/// The best combinations as a table for the terminal.
pub fn table(findings: &Findings) -> String {
    const PLACES: usize = 5;
    let cells = |outcome: &Outcome| {
        let remark = if outcome.eligibility == Eligibility::Sound { "" } else { "not ranked" };
        let ratio = findings.ratio(outcome).map_or_else(|| "–".to_owned(), significant);
        let last = outcome.last();
        let [seconds, efficiency] = [last.seconds, outcome.efficiency()].map(significant);
        [
            label(&outcome.settings),
            last.spp.to_string(),
            seconds,
            error(outcome),
            slope(outcome.slope),
            efficiency,
            ratio,
            remark.to_owned(),
        ]
    };
    let heading = ["settings", "spp", "s", "error", "slope", "efficiency", "of best", ""].map(str::to_owned);
    let rows: Vec<[String; 8]> = std::iter::once(heading).chain(findings.outcomes.iter().take(PLACES).map(cells)).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let line = |row: &[String; 8]| {
        let padded = row.iter().enumerate().map(|(column, cell)| match column {
            0 => format!("{cell:<0$}", width(0)),
            _ => format!("{cell:>0$}", width(column)),
        });
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}
