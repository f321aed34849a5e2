//! The smooth dielectric: mirror reflection and refraction.
use super::{
    bsdf::{Bsdf, BsdfSample, ChosenLobe, Lobes},
    fresnel,
    materials::{Local, Materials},
};
use crate::math::{F, Lanes, M, One, Pick, V};

/// The smooth interface between two transparent media.
///
/// Transmitted radiance is scaled by 1/η², because refraction changes its solid angle (Veach 1997, section 5.2). Light that
/// enters and leaves again keeps its radiance.
pub struct Dielectric<L: Lanes> {
    /// Relative index of refraction: that beyond the surface over that on the side of the viewer.
    pub eta: F<L>,
}

impl<L: Lanes> Clone for Dielectric<L> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<L: Lanes> Copy for Dielectric<L> {}

impl<L: Lanes> Dielectric<L> {
    #[inline(always)]
    pub fn at(l: L, materials: &Materials, at: &Local<L>) -> Self {
        let [inside_over_outside, ..] = l.rows(&materials.rows, Materials::first_row(at.material));
        Dielectric { eta: at.front.pick(inside_over_outside, 1.0 / inside_over_outside) }
    }
}

impl<L: Lanes> Bsdf<L> for Dielectric<L> {
    #[inline(always)]
    fn eval(&self, wo: V<L>, _: V<L>) -> (V<L>, F<L>) {
        let zero = wo.z.splat(0.0);
        (V { x: zero, y: zero, z: zero }, zero)
    }

    /// Reflects with a probability equal to the reflectance, so the weight is 1 apart from the scale of radiance.
    #[inline(always)]
    fn sample(&self, wo: V<L>, _: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let (reflectance, cos_t) = fresnel::dielectric(wo.z, self.eta);
        let reflects = lobe.lt(reflectance);
        let inverse = 1.0 / self.eta;
        let bend = reflects.pick(wo.z.splat(1.0), inverse);
        let wi = V { x: -(wo.x * bend), y: -(wo.y * bend), z: reflects.pick(wo.z, -cos_t) };
        let scale = bend * bend;
        BsdfSample { wi, weight: V { x: scale, y: scale, z: scale }, pdf: wo.z.splat(0.0), delta: everywhere(wo.z) }
    }
}

/// The mask of all lanes.
#[inline(always)]
fn everywhere<L: Lanes>(like: F<L>) -> M<L> {
    like.splat(0.0).below(1.0)
}

impl Lobes for Dielectric<One> {
    fn chosen(&self, wo: V<One>, _: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        ChosenLobe::of_two(["mirror reflection", "refraction"], fresnel::dielectric(wo.z, self.eta).0.0, lobe)
    }
}
