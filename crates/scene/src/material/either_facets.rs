//! Facets of either distribution, for the stages in which lanes may differ.
use super::{anisotropy::Widths, beckmann::Beckmann, ggx, microfacets::Microfacets};
use noisefall_base::math::{F, Lanes, M, Pick, V};

/// Facets of either distribution, per lane.
#[derive(Clone, Copy)]
pub struct EitherFacets<L: Lanes> {
    /// Their widths.
    pub widths: Widths<L>,
    /// Lanes with Beckmann facets.
    pub beckmann: M<L>,
}

impl<L: Lanes> Microfacets<L> for EitherFacets<L> {
    #[inline(always)]
    fn d(self, h: V<L>) -> F<L> {
        let ggx = ggx::d(self.widths, h);
        if self.beckmann.any() { self.beckmann.pick(Beckmann(self.widths).d(h), ggx) } else { ggx }
    }

    #[inline(always)]
    fn g1_over_cos(self, w: V<L>) -> F<L> {
        let ggx = ggx::g1_over_cos(self.widths, w);
        if self.beckmann.any() { self.beckmann.pick(Beckmann(self.widths).g1_over_cos(w), ggx) } else { ggx }
    }

    #[inline(always)]
    fn sample_visible_normal(self, wo: V<L>, u: (F<L>, F<L>)) -> V<L> {
        let ggx = ggx::sample_visible_normal(self.widths, wo, u);
        if self.beckmann.any() { self.beckmann.pick(Beckmann(self.widths).sample_visible_normal(wo, u), ggx) } else { ggx }
    }
}
