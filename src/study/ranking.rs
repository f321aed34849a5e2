//! Which combination is best for a scene, and how sure that is.
use std::path::PathBuf;

use super::{
    fit::student_95,
    outcome::{Eligibility, Limits, Outcome},
    setting::Setting,
};
use crate::scene::RenderSettings;

/// Combinations whose efficiency is less than this part of the best say nothing of how sure the first places are.
const NEAR: f64 = 0.1;

/// All that was found about a scene.
pub struct Findings {
    /// Title of the scene.
    pub title: String,
    /// Its file.
    pub path: PathBuf,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// What the scene opens with.
    pub of_scene: RenderSettings,
    /// What errors are against.
    pub reference: String,
    /// Nothing is known of the reference's own error.
    pub reference_is_taken_for_exact: bool,
    /// Where measurements end.
    pub limits: Limits,
    /// Runs of each combination.
    pub repeats: u32,
    /// The best first; what cannot be the best comes last.
    pub outcomes: Vec<Outcome>,
}

/// What a value of a setting is worth, as parts of the best efficiency; none where that is not ranked.
pub struct SettingGain {
    pub value: String,
    /// With all other settings as in the best combination.
    pub alone: Option<f64>,
    /// With the other settings at what is best with this value.
    pub at_best: Option<f64>,
}

/// Sorts by standing, then by efficiency.
pub fn rank(outcomes: &mut [Outcome]) {
    outcomes.sort_by(|a, b| a.eligibility.cmp(&b.eligibility).then(b.efficiency().total_cmp(&a.efficiency())));
}

impl Findings {
    /// None where nothing has converged without bias.
    pub fn best(&self) -> Option<&Outcome> {
        self.outcomes.first().filter(|best| best.eligibility == Eligibility::Sound)
    }

    /// The combination that gives the picture of these settings.
    pub fn find(&self, settings: &RenderSettings) -> Option<&Outcome> {
        self.outcomes.iter().find(|outcome| outcome.alike().any(|alike| alike == settings))
    }

    /// Efficiency as a part of the best. None where there is no best, and of what has noise where the best has none.
    pub fn ratio(&self, outcome: &Outcome) -> Option<f64> {
        let best = self.best().filter(|best| best.is_exact() == outcome.is_exact())?;
        Some(outcome.efficiency() / best.efficiency())
    }

    /// [`Findings::ratio`] of what can be the best.
    fn ranked_ratio(&self, outcome: &Outcome) -> Option<f64> {
        self.ratio(outcome).filter(|_| outcome.eligibility == Eligibility::Sound)
    }

    /// [`Findings::ratio`] of what counts for how sure the ratios are.
    fn ratio_near_best(&self, outcome: &Outcome) -> Option<f64> {
        self.ranked_ratio(outcome).filter(|ratio| *ratio >= NEAR)
    }

    /// The ends of the 95 % interval of [`Findings::ratio`]: the ratio divided and multiplied by [`Findings::uncertainty`], or by a factor
    /// of its own where it is far from the best. None of the best itself, whose ratio is 1 by definition, and of what is biased.
    pub fn interval(&self, outcome: &Outcome) -> Option<[f64; 2]> {
        let best = self.best().filter(|best| best.settings != outcome.settings)?;
        let ratio = self.ratio(outcome).filter(|_| outcome.eligibility != Eligibility::Biased)?;
        let is_near = self.ratio_near_best(outcome).is_some();
        let factor = if is_near { self.uncertainty() } else { uncertainty_of_two(outcome, best) };
        factor.map(|factor| [ratio / factor, ratio * factor])
    }

    /// The shortest rendering time in seconds of those that are unbiased and have noise: after it the error of all of them is known.
    pub fn equal_time(&self) -> Option<f64> {
        let noisy = self.outcomes.iter().filter(|outcome| outcome.eligibility != Eligibility::Biased && !outcome.is_exact());
        noisy.map(|outcome| outcome.last().seconds).reduce(f64::min)
    }

    /// The factor that the ratio of two efficiencies is known to, at 95 %: from the spread of log efficiencies over repeats, taken
    /// to be the same for all combinations near the best. None for a single repeat.
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

    /// The others that may be as good as the best.
    pub fn rivals(&self) -> impl Iterator<Item = &Outcome> {
        let limit = self.uncertainty().map_or(1.0, |factor| 1.0 / factor);
        self.outcomes.iter().skip(1).take_while(move |outcome| self.ranked_ratio(outcome).is_some_and(|ratio| ratio >= limit))
    }

    /// The values of a setting, in the order of the ranking; empty where there is only one.
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

/// The factor that the ratio of the efficiencies of two is known to, at 95 %, each by its own spread over repeats: the test of B. L. Welch,
/// 1947. None for a single repeat.
fn uncertainty_of_two(a: &Outcome, b: &Outcome) -> Option<f64> {
    let parts = [a, b].map(Outcome::log_efficiency).map(|moments| (moments.variance / moments.count, moments.count - 1.0));
    let variance: f64 = parts.iter().map(|(variance, _)| variance).sum();
    let spread: f64 = parts.iter().map(|(variance, degrees)| variance * variance / degrees).sum();
    match variance {
        0.0 => Some(1.0),
        _ => (spread > 0.0).then(|| (student_95(variance * variance / spread) * variance.sqrt()).exp()),
    }
}
