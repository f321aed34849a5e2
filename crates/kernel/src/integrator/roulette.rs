//! Russian roulette (Arvo and Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990).
//!
//! A path survives with probability p and is then weighted by 1/p: the mean is that of the infinite path, at finite cost.
use noisefall_base::math::{F, Lanes, M, V};
use noisefall_scene::scene::Roulette;

/// The result of Russian roulette.
pub(super) struct Survivors<L: Lanes> {
    pub alive: M<L>,
    /// Throughput of the survivors.
    pub throughput: V<L>,
    /// Survival probability; 1 without roulette.
    pub probability: F<L>,
}

/// Plays Russian roulette after the `reflection`-th reflection with the random number `u`, which is read if roulette
/// [is played](Roulette::plays_at). Roulette by throughput uses the throughput times `scale`.
#[inline(always)]
pub(super) fn survive<L: Lanes>(
    l: L,
    roulette: Roulette,
    reflection: u32,
    u: F<L>,
    throughput: V<L>,
    scale: F<L>,
) -> Survivors<L> {
    if !roulette.plays_at(reflection) {
        // Below the normal numbers an albedo above 1/2 rounds the throughput back to what it was: such a path would never end.
        return Survivors { alive: throughput.max_component().above(f32::MIN_POSITIVE), throughput, probability: l.f(1.0) };
    }
    let p = roulette.probability(l, throughput, scale);
    Survivors { alive: u.lt(p), throughput: throughput * (1.0 / p), probability: p }
}
