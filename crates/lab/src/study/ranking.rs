//! Ranking of the combinations for a scene, with its uncertainty.
use std::path::PathBuf;

use super::outcome::{Eligibility, Limits, Outcome};
use noisefall_kernel::measure::student_95;
use noisefall_scene::scene::{RenderSettings, Setting};

/// Combinations with less than this fraction of the best efficiency do not count for the uncertainty of the first places.
const NEAR: f64 = 0.1;

/// Results of a study for one scene.
pub struct Findings {
    /// Title of the scene.
    pub title: String,
    /// Its file.
    pub path: PathBuf,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// The settings of the scene.
    pub of_scene: RenderSettings,
    /// Name of the reference.
    pub reference: String,
    /// The reference's own error is unknown and assumed to be 0.
    pub reference_is_taken_for_exact: bool,
    /// Limits of the measurable error.
    pub limits: Limits,
    /// Runs of each combination.
    pub repeats: u32,
    /// The outcomes from best to worst, then those that are not ranked.
    pub outcomes: Vec<Outcome>,
}

/// Efficiency with one value of a setting, relative to the best; `None` if that combination is not ranked.
pub struct SettingGain {
    pub value: String,
    /// Efficiency with all other settings as in the best combination.
    pub alone: Option<f64>,
    /// Efficiency with the other settings that are best with this value.
    pub at_best: Option<f64>,
}

/// Sorts by eligibility, then by efficiency.
pub fn rank(outcomes: &mut [Outcome]) {
    outcomes.sort_by(|a, b| a.eligibility.cmp(&b.eligibility).then(b.efficiency().total_cmp(&a.efficiency())));
}

impl Findings {
    /// The best combination; `None` if none is ranked.
    pub fn best(&self) -> Option<&Outcome> {
        self.outcomes.first().filter(|best| best.eligibility == Eligibility::Sound)
    }

    /// The outcome whose image is that of these settings.
    pub fn find(&self, settings: &RenderSettings) -> Option<&Outcome> {
        self.outcomes.iter().find(|outcome| outcome.alike().any(|alike| alike == settings))
    }

    /// Efficiency relative to the best. `None` if there is no best, or if only the best is free of noise.
    pub fn ratio(&self, outcome: &Outcome) -> Option<f64> {
        let best = self.best().filter(|best| best.is_exact() == outcome.is_exact())?;
        Some(outcome.efficiency() / best.efficiency())
    }

    /// [`Findings::ratio`] of a ranked combination.
    fn ranked_ratio(&self, outcome: &Outcome) -> Option<f64> {
        self.ratio(outcome).filter(|_| outcome.eligibility == Eligibility::Sound)
    }

    /// [`Findings::ratio`] of a combination that counts for the uncertainty.
    fn ratio_near_best(&self, outcome: &Outcome) -> Option<f64> {
        self.ranked_ratio(outcome).filter(|ratio| *ratio >= NEAR)
    }

    /// The 95 % interval of [`Findings::ratio`]: the ratio divided and multiplied by [`Findings::uncertainty`], or by a factor of
    /// its own if it is far from the best. `None` for the best itself, whose ratio is 1 by definition, and for biased
    /// combinations.
    pub fn interval(&self, outcome: &Outcome) -> Option<[f64; 2]> {
        let best = self.best().filter(|best| best.settings != outcome.settings)?;
        let ratio = self.ratio(outcome).filter(|_| outcome.eligibility != Eligibility::Biased)?;
        let is_near = self.ratio_near_best(outcome).is_some();
        let factor = if is_near { self.uncertainty() } else { uncertainty_of_two(outcome, best) };
        factor.map(|factor| [ratio / factor, ratio * factor])
    }

    /// The shortest rendering time, in seconds, of the unbiased combinations with noise. At that time all their errors are known.
    pub fn equal_time(&self) -> Option<f64> {
        let noisy = self.outcomes.iter().filter(|outcome| outcome.eligibility != Eligibility::Biased && !outcome.is_exact());
        noisy.map(|outcome| outcome.last().seconds).reduce(f64::min)
    }

    /// Uncertainty factor of the ratio of two efficiencies, at 95 %, from the spread of log efficiencies over repeats, which is
    /// assumed to be the same for all combinations near the best. `None` for a single repeat.
    pub fn uncertainty(&self) -> Option<f64> {
        let near = self.outcomes.iter().filter(|outcome| self.ratio_near_best(outcome).is_some());
        let (mut squares, mut degrees) = (0.0, 0.0);
        for moments in near.map(Outcome::log_efficiency).filter(|moments| moments.count > 1.0) {
            squares += moments.variance * (moments.count - 1.0);
            degrees += moments.count - 1.0;
        }
        let error_of_difference = (squares / degrees * 2.0 / f64::from(self.repeats)).sqrt();
        (degrees > 0.0).then(|| (student_95(degrees) * error_of_difference).exp())
    }

    /// The other combinations that may be as good as the best.
    pub fn rivals(&self) -> impl Iterator<Item = &Outcome> {
        let limit = self.uncertainty().map_or(1.0, |factor| 1.0 / factor);
        self.outcomes.iter().skip(1).take_while(move |outcome| self.ranked_ratio(outcome).is_some_and(|ratio| ratio >= limit))
    }

    /// The gains of all values of a setting, in the order of the ranking; empty if there is only one value.
    pub fn gains(&self, setting: Setting) -> Vec<SettingGain> {
        let mut values: Vec<SettingGain> = Vec::new();
        let Some(best) = self.best() else { return values };
        for outcome in &self.outcomes {
            for settings in outcome.alike() {
                let value = setting.value(settings);
                if values.iter().all(|gain| gain.value != value) {
                    let alone = self.find(&setting.with(&best.settings, settings)).and_then(|alone| self.ranked_ratio(alone));
                    values.push(SettingGain { value, alone, at_best: self.ranked_ratio(outcome) });
                }
            }
        }
        if values.len() > 1 { values } else { Vec::new() }
    }
}

/// Uncertainty factor of the ratio of two efficiencies, at 95 %, each with its own spread over repeats (B. L. Welch, 1947).
/// `None` for a single repeat.
fn uncertainty_of_two(a: &Outcome, b: &Outcome) -> Option<f64> {
    let parts = [a, b].map(Outcome::log_efficiency).map(|moments| (moments.variance / moments.count, moments.count - 1.0));
    let variance: f64 = parts.iter().map(|(variance, _)| variance).sum();
    let spread: f64 = parts.iter().map(|(variance, degrees)| variance * variance / degrees).sum();
    match variance {
        0.0 => Some(1.0),
        _ => (spread > 0.0).then(|| (student_95(variance * variance / spread) * variance.sqrt()).exp()),
    }
}
