//! Weights of the strategies (s, t), which tests replace by those of a single one.
use crate::{
    integrator::work::Work,
    math::{F, Lanes, U},
};

/// The weight of strategies with `s` vertices from the light and `t` from the camera: `weight`, unless a test wants one strategy alone.
#[inline(always)]
pub(super) fn weight_of<L: Lanes>(_work: &Work, _s: U<L>, _t: u32, weight: F<L>) -> F<L> {
    #[cfg(test)]
    if let Some([s, t]) = _work.settings.strategy {
        use crate::math::Pick;
        let zero = weight.splat(0.0);
        return if t == _t { _s.is(s).pick(weight.splat(1.0), zero) } else { zero };
    }
    weight
}
