//! A direction sampled towards a primitive.
use crate::math::{F, Lanes, M, Pick, V};

/// A sampled direction towards a primitive.
pub struct Toward<L: Lanes> {
    /// Unit.
    pub wi: V<L>,
    /// Pdf per solid angle; 0 if there is no direction.
    pub pdf: F<L>,
    /// Lanes whose direction hits the front of the primitive first.
    pub front: M<L>,
}

impl<L: Lanes> Pick<Toward<L>> for M<L> {
    #[inline(always)]
    fn pick(self, a: Toward<L>, b: Toward<L>) -> Toward<L> {
        Toward { wi: self.pick(a.wi, b.wi), pdf: self.pick(a.pdf, b.pdf), front: (self & a.front) | (!self & b.front) }
    }
}
