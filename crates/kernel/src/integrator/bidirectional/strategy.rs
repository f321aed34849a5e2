//! Weights of the strategies (s, t), all or a single one.
use crate::integrator::work::Work;
use noisefall_base::math::{F, Lanes, Pick, U};

/// The weight of strategies with `s` vertices from the light and `t` from the camera: `weight`, unless one strategy alone is wanted.
#[inline(always)]
pub(super) fn weight_of<L: Lanes>(work: &Work, s: U<L>, t: u32, weight: F<L>) -> F<L> {
    let Some(only) = work.settings.strategy else { return weight };
    let zero = weight.splat(0.0);
    let alone = if only.weighted { weight } else { weight.splat(1.0) };
    if t == only.t { s.is(only.s).pick(alone, zero) } else { zero }
}
