//! What was found, in sentences and numbers, for report and terminal alike.
use std::fmt;

use super::{Findings, Outcome, Slope, Standing, setting::label};
use crate::render::settings_text::options;

/// Three digits.
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

/// The error of the last picture.
pub fn error(outcome: &Outcome) -> String {
    if outcome.is_exact() { "no noise".to_owned() } else { percent(outcome.last().rel_mse) }
}

pub fn slope(slope: Option<Slope>) -> String {
    slope.map_or_else(|| "–".to_owned(), |Slope { slope, half_width }| format!("{slope:.2} ± {half_width:.2}").replace('-', "−"))
}

/// Which settings are best, in one sentence.
pub fn verdict(findings: &Findings) -> String {
    let Some(best) = findings.best() else {
        return "No combination is both unbiased and clearly nearer to the reference than a black picture: more samples are needed."
            .to_owned();
    };
    let seconds = significant(best.last().seconds);
    let spp = best.last().spp;
    let reached = if best.is_exact() {
        format!("its picture has no noise, only rounding, and {spp} samples a pixel take {seconds} s")
    } else {
        format!("an error of {} after {seconds} s ({spp} samples a pixel)", error(best))
    };
    format!("Best: {} – {reached}.", label(&best.settings))
}

/// How sure the verdict is, and what it gains.
pub fn certainty(findings: &Findings) -> String {
    let Some(best) = findings.best() else { return String::new() };
    let rivals: Vec<String> = findings.rivals().map(|outcome| label(&outcome.settings)).collect();
    let next = findings.outcomes.get(1).filter(|next| next.standing == best.standing);
    let lead = next.map(|next| 1.0 / findings.ratio(next));
    let mut text = match (findings.uncertainty(), lead) {
        (_, None) => "No other combination can be compared with it.".to_owned(),
        (None, Some(lead)) => {
            format!("It is {} times as efficient as the next; how sure that is, a single repeat cannot tell.", significant(lead))
        }
        (Some(factor), Some(lead)) if rivals.is_empty() => {
            let (low, high) = (significant(lead / factor), significant(lead * factor));
            format!("It is {} times as efficient as the next (95 %: {low} to {high}).", significant(lead))
        }
        (Some(factor), Some(_)) => {
            let shown = rivals.iter().take(3).cloned().collect::<Vec<_>>().join("; ");
            let more = if rivals.len() > 3 { format!("; and {} more", rivals.len() - 3) } else { String::new() };
            let spread = significant(100.0 * (factor - 1.0));
            format!(
                "Ratios are known to {spread} % (95 %, from repeats), and within that {} as good: {shown}{more}.",
                others(rivals.len())
            )
        }
    };
    if let Some(own) = findings.find(&findings.of_scene).filter(|own| own.settings != best.settings) {
        text.push_str(&format!(" What the scene opens with has {} of its efficiency.", significant(findings.ratio(own))));
    }
    text
}

fn others(count: usize) -> String {
    if count == 1 { "one other is".to_owned() } else { format!("{count} others are") }
}

/// The command that renders with the best settings.
pub fn command(findings: &Findings) -> Option<String> {
    let best = findings.best()?;
    Some(format!("noisefall render {} -o picture.exr{}", findings.path.display(), options(&best.settings, &findings.of_scene)))
}

/// One line.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let last = self.last();
        write!(f, "{}: {} after {} s, {} spp", label(&self.settings), error(self), significant(last.seconds), last.spp)?;
        if self.bias.is_empty() { Ok(()) } else { write!(f, ", biased: {}", self.bias) }
    }
}

/// The first places as lines of a table for the terminal.
pub fn table(findings: &Findings) -> String {
    const PLACES: usize = 5;
    let cells = |outcome: &Outcome| {
        let remark = if outcome.standing == Standing::Sound { "" } else { "not ranked" };
        let ratio = significant(findings.ratio(outcome));
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
