//! The ideal diffuse surface: f = ρ/π in all directions of the hemisphere.
use std::f32::consts::FRAC_1_PI;

use super::bsdf::{Bsdf, BsdfSample, ChosenLobe, Lobes};
use crate::{
    math::{F, Lanes, One, Pick, V},
    sampling::Directions,
};

#[derive(Clone, Copy)]
pub struct Lambertian<L: Lanes> {
    pub albedo: V<L>,
    pub directions: Directions,
}

impl<L: Lanes> Bsdf<L> for Lambertian<L> {
    #[inline(always)]
    fn eval(&self, _wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let zero = wi.z.splat(0.0);
        let cos = wi.z.max(zero);
        (self.albedo * (cos * FRAC_1_PI), wi.z.above(0.0).pick(self.directions.pdf(cos), zero))
    }

    #[inline(always)]
    fn sample(&self, _wo: V<L>, u: (F<L>, F<L>), _lobe: F<L>) -> BsdfSample<L> {
        let wi = self.directions.sample(u);
        let weight = self.albedo * self.directions.lambertian_weight(wi.z);
        BsdfSample { wi, weight, pdf: self.directions.pdf(wi.z), delta: wi.z.below(0.0) }
    }
}

impl Lobes for Lambertian<One> {
    fn chosen(&self, _: V<One>, _: (F<One>, F<One>), _: F<One>) -> ChosenLobe {
        ChosenLobe::only("diffuse reflection")
    }
}
