//! The candidate settings, in two stages. Trying all combinations would take too long.
use super::Advice;
use noisefall_scene::{
    sampling::Sampler,
    scene::{Estimator, RenderSettings, Reuse, Roulette},
};

/// Roulettes to try. `off` is left out unless it is in use, because paths may become very long.
const ROULETTES: [Roulette; 4] =
    [Roulette::by_throughput_from(2), Roulette::BY_THROUGHPUT, Roulette::by_throughput_from(8), Roulette::fixed(0.8)];

/// Estimators to try: all but `auto`, which is one of the others.
const ESTIMATORS: [Estimator; 6] =
    [Estimator::Path, Estimator::Light, Estimator::Mis, Estimator::Caustics, Estimator::LightTracing, Estimator::Bidirectional];

/// The settings in use and each sampler.
pub const MOST_OF_SECOND_STAGE: usize = 1 + Sampler::ALL.len();

/// The settings in use, then those with another roulette, another estimator or one of `other_reuses`.
pub fn first_stage(in_use: &RenderSettings, other_reuses: &[Reuse]) -> Vec<RenderSettings> {
    let roulettes = ROULETTES.map(|roulette| RenderSettings { roulette, ..*in_use });
    let estimators = ESTIMATORS.map(|estimator| RenderSettings { estimator, ..*in_use });
    let reuse = other_reuses.iter().map(|&reuse| RenderSettings { reuse, ..*in_use });
    each_once(in_use, roulettes.into_iter().chain(estimators).chain(reuse))
}

/// The settings in use, then `base` with each sampler.
pub fn second_stage(in_use: &RenderSettings, base: &RenderSettings) -> Vec<RenderSettings> {
    each_once(in_use, Sampler::ALL.map(|sampler| RenderSettings { sampler, ..*base }))
}

fn each_once(first: &RenderSettings, others: impl IntoIterator<Item = RenderSettings>) -> Vec<RenderSettings> {
    let mut all = vec![*first];
    for settings in others {
        if !all.contains(&settings) {
            all.push(settings);
        }
    }
    all
}

/// The settings in use with the best roulette, estimator and path reuse of the first stage. They change only what is clearly better.
pub fn adopted(advice: &Advice) -> RenderSettings {
    let in_use = advice.candidates[advice.current].settings;
    [RenderSettings::ROULETTE, RenderSettings::ESTIMATOR, RenderSettings::REUSE].into_iter().fold(in_use, |base, setting| {
        let differs_in_it_alone = |settings: &RenderSettings| setting.with(&in_use, settings) == *settings;
        let mut better = advice.candidates.iter().filter(|candidate| candidate.is_clearly_better());
        let best = better.find(|candidate| differs_in_it_alone(&candidate.settings));
        best.map_or(base, |best| setting.with(&base, &best.settings))
    })
}
