//! Dielectrics whose reflected and transmitted light has a tint, or whose facets have the Beckmann distribution; smooth ones too.
//!
//! Other glass has stages of its own, so that it does not pay for these.
use super::{
    Bsdf, BsdfSample, ChosenLobe, Lobes, Local, Materials, Shade, Stage,
    anisotropic_conductor::TangentRow,
    anisotropy::Widths,
    dielectric::{DielectricBsdf, DielectricRow},
    either_facets::EitherFacets,
    ggx,
    missing_energy::{LossTable, MissingEnergy},
    refraction::uncompressed,
    rough_dielectric::RoughDielectricBsdf,
};
use crate::sampling::Directions;
use noisefall_base::math::{F, Lanes, M, One, Pick, V};

/// The stage of tinted dielectrics.
pub struct TintedDielectric;

impl Shade for TintedDielectric {
    type Bsdf<'a, L: Lanes> = TintedDielectricBsdf<'a, L>;
    const STAGE: Stage = Stage::TintedDielectric;
    const TRANSMITS: bool = true;
    const HAS_TRANSMITTANCE: bool = true;
    const CHARTED: bool = true;

    #[inline(always)]
    fn at<'a, L: Lanes>(l: L, materials: &'a Materials, _: Directions, at: &Local<L>) -> TintedDielectricBsdf<'a, L> {
        let (eta, offset, textured) = DielectricRow::read(l, materials, at);
        let beckmann = DielectricRow::read_beckmann(l, materials, at);
        let (anisotropy, _) = TangentRow::read(l, materials, at);
        let widths = Widths::new(at.alpha, anisotropy);
        let facets = EitherFacets { widths, beckmann };
        let missing = if materials.tables.compensates_dielectrics {
            let table = LossTable { rows: &materials.tables.rows, offset, textured };
            let alpha = at.alpha.max(l.f(ggx::SMOOTH));
            let turned = DielectricRow::read_turned(l, materials, at);
            let width = turned.pick(widths.larger(), alpha);
            Some(MissingEnergy::anisotropic(l, alpha, width, turned, at.front, table))
        } else {
            None
        };
        TintedDielectricBsdf {
            interface: RoughDielectricBsdf::of(eta, facets, missing),
            smooth: at.alpha.below(ggx::SMOOTH),
            reflected: at.colour,
            transmitted: V::splat(l, [1.0; 3]),
        }
    }

    #[inline(always)]
    fn turn<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> (F<L>, F<L>) {
        TangentRow::read(l, materials, at).1
    }

    #[inline(always)]
    fn with_transmittance<'a, L: Lanes>(bsdf: Self::Bsdf<'a, L>, transmittance: V<L>) -> Self::Bsdf<'a, L> {
        TintedDielectricBsdf { transmitted: transmittance, ..bsdf }
    }

    #[inline(always)]
    fn roulette_scale<L: Lanes>(bsdf: &TintedDielectricBsdf<'_, L>, front: M<L>, z: F<L>) -> F<L> {
        uncompressed(bsdf.interface.eta(), front, z)
    }

    #[inline(always)]
    fn compression_outside<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> F<L> {
        DielectricRow::read_compression(l, materials, at)
    }
}

/// The BSDF of a tinted dielectric at a point.
#[derive(Clone, Copy)]
pub struct TintedDielectricBsdf<'a, L: Lanes> {
    interface: RoughDielectricBsdf<'a, L, EitherFacets<L>>,
    /// Lanes with a smooth interface.
    smooth: M<L>,
    /// Factor of reflected light.
    reflected: V<L>,
    /// Factor of transmitted light.
    transmitted: V<L>,
}

impl<L: Lanes> TintedDielectricBsdf<'_, L> {
    #[inline(always)]
    fn tint(&self, wi: V<L>) -> V<L> {
        wi.z.below(0.0).pick(self.transmitted, self.reflected)
    }
}

impl<L: Lanes> Bsdf<L> for TintedDielectricBsdf<'_, L> {
    #[inline(always)]
    fn eval(&self, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let (f, pdf) = self.interface.eval(wo, wi);
        let zero = pdf.splat(0.0);
        (self.smooth.pick(V { x: zero, y: zero, z: zero }, f * self.tint(wi)), self.smooth.pick(zero, pdf))
    }

    #[inline(always)]
    fn sample(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let rough = self.interface.sample(wo, u, lobe);
        let mirror = DielectricBsdf { eta: self.interface.eta() }.sample(wo, u, lobe);
        let wi = self.smooth.pick(mirror.wi, rough.wi);
        let weight = self.smooth.pick(mirror.weight, rough.weight) * self.tint(wi);
        BsdfSample { wi, weight, pdf: rough.pdf, delta: self.smooth | rough.delta }
    }
}

impl Lobes for TintedDielectricBsdf<'_, One> {
    fn chosen(&self, wo: V<One>, u: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        match self.smooth {
            M(true) => DielectricBsdf { eta: self.interface.eta() }.chosen(wo, u, lobe),
            M(false) => self.interface.chosen(wo, u, lobe),
        }
    }
}
