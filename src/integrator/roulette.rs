//! Russian roulette (Arvo and Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990).
//!
//! A path survives with probability p and is then weighted by 1/p: the mean is that of the endless path, at finite cost.
use crate::{
    math::{F, Lanes, M, V},
    sampling::{Dimension, Stream},
    scene::Roulette,
};

/// The paths that survive their `reflection`-th reflection, and the throughput of the survivors. Roulette by throughput judges
/// the throughput times `scale`.
#[inline(always)]
pub(super) fn survive<L: Lanes>(
    l: L,
    roulette: Roulette,
    reflection: u32,
    stream: &Stream<L>,
    throughput: V<L>,
    scale: F<L>,
) -> (M<L>, V<L>) {
    match roulette {
        Roulette::Fixed(p) if p < 1.0 => play(reflection, stream, throughput, l.f(p)),
        Roulette::Throughput { start } if reflection >= start => {
            let p = (throughput.max_component() * scale).min(l.f(Roulette::MOST)).max(l.f(Roulette::LEAST));
            play(reflection, stream, throughput, p)
        }
        // Without roulette a path ends when its throughput has become zero.
        _ => (throughput.max_component().above(0.0), throughput),
    }
}

#[inline(always)]
fn play<L: Lanes>(reflection: u32, stream: &Stream<L>, throughput: V<L>, p: F<L>) -> (M<L>, V<L>) {
    let u = stream.one(Dimension::roulette(reflection));
    (u.lt(p), throughput * (1.0 / p))
}
