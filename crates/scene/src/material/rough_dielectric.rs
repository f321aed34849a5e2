//! The rough dielectric: microfacets that reflect and refract.
//!
//! Walter, Marschner, Li and Torrance, "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, with GGX facets
//! sampled by visible normals, and with energy compensation (`missing_energy.rs`).
use super::{
    Bsdf, BsdfSample, ChosenLobe, Lobes, Local, Materials, Shade, Stage,
    dielectric::{DielectricBsdf, DielectricRow},
    fresnel, ggx,
    microfacets::{self, Microfacets},
    missing_energy::{LossTable, MissingEnergy},
    refraction::{FAINT, uncompressed},
};
use crate::sampling::Directions;
use noisefall_base::math::{F, Lanes, M, One, Pick, V};

/// The stage of rough dielectrics.
pub struct RoughDielectric;

impl Shade for RoughDielectric {
    type Bsdf<'a, L: Lanes> = RoughDielectricBsdf<'a, L>;
    const STAGE: Stage = Stage::RoughDielectric;
    const TRANSMITS: bool = true;

    #[inline(always)]
    fn at<'a, L: Lanes>(l: L, materials: &'a Materials, _: Directions, at: &Local<L>) -> RoughDielectricBsdf<'a, L> {
        RoughDielectricBsdf::at(l, materials, at)
    }

    #[inline(always)]
    fn roulette_scale<L: Lanes>(bsdf: &RoughDielectricBsdf<L>, front: M<L>, z: F<L>) -> F<L> {
        uncompressed(bsdf.eta(), front, z)
    }

    #[inline(always)]
    fn compression_outside<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> F<L> {
        DielectricRow::read_compression(l, materials, at)
    }
}

/// The rough interface between two transparent media; radiance that passes is scaled by 1/η² as in [`DielectricBsdf`].
#[derive(Clone, Copy)]
pub struct RoughDielectricBsdf<'a, L: Lanes, D = F<L>> {
    eta: F<L>,
    facets: D,
    missing: Option<MissingEnergy<'a, L>>,
}

impl<'a, L: Lanes> RoughDielectricBsdf<'a, L> {
    #[inline(always)]
    fn at(l: L, materials: &'a Materials, at: &Local<L>) -> Self {
        let (eta, offset, textured) = DielectricRow::read(l, materials, at);
        let table = LossTable { rows: &materials.tables.rows, offset, textured };
        let alpha = at.alpha.max(l.f(ggx::SMOOTH));
        let losses = if materials.tables.compensates_dielectrics { Some(table) } else { None };
        RoughDielectricBsdf::new(l, eta, alpha, at.front, losses)
    }

    /// `eta` is the index beyond the surface over that on the side of the viewer, who is outside in the lanes of `outside`.
    /// `alpha` is from [`ggx::SMOOTH`] to 1. Without a table, there is only single scattering.
    #[inline(always)]
    pub(super) fn new(l: L, eta: F<L>, alpha: F<L>, outside: M<L>, losses: Option<LossTable<'a, L>>) -> Self {
        #[expect(clippy::manual_map, reason = "a closure would not be compiled for the instructions of the lanes")]
        let missing = match losses {
            Some(table) => Some(MissingEnergy::new(l, alpha, outside, table)),
            None => None,
        };
        RoughDielectricBsdf::of(eta, alpha, missing)
    }
}

impl<'a, L: Lanes, D: Microfacets<L>> RoughDielectricBsdf<'a, L, D> {
    /// The interface of any facets; `missing` is their lost light.
    #[inline(always)]
    pub(super) fn of(eta: F<L>, facets: D, missing: Option<MissingEnergy<'a, L>>) -> Self {
        RoughDielectricBsdf { eta, facets, missing }
    }

    /// The relative index: that beyond the surface over that on the side of the viewer.
    #[inline(always)]
    pub fn eta(&self) -> F<L> {
        self.eta
    }

    /// Lanes whose interface is treated as smooth.
    #[inline(always)]
    fn faint(&self) -> M<L> {
        (self.eta - 1.0).abs().below(FAINT)
    }

    /// 1/η² below the surface.
    #[inline(always)]
    fn radiance_scale(&self, wi: V<L>) -> F<L> {
        wi.z.below(0.0).pick(1.0 / (self.eta * self.eta), self.eta.splat(1.0))
    }

