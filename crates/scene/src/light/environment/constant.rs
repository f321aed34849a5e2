//! An environment of constant radiance.
use std::f32::consts::FRAC_1_PI;

use super::{Radiant, Surrounding};
use crate::{
    light::{ReferencePoint, parameters::RADIANCE},
    sampling::warp::{cap, cosine_hemisphere},
};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Resources},
    math::{F, Frame, Lanes, Pick, V, colour::luminance},
};

/// A constant radiance from all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// W·sr⁻¹·m⁻², linear Rec. 709.
    pub radiance: [f64; 3],
}

impl Default for Constant {
    fn default() -> Self {
        Constant { radiance: [1.0; 3] }
    }
}

impl Kind for Constant {
    const KIND: Parameter = RADIANCE;

    fn chosen(&mut self, p: &mut dyn Parameters) {
        self.parameters(p);
    }
}

impl Declare for Constant {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.colour(&RADIANCE, &mut self.radiance, Range::RADIANCE);
    }
}

impl Surrounding for Constant {
    type Radiant = ConstantRadiance;

    fn compile(&self, _: &Resources) -> Result<Option<ConstantRadiance>, Problem> {
        let radiance = self.radiance.map(|x| x as f32);
        Ok((radiance != [0.0; 3]).then_some(ConstantRadiance(radiance)))
    }
}

/// A constant radiance from all directions, W·sr⁻¹·m⁻². It is sampled in proportion to the cosine, on both sides of the surface
/// alike if the surface transmits, and not at all where a narrow lobe reflects it: the next direction of the path finds it, too.
pub struct ConstantRadiance(pub [f32; 3]);

impl Radiant for ConstantRadiance {
    const IS_EVEN: bool = true;

    #[inline(always)]
    fn radiance<L: Lanes>(&self, l: L, _: V<L>) -> V<L> {
        V::splat(l, self.0)
    }

    #[inline(always)]
    fn sample<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, _: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>) {
        let behind = u.0.ge(l.f(0.5)) & at.transmits;
        let folded = behind.pick(u.0 * 2.0 - 1.0, u.0 * 2.0);
        let local = cosine_hemisphere((at.transmits.pick(folded, u.0), u.1));
        let wi = Frame::new(at.n).world_from_local(V { z: behind.pick(-local.z, local.z), ..local });
        (wi, cosine_pdf(at, wi))
    }

    #[inline(always)]
    fn pdf<L: Lanes>(&self, _: L, at: &ReferencePoint<L>, wi: V<L>) -> F<L> {
        cosine_pdf(at, wi)
    }

    #[inline(always)]
    fn sample_inwards<L: Lanes>(&self, l: L, _: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>) {
        (cap(l.f(2.0), u), l.f(0.25 * FRAC_1_PI))
    }

    #[inline(always)]
    fn pdf_inwards<L: Lanes>(&self, l: L, _: V<L>) -> F<L> {
        l.f(0.25 * FRAC_1_PI)
    }

    fn luminance(&self) -> f32 {
        luminance(self.0)
    }

    fn is_same(&self, other: &ConstantRadiance) -> bool {
        self.0.map(f32::to_bits) == other.0.map(f32::to_bits)
    }
}

#[inline(always)]
fn cosine_pdf<L: Lanes>(at: &ReferencePoint<L>, wi: V<L>) -> F<L> {
    let cos = wi.dot(at.n);
    let pdf = at.transmits.pick(cos.abs() * (0.5 * FRAC_1_PI), cos.max(cos.splat(0.0)) * FRAC_1_PI);
    match &at.lobe {
        Some(lobe) => lobe.is_narrow().pick(cos.splat(0.0), pdf),
        None => pdf,
    }
}
