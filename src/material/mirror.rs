//! The smooth mirror: a delta lobe times a metal's Fresnel reflectance.
use super::{
    bsdf::{Bsdf, BsdfSample, ChosenLobe, Lobes},
    fresnel::ConductorFresnel,
    materials::{Local, Materials},
};
use crate::math::{F, Lanes, One, V};

pub struct Mirror<L: Lanes> {
    fresnel: ConductorFresnel<L>,
}

impl<L: Lanes> Clone for Mirror<L> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<L: Lanes> Copy for Mirror<L> {}

impl<L: Lanes> Mirror<L> {
    #[inline(always)]
    pub fn at(l: L, materials: &Materials, at: &Local<L>) -> Self {
        Mirror { fresnel: ConductorFresnel::read(l, &materials.rows, Materials::first_row(at.material), at.colour) }
    }
}

impl<L: Lanes> Bsdf<L> for Mirror<L> {
    #[inline(always)]
    fn eval(&self, wo: V<L>, _wi: V<L>) -> (V<L>, F<L>) {
        let zero = wo.z.splat(0.0);
        (V { x: zero, y: zero, z: zero }, zero)
    }

    #[inline(always)]
    fn sample(&self, wo: V<L>, _u: (F<L>, F<L>), _lobe: F<L>) -> BsdfSample<L> {
        let wi = V { x: -wo.x, y: -wo.y, z: wo.z };
        let zero = wo.z.splat(0.0);
        BsdfSample { wi, weight: self.fresnel.reflectance(wo.z), pdf: zero, delta: zero.ge(zero) }
    }
}

impl Lobes for Mirror<One> {
    fn chosen(&self, _: V<One>, _: (F<One>, F<One>), _: F<One>) -> ChosenLobe {
        ChosenLobe::only("mirror reflection")
    }
}
