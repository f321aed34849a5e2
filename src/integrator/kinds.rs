//! The kinds of bsdf as the shading stage sees them: one instance of the stage is compiled for each.
use crate::{
    material::{Bsdf, Lambertian, Local, Materials},
    math::{F, Lanes, M},
    scene::{RenderSettings, surface::Stage},
};

/// A kind of bsdf and what its shading needs. What it does not need is not compiled.
pub(super) trait Kind {
    type Bsdf<'a, L: Lanes>: Bsdf<L>;
    const STAGE: Stage;
    /// It depends on the direction to the viewer, has parameters besides its colour, or a shading normal of its own.
    const DETAILED: bool = true;
    /// It has more than delta lobes, so that sampled lights can contribute.
    const SEES_LIGHTS: bool = true;
    /// It has several lobes to choose from.
    const LOBES: bool = true;
    const TRANSMITS: bool = false;

    fn at<'a, L: Lanes>(l: L, materials: &'a Materials, settings: &RenderSettings, at: &Local<L>) -> Self::Bsdf<'a, L>;

    /// What roulette multiplies the throughput by before it judges it: radiance is compressed in a dense medium, and expands
    /// again when it leaves. `z` is the height of the next direction.
    #[inline(always)]
    fn roulette_scale<L: Lanes>(_bsdf: &Self::Bsdf<'_, L>, _front: M<L>, z: F<L>) -> F<L> {
        z.splat(1.0)
    }
}

/// Diffuse, with the geometric normal.
pub(super) struct Plain;

impl Kind for Plain {
    type Bsdf<'a, L: Lanes> = Lambertian<L>;
    const STAGE: Stage = Stage::Plain;
    const DETAILED: bool = false;
    const LOBES: bool = false;

    #[inline(always)]
    fn at<'a, L: Lanes>(_: L, _: &'a Materials, settings: &RenderSettings, at: &Local<L>) -> Lambertian<L> {
        Lambertian { albedo: at.colour, directions: settings.directions }
    }
}
