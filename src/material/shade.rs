//! The stages of the kernel: what shading needs to know of a kind of bsdf.
use super::{Bsdf, Local, Materials, Stage};
use crate::{
    math::{F, Lanes, M},
    sampling::Directions,
};

/// A kind of bsdf and what its shading needs. What it does not need is not compiled.
pub trait Shade {
    /// The BSDF at a point.
    type Bsdf<'a, L: Lanes>: Bsdf<L>;
    /// The stage in the catalogue.
    const STAGE: Stage;
    /// It depends on the direction to the viewer, has parameters besides its colour, or a shading normal of its own.
    const DETAILED: bool = true;
    /// It has more than delta lobes, so that sampled lights can contribute.
    const SEES_LIGHTS: bool = true;
    /// It has several lobes to choose from.
    const LOBES: bool = true;
    /// Whether light passes through the surface.
    const TRANSMITS: bool = false;
    /// What passes enters or leaves a medium.
    const ENTERS: bool = Self::TRANSMITS;
    /// It has one lobe, for which the choice of a light is better made.
    const GLOSSY: bool = false;

    /// The bsdf at some surface points. `directions` is how diffuse surfaces are sampled.
    fn at<'a, L: Lanes>(l: L, materials: &'a Materials, directions: Directions, at: &Local<L>) -> Self::Bsdf<'a, L>;

    /// The width of the lobe; 0 where there is none.
    #[inline(always)]
    fn alpha<L: Lanes>(l: L, _bsdf: &Self::Bsdf<'_, L>) -> F<L> {
        l.f(0.0)
    }

    /// What roulette multiplies the throughput by before it judges it. `z` is the height of the next direction.
    #[inline(always)]
    fn roulette_scale<L: Lanes>(_bsdf: &Self::Bsdf<'_, L>, _front: M<L>, z: F<L>) -> F<L> {
        z.splat(1.0)
    }
}
