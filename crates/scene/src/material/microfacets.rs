//! Distributions of microfacet normals.
//!
//! Rough materials are generic over [`Microfacets`]: those of `ggx.rs`, of `beckmann.rs`, or of both (`either_facets.rs`). Stages of GGX
//! facets alone contain nothing of the other. Masking, pdfs and reflections are the same for all.
use noisefall_base::{
    declare::{Parameter, words},
    math::{F, Lanes, V},
};

words! {
    /// A distribution of microfacet normals in a scene description.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum Distribution {
        #[default]
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
    /// Samples a microfacet normal visible from `wo` (wo.z > 0) with the pdf of [`visible_normal_pdf`]; u.0 < 1.
    fn sample_visible_normal(self, wo: V<L>, u: (F<L>, F<L>)) -> V<L>;
}

/// Fraction of microfacets visible from direction `w`, on either side of the surface (Walter et al. 2007, equation 34).
#[inline(always)]
pub fn g1<L: Lanes>(facets: impl Microfacets<L>, w: V<L>) -> F<L> {
    w.z.abs() * facets.g1_over_cos(w)
}

/// Pdf of [`Microfacets::sample_visible_normal`] per solid angle of `h`: G1(ω_o) max(0, ω_o·h) D(h) / cos θ_o (Heitz, "Sampling the GGX
/// Distribution of Visible Normals", 2018, equation 3).
#[inline(always)]
pub fn visible_normal_pdf<L: Lanes>(facets: impl Microfacets<L>, wo: V<L>, h: V<L>) -> F<L> {
    facets.g1_over_cos(wo) * wo.dot(h).max(wo.z.splat(0.0)) * facets.d(h)
}

/// Samples a direction reflected by a visible microfacet; below the surface if the microfacet reflects light to other facets.
#[inline(always)]
pub fn sample_reflection<L: Lanes>(facets: impl Microfacets<L>, wo: V<L>, u: (F<L>, F<L>)) -> V<L> {
    let h = facets.sample_visible_normal(wo, u);
    h * (2.0 * wo.dot(h)) - wo
}

/// Pdf of [`sample_reflection`] per solid angle of the reflected direction; `h` is halfway between it and `wo`. Multiplied by
/// G1(ω_i), it is f |cos θ_i| of perfectly reflecting microfacets.
#[inline(always)]
pub fn reflection_pdf<L: Lanes>(facets: impl Microfacets<L>, wo: V<L>, h: V<L>) -> F<L> {
    0.25 * (facets.g1_over_cos(wo) * facets.d(h))
}
