//! Ranking of candidates by efficiency, with significance.
use super::{
    candidate::{Advice, Candidate, LEAST_GAIN},
    measured::Measured,
    wording::difference,
};
use noisefall_kernel::measure::Moments;

/// Ranks settings with at least three images of `spp` samples each. The first are those in use, which must have an image in every
/// round.
pub fn rank(measured: &[Measured], spp: u32) -> Advice {
    let in_use = &measured[0];
    let mut candidates: Vec<Candidate> = measured.iter().map(|measured| candidate(measured, in_use, spp)).collect();
    candidates.sort_by(|a, b| b.efficiency.total_cmp(&a.efficiency));
    let current = candidates.iter().position(|candidate| candidate.settings == in_use.settings).unwrap_or(0);
    let better = || (0..candidates.len()).filter(|place| candidates[*place].is_clearly_better());
    let most = better().next().map_or(0.0, |place| candidates[place].efficiency);
    let about_as_good = better().filter(|place| candidates[*place].efficiency * LEAST_GAIN >= most);
    let best = about_as_good.min_by_key(|place| candidates[*place].settings.differing(&in_use.settings).count());
    Advice { best: best.unwrap_or(current), current, candidates }
}

fn candidate(measured: &Measured, in_use: &Measured, spp: u32) -> Candidate {
    let rounds = &measured.rounds[..];
    let relative = log_relative(measured, in_use, &in_use.rounds).exp();
    let efficiency = relative / (in_use.noise(&in_use.rounds) * in_use.seconds(&in_use.rounds));
    let is_in_use = measured.settings == in_use.settings;
    Candidate {
        settings: measured.settings,
        name: difference(&measured.settings, &in_use.settings),
        efficiency: if measured.is_sound() { efficiency } else { 0.0 },
        relative: match (measured.is_sound(), in_use.is_sound()) {
            _ if is_in_use => 1.0,
            (false, _) => 0.0,
            (true, false) => f64::INFINITY,
            (true, true) => relative,
        },
        standard_error: standard_error(measured, in_use),
        rel_mse: measured.rel_mse(rounds).max(measured.missing),
        misses_light: measured.misses_light(),
        seconds: measured.seconds(rounds),
        spp,
        rounds: rounds.len(),
    }
}

/// ln of the efficiency relative to that of the settings in use, from some of the rounds.
///
/// Times are compared within a round, so a slow round cancels. Noise is taken over all rounds, because rare samples of the
/// settings in use must not make candidates differ that were tried in different rounds.
fn log_relative(measured: &Measured, in_use: &Measured, rounds: &[u32]) -> f64 {
    let own: Vec<u32> = rounds.iter().copied().filter(|round| measured.rounds.contains(round)).collect();
    let (noise, seconds) = (in_use.noise(rounds) / measured.noise(&own), in_use.seconds(&own) / measured.seconds(&own));
    (noise * seconds).ln()
}

/// The standard error of [`log_relative`] by the jackknife, from estimates that leave one round out (J. W. Tukey, 1958; for
/// variances R. G. Miller, "Jackknifing Variances", 1968). It runs separately over the rounds of the candidate and over those
/// that only the settings in use have.
fn standard_error(measured: &Measured, in_use: &Measured) -> f64 {
    let without = |left_out: &u32| {
        let rest: Vec<u32> = in_use.rounds.iter().copied().filter(|round| round != left_out).collect();
        log_relative(measured, in_use, &rest)
    };
    let (own, others): (Vec<u32>, Vec<u32>) = in_use.rounds.iter().partition(|round| measured.rounds.contains(round));
    let squared = |rounds: Vec<u32>| {
        let spread = Moments::of(rounds.iter().map(without));
        if spread.count > 1.0 { (spread.count - 1.0).powi(2) * spread.variance / spread.count } else { 0.0 }
    };
    (squared(own) + squared(others)).sqrt()
}