    /// f |cos θ_i| of single scattering without the scale of radiance, and its pdf.
    ///
    /// The half vector and the Jacobian from facets to ω_i are those of Walter et al. 2007, equations 13, 14, 16 and 17:
    /// reflection is refraction with an index of 1, apart from the sign. G₁(ω_i) is the fraction that leaves the visible facet
    /// unmasked.
    #[inline(always)]
    fn single(&self, wo: V<L>, wi: V<L>) -> (F<L>, F<L>) {
        let through = wi.z.below(0.0);
        let index = through.pick(self.eta, self.eta.splat(1.0));
        let sum = wo + wi * index;
        let square = sum.length_squared();
        let m = sum * (1.0 / square.sqrt()).copysign(sum.z);
        let (cos, beyond) = (wo.dot(m), wi.dot(m));
        let opposite = through.pick(-beyond, beyond);
        // Either side has the same reflectance. Refraction takes it from the thinner one, where a small error of the cosine does
        // not become a large one of transmittance next to total reflection.
        let swap = through & self.eta.below(1.0);
        let (seen, eta) = (swap.pick(opposite, cos), swap.pick(1.0 / self.eta, self.eta));
        let (reflectance, _) = fresnel::dielectric(seen.max(cos.splat(0.0)), eta);
        let chosen = through.pick(1.0 - reflectance, reflectance);
        let pdf = microfacets::visible_normal_pdf(self.facets, wo, m) * chosen * (index * index * opposite / square);
        let exists = cos.above(0.0) & opposite.above(0.0) & square.above(0.0);
        let pdf = exists.pick(pdf, cos.splat(0.0));
        (pdf * microfacets::g1(self.facets, wi), pdf)
    }

    /// Samples a direction via a visible facet, and tells whether it is on the correct side.
    #[inline(always)]
    fn sample_single(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> (V<L>, M<L>) {
        let m = self.facets.sample_visible_normal(wo, u);
        let cos = wo.dot(m).max(wo.z.splat(0.0));
        let (reflectance, cos_t) = fresnel::dielectric(cos, self.eta);
        let reflects = lobe.lt(reflectance);
        let inverse = 1.0 / self.eta;
        let bend = reflects.pick(wo.z.splat(1.0), inverse);
        let along = reflects.pick(cos * 2.0, cos * inverse - cos_t);
        let wi = (m * along + -wo * bend).normalized();
        (wi, reflects.pick(wi.z, -wi.z).above(0.0))
    }

    /// Samples a direction from all lobes that are not delta, and tells whether it exists.
    #[inline(always)]
    fn sample_wi(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> (V<L>, M<L>) {
        let Some(missing) = &self.missing else {
            return self.sample_single(wo, u, lobe);
        };
        let lost = missing.loss(wo, wo.z.below(0.0));
        let again = lobe.lt(lost.here);
        let (wi, exists) = self.sample_single(wo, u, (lobe - lost.here) / (1.0 - lost.here));
        (again.pick(missing.sample(&lost, u, lobe / lost.here), wi), again | exists)
    }
}

impl<L: Lanes, D: Microfacets<L>> Bsdf<L> for RoughDielectricBsdf<'_, L, D> {
    #[inline(always)]
    fn eval(&self, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let (mut f, mut pdf) = self.single(wo, wi);
        if let Some(missing) = &self.missing {
            let lost = missing.loss(wo, wo.z.below(0.0));
            let (f_more, pdf_more) = missing.eval(&lost, wi);
            f = f + f_more;
            pdf = pdf * (1.0 - lost.here) + pdf_more * lost.here;
        }
        let (zero, faint) = (wo.z.splat(0.0), self.faint());
        let f = faint.pick(zero, f * self.radiance_scale(wi));
        (V { x: f, y: f, z: f }, faint.pick(zero, pdf))
    }

    #[inline(always)]
    fn sample(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let zero = wo.z.splat(0.0);
        let (wi, exists) = self.sample_wi(wo, u, lobe);
        let (f, pdf) = self.eval(wo, wi);
        let weight = (exists & pdf.above(0.0)).pick(f.x / pdf, zero);
        let faint = self.faint();
        let smooth = DielectricBsdf { eta: self.eta }.sample(wo, u, lobe);
        BsdfSample {
            wi: faint.pick(smooth.wi, wi),
            weight: faint.pick(smooth.weight, V { x: weight, y: weight, z: weight }),
            pdf,
            delta: faint,
        }
    }
}

impl<D: Microfacets<One>> Lobes for RoughDielectricBsdf<'_, One, D> {
    fn chosen(&self, wo: V<One>, u: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        if self.faint().0 {
            return DielectricBsdf { eta: self.eta }.chosen(wo, u, lobe);
        }
        let lost = self.missing.as_ref().map_or(0.0, |missing| missing.loss(wo, wo.z.below(0.0)).here.0);
        if lobe.0 < lost {
            return ChosenLobe { name: "further scattering between microfacets", probability: lost };
        }
        let m = self.facets.sample_visible_normal(wo, u);
        let (reflectance, _) = fresnel::dielectric(wo.dot(m).max(F(0.0)), self.eta);
        let rest = F((lobe.0 - lost) / (1.0 - lost));
        let chosen = ChosenLobe::of_two(["microfacet reflection", "microfacet refraction"], reflectance.0, rest);
        ChosenLobe { probability: chosen.probability * (1.0 - lost), ..chosen }
    }
}
