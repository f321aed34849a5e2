//! The types of BSDF in the shading stage, which is compiled once for each.
use crate::{
    material::{self, Bsdf, Lambertian, Local, Materials},
    math::{F, Lanes, M, Pick},
    scene::{RenderSettings, surface::Stage},
};

/// A type of BSDF and the needs of its shading. Code that it does not need is not compiled.
pub(super) trait Kind {
    type Bsdf<'a, L: Lanes>: Bsdf<L>;
    const STAGE: Stage;
    /// Whether it depends on the direction to the viewer, has parameters besides its colour, or has its own shading normal.
    const DETAILED: bool = true;
    /// Whether it has lobes that are not delta, so that sampled lights can contribute.
    const SEES_LIGHTS: bool = true;
    /// Whether it has several lobes to choose from.
    const LOBES: bool = true;
    const TRANSMITS: bool = false;

    /// Whether it has a single lobe, which light selection can use.
    const GLOSSY: bool = false;

    fn at<'a, L: Lanes>(l: L, materials: &'a Materials, settings: &RenderSettings, at: &Local<L>) -> Self::Bsdf<'a, L>;

    /// The width of the lobe; 0 without one.
    #[inline(always)]
    fn alpha<L: Lanes>(l: L, _bsdf: &Self::Bsdf<'_, L>) -> F<L> {
        l.f(0.0)
    }

    /// The factor of the throughput for Russian roulette. `z` is the height of the next direction.
    #[inline(always)]
    fn roulette_scale<L: Lanes>(_bsdf: &Self::Bsdf<'_, L>, _front: M<L>, z: F<L>) -> F<L> {
        z.splat(1.0)
    }
}

/// Diffuse, with the geometric normal; only the colour varies.
pub(super) struct Plain;

impl Kind for Plain {
    type Bsdf<'a, L: Lanes> = Lambertian<L>;
    const STAGE: Stage = Stage::Plain;
    const DETAILED: bool = false;
    const LOBES: bool = false;

    #[inline(always)]
    fn at<L: Lanes>(_: L, _: &Materials, settings: &RenderSettings, at: &Local<L>) -> Lambertian<L> {
        Lambertian { albedo: at.colour, directions: settings.directions }
    }
}

/// Diffuse, with its own shading normal or in a medium.
pub(super) struct Diffuse;

impl Kind for Diffuse {
    type Bsdf<'a, L: Lanes> = Lambertian<L>;
    const STAGE: Stage = Stage::Diffuse;
    const LOBES: bool = false;

    #[inline(always)]
    fn at<L: Lanes>(_: L, _: &Materials, settings: &RenderSettings, at: &Local<L>) -> Lambertian<L> {
        Lambertian { albedo: at.colour, directions: settings.directions }
    }
}

macro_rules! kinds {
    ($($name:ident $bsdf:ty { $($item:item)* })*) => { $(
        pub(super) struct $name;

        impl Kind for $name {
            type Bsdf<'a, L: Lanes> = $bsdf;
            const STAGE: Stage = Stage::$name;
            $($item)*

            #[inline(always)]
            fn at<'a, L: Lanes>(l: L, materials: &'a Materials, _: &RenderSettings, at: &Local<L>) -> Self::Bsdf<'a, L> {
                material::$name::at(l, materials, at)
            }
        }
    )* };
}

kinds! {
    Mirror material::Mirror<L> {
        const SEES_LIGHTS: bool = false;
        const LOBES: bool = false;
    }
    Conductor material::Conductor<L> {
        const GLOSSY: bool = true;

        #[inline(always)]
        fn alpha<L: Lanes>(_l: L, bsdf: &Self::Bsdf<'_, L>) -> F<L> {
            bsdf.alpha
        }
    }
    Plastic material::Plastic<'a, L> {}
    Dielectric material::Dielectric<L> {
        const SEES_LIGHTS: bool = false;
        const TRANSMITS: bool = true;

        #[inline(always)]
        fn roulette_scale<L: Lanes>(bsdf: &Self::Bsdf<'_, L>, front: M<L>, z: F<L>) -> F<L> {
            uncompressed(bsdf.eta, front, z)
        }
    }
    RoughDielectric material::RoughDielectric<'a, L> {
        const TRANSMITS: bool = true;

        #[inline(always)]
        fn roulette_scale<L: Lanes>(bsdf: &Self::Bsdf<'_, L>, front: M<L>, z: F<L>) -> F<L> {
            uncompressed(bsdf.eta(), front, z)
        }
    }
}

/// The squared ratio of the indices inside and outside, for paths that stay or go inside: their radiance grows by this factor
/// once they are outside again. `eta` is the index beyond the surface over that on the viewer's side.
#[inline(always)]
fn uncompressed<L: Lanes>(eta: F<L>, front: M<L>, z: F<L>) -> F<L> {
    let inside = front ^ z.above(0.0);
    let ratio = front.pick(eta, 1.0 / eta);
    inside.pick(ratio * ratio, z.splat(1.0))
}

/// `in_kind!(stage, K => call::<K>(…))`: the call with the kind of a [`Stage`].
macro_rules! in_kind {
    ($stage:expr, $kind:ident => $call:expr) => {
        in_kind!($stage, $kind => $call; Plain Diffuse Mirror Conductor Dielectric RoughDielectric Plastic)
    };
    ($stage:expr, $kind:ident => $call:expr; $($name:ident)*) => {
        match $stage {
            $($crate::scene::surface::Stage::$name => {
                type $kind = $crate::integrator::kinds::$name;
                $call
            })*
        }
    };
}
pub(super) use in_kind;
