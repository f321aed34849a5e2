//! A direction sampled towards a primitive.
use noisefall_base::math::{F, Lanes, M, Pick, V};

/// A sampled direction towards a primitive.
pub struct DirectionSample<L: Lanes> {
    /// Unit.
    pub wi: V<L>,
    /// Pdf per solid angle; 0 if there is no direction.
    pub pdf: F<L>,
    /// Lanes whose direction hits the front of the primitive first.
    pub front: M<L>,
}

impl<L: Lanes> Pick<DirectionSample<L>> for M<L> {
    #[inline(always)]
    fn pick(self, a: DirectionSample<L>, b: DirectionSample<L>) -> DirectionSample<L> {
        DirectionSample { wi: self.pick(a.wi, b.wi), pdf: self.pick(a.pdf, b.pdf), front: (self & a.front) | (!self & b.front) }
    }
}
