//! The BSDF of rough metal: microfacets with compensation for multiple scattering.
//!
//! Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", 2017: a lobe (1 − E(ω_o))(1 − E(ω_i))/(π(1 − E_avg))
//! restores the light that single scattering loses, where E is the albedo of perfectly reflecting microfacets. It is reciprocal,
//! and lossless if the metal is. Light that scatters k times is reflected k times by Fresnel's reflectance and hits a further
//! facet each time with probability 1 − E_avg, which sums to F_avg² E_avg/(1 − F_avg(1 − E_avg)) for k ≥ 2.
use std::f32::consts::FRAC_1_PI;

use super::{
    Bsdf, BsdfSample, ChosenLobe, Lobes, Local, Materials,
    albedo::Albedo,
    conductor_fresnel::{ConductorFresnel, ConductorRow},
    grazing,
    microfacets::{self, Microfacets},
};
use noisefall_base::math::{F, Lanes, M, One, Pick, V};

/// The light that single scattering between perfectly reflecting facets loses.
pub trait FacetLoss<L: Lanes>: Copy {
    /// 1 − E seen from a direction above the surface.
    fn at(&self, l: L, w: V<L>) -> F<L>;
    /// Its average over diffuse light.
    fn average(&self, l: L) -> F<L>;
    /// The width at which directions of further scattering are sampled.
    fn width(&self) -> F<L>;
}

impl<L: Lanes> FacetLoss<L> for Albedo<'_, L> {
    #[inline(always)]
    fn at(&self, l: L, w: V<L>) -> F<L> {
        self.value(l, w.z)
    }

    #[inline(always)]
    fn average(&self, l: L) -> F<L> {
        self.average(l)
    }

    #[inline(always)]
    fn width(&self) -> F<L> {
        self.width()
    }
}

/// The BSDF of a conductor at a point: facets of any kind, with the light that they lose.
#[derive(Clone, Copy)]
pub struct ConductorBsdf<L: Lanes, D, T> {
    l: L,
    fresnel: ConductorFresnel<L>,
    facets: D,
    /// The width α of a round distribution that is as wide.
    pub alpha: F<L>,
    /// Lanes with energy compensation.
    compensated: M<L>,
    loss: T,
    /// The restored fraction of the light that single scattering loses, divided by π times the average loss.
    returned: V<L>,
}

impl<L: Lanes, D: Microfacets<L>, T: FacetLoss<L>> ConductorBsdf<L, D, T> {
    #[inline(always)]
    pub(super) fn new(l: L, materials: &Materials, at: &Local<L>, facets: D, alpha: F<L>, loss: T) -> Self {
        let fresnel = ConductorFresnel::read(l, materials, at.material, at.colour);
        let compensated = ConductorRow::read_compensated(l, materials, at.material);
        let mut returned = V::splat(l, [0.0; 3]);
        if compensated.any() {
            let lost = loss.average(l);
            let f = fresnel.average();
            let scale = (1.0 - lost) * FRAC_1_PI / lost;
            returned = V {
                x: f.x * f.x * scale / (1.0 - f.x * lost),
                y: f.y * f.y * scale / (1.0 - f.y * lost),
                z: f.z * f.z * scale / (1.0 - f.z * lost),
            };
        }
        ConductorBsdf { l, fresnel, facets, alpha, compensated, loss, returned }
    }

    /// 1 − E; 0 in lanes without compensation.
    #[inline(always)]
    fn loss(&self, w: V<L>) -> F<L> {
        let none = w.z.splat(0.0);
        if self.compensated.any() { self.compensated.pick(self.loss.at(self.l, w), none) } else { none }
    }

    /// [`Bsdf::eval`] for a known 1 − E(ω_o). The lobe of multiple scattering is chosen with that probability, and sampled where
    /// it is bright: cosine sampling would rarely find its rim, with weights of 1/α.
    #[inline(always)]
    fn eval_with(&self, wo: V<L>, wi: V<L>, loss: F<L>) -> (V<L>, F<L>) {
        let zero = wo.z.splat(0.0);
        let cos = wi.z.max(zero);
        let h = (wo + wi).normalized();
        let density = microfacets::reflection_pdf(self.facets, wo, h);
        let single = self.fresnel.reflectance(wo.dot(h)) * (density * microfacets::g1(self.facets, wi));
        let further = self.returned * (loss * self.loss(V { z: cos, ..wi }) * cos);
        let mut pdf = (1.0 - loss) * density;
        if self.compensated.any() {
            pdf = pdf + loss * grazing::pdf(self.loss.width(), cos);
        }
        let above = wi.z.above(0.0);
        (above.pick(single + further, V { x: zero, y: zero, z: zero }), above.pick(pdf, zero))
    }
}

impl<L: Lanes, D: Microfacets<L>, T: FacetLoss<L>> Bsdf<L> for ConductorBsdf<L, D, T> {
    #[inline(always)]
    fn eval(&self, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        self.eval_with(wo, wi, self.loss(wo))
    }

    #[inline(always)]
    fn sample(&self, wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let loss = self.loss(wo);
        let further = lobe.lt(loss);
        let mut wi = microfacets::sample_reflection(self.facets, wo, u);
        if further.any() {
            wi = further.pick(grazing::sample(self.loss.width(), u, lobe / loss), wi);
        }
        let (f, pdf) = self.eval_with(wo, wi, loss);
        BsdfSample::of(wi, f, pdf)
    }
}

impl<D: Microfacets<One>, T: FacetLoss<One>> Lobes for ConductorBsdf<One, D, T> {
    fn chosen(&self, wo: V<One>, _: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        ChosenLobe::of_two(["further scattering between microfacets", "microfacet reflection"], self.loss(wo).0, lobe)
    }
}
