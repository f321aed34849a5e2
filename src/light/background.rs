//! The background: radiance along rays that hit no surface.
use std::f32::consts::FRAC_1_PI;

use super::{ImageBackground, ReferencePoint};
use crate::{
    math::{F, Frame, Lanes, Pick, V, colour::luminance},
    sampling::warp::cosine_hemisphere,
};

/// Radiance in W·sr⁻¹·m⁻², linear Rec. 709.
pub enum Background {
    /// The same radiance from all directions.
    Constant([f32; 3]),
    /// An image of all directions.
    Image(ImageBackground),
}

impl Background {
    /// Radiance from the unit direction `d`.
    #[inline(always)]
    pub fn radiance<L: Lanes>(&self, l: L, d: V<L>) -> V<L> {
        match self {
            Background::Constant(radiance) => V::splat(l, *radiance),
            Background::Image(image) => image.radiance(l, d),
        }
    }

    /// Samples a unit direction, and returns it with its pdf per solid angle. A constant background is sampled in proportion to
    /// the cosine, on both sides of the surface alike if it transmits; an image is sampled by its radiance. Only an image reads
    /// `cell`.
    #[inline(always)]
    pub(super) fn sample<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, cell: (F<L>, F<L>), u: (F<L>, F<L>)) -> (V<L>, F<L>) {
        match self {
            Background::Constant(_) => {
                let behind = u.0.ge(l.f(0.5)) & at.transmits;
                let folded = behind.pick(u.0 * 2.0 - 1.0, u.0 * 2.0);
                let local = cosine_hemisphere((at.transmits.pick(folded, u.0), u.1));
                let wi = Frame::new(at.n).world_from_local(V { z: behind.pick(-local.z, local.z), ..local });
                (wi, cosine_pdf(at, wi))
            }
            Background::Image(image) => image.sample(l, cell, u),
        }
    }

    /// The pdf of [`Background::sample`] at the unit direction `wi`, per solid angle.
    #[inline(always)]
    pub(super) fn pdf<L: Lanes>(&self, l: L, at: &ReferencePoint<L>, wi: V<L>) -> F<L> {
        match self {
            Background::Constant(_) => cosine_pdf(at, wi),
            Background::Image(image) => image.pdf(l, wi),
        }
    }

    /// Mean luminance over all directions.
    pub fn luminance(&self) -> f32 {
        match self {
            Background::Constant(radiance) => luminance(*radiance),
            Background::Image(image) => image.mean_luminance(),
        }
    }
}

#[inline(always)]
fn cosine_pdf<L: Lanes>(at: &ReferencePoint<L>, wi: V<L>) -> F<L> {
    let cos = wi.dot(at.n);
    at.transmits.pick(cos.abs() * (0.5 * FRAC_1_PI), cos.max(cos.splat(0.0)) * FRAC_1_PI)
}
