//! Distributions of microfacet normals.
//!
//! Rough materials are generic over [`Microfacets`]: GGX by its [width](ggx::Width), and [`Beckmann`] of such a width. Stages of GGX facets alone
//! contain nothing of the other.
pub use super::beckmann::Beckmann;
use super::{anisotropy::Widths, ggx};
use crate::{
    declare::{Parameter, words},
    math::{F, Lanes, M, Pick, V},
};

/// A distribution of microfacet normals in a scene description.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Distribution {
    /// GGX.
    #[default]
    Ggx,
    /// Beckmann.
    Beckmann,
}

words! {
    Distribution {
        Ggx: "ggx", "GGX", "A sharp peak with a wide glow.";
        Beckmann: "beckmann", "Beckmann", "Normally distributed slopes: no glow around the highlight.";
    }
}

/// The key of the distribution of conductors and dielectrics.
pub const DISTRIBUTION: Parameter = Parameter::new(
    "distribution",
    "Distribution of the microfacets; the light that scatters more than once between Beckmann facets is lost.",
)
.aliases("facets microfacets ndf");

/// Microfacets of a known width. Directions are in the local frame.
pub trait Microfacets<L: Lanes>: Copy {
    /// Density of microfacet area over normals `h`, h.z ≥ 0: ∫ D(h) h.z dh = 1.
    fn d(self, h: V<L>) -> F<L>;
    /// Smith's G1(w)/|cos θ|, which stays finite at grazing angles.
    fn g1_over_cos(self, w: V<L>) -> F<L>;
    /// Samples a microfacet normal visible from `wo` (wo.z > 0) with the pdf of [`ggx::visible_normal_pdf`]; u.0 < 1.
    fn sample_visible_normal(self, wo: V<L>, u: (F<L>, F<L>)) -> V<L>;
}

macro_rules! ggx {
    ($($Width:ty)*) => { $(
        impl<L: Lanes> Microfacets<L> for $Width {
            #[inline(always)]
            fn d(self, h: V<L>) -> F<L> {
                ggx::d(self, h)
            }

            #[inline(always)]
            fn g1_over_cos(self, w: V<L>) -> F<L> {
                ggx::g1_over_cos(self, w)
            }

            #[inline(always)]
            fn sample_visible_normal(self, wo: V<L>, u: (F<L>, F<L>)) -> V<L> {
                ggx::sample_visible_normal(self, wo, u)
            }
        }
    )* };
}
ggx!(F<L> Widths<L>);

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
