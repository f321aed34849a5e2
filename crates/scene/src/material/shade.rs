//! The interface between the shading stages of the kernel and BSDF types.
use super::{Bsdf, Local, Materials, Stage};
use crate::{
    sampling::Directions,
    texture::{TextureCoordinates, Textures},
};
use noisefall_base::math::{F, Lanes, M, V};

/// A BSDF type and the requirements of its shading. Code that it does not need is not compiled.
pub trait Shade {
    /// The BSDF at a point.
    type Bsdf<'a, L: Lanes>: Bsdf<L>;
    /// The stage in the catalogue.
    const STAGE: Stage;
    /// Whether it depends on the direction to the viewer, has parameters besides its colour, or has a shading normal.
    const DETAILED: bool = true;
    /// Whether it has lobes that are not delta, so light samples can contribute.
    const SEES_LIGHTS: bool = true;
    /// Whether it reflects the same radiance in all directions.
    const DIFFUSE: bool = false;
    /// Whether it reflects more light in some directions than in others: normals that mirror the viewer below the surface would make it dark.
    const HIGHLIGHTS: bool = !Self::DIFFUSE;
    /// Whether it has several lobes to choose from.
    const LOBES: bool = true;
    /// Whether light passes through the surface.
    const TRANSMITS: bool = false;
    /// Whether transmitted light enters or leaves a medium.
    const ENTERS: bool = Self::TRANSMITS;
    /// Whether it has a diffuse transmittance besides its colour: see [`Shade::with_transmittance`].
    const HAS_TRANSMITTANCE: bool = false;
    /// Whether light samples depend on its lobe.
    const GLOSSY: bool = false;
    /// Whether it has a frame along the tangent and textures of its own, in scenes with materials that need them: then it is made
    /// by [`Shade::at_chart`].
    const CHARTED: bool = false;
    /// Whether some of its surfaces are sheets, which transmit light without an inside.
    const SHEETS: bool = false;

    /// The BSDF at surface points. `directions` is the sampling of diffuse surfaces.
    fn at<'a, L: Lanes>(l: L, materials: &'a Materials, directions: Directions, at: &Local<L>) -> Self::Bsdf<'a, L>;

    /// The BSDF, with the textures of the scene and the coordinates at which they are looked up, if any are needed.
    #[inline(always)]
    fn at_chart<'a, L: Lanes>(
        l: L,
        materials: &'a Materials,
        directions: Directions,
        at: &Local<L>,
        _lookup: Option<(&Textures, TextureCoordinates<L>)>,
    ) -> Self::Bsdf<'a, L> {
        Self::at(l, materials, directions, at)
    }

    /// Cosine and sine of the angle by which the tangent is turned about the front normal.
    #[inline(always)]
    fn turn<L: Lanes>(l: L, _materials: &Materials, _at: &Local<L>) -> (F<L>, F<L>) {
        (l.f(1.0), l.f(0.0))
    }

    /// The BSDF with its diffuse transmittance at the points.
    #[inline(always)]
    fn with_transmittance<'a, L: Lanes>(bsdf: Self::Bsdf<'a, L>, _transmittance: V<L>) -> Self::Bsdf<'a, L> {
        bsdf
    }

    /// The width of the lobe; 0 without one.
    #[inline(always)]
    fn alpha<L: Lanes>(l: L, _bsdf: &Self::Bsdf<'_, L>) -> F<L> {
        l.f(0.0)
    }

    /// Factor that roulette applies to the throughput before it evaluates it. `z` is the height of the next direction.
    #[inline(always)]
    fn roulette_scale<L: Lanes>(_bsdf: &Self::Bsdf<'_, L>, _front: M<L>, z: F<L>) -> F<L> {
        z.splat(1.0)
    }

    /// Factor of [`Shade::roulette_scale`] on the outside, where surfaces lie within another medium.
    #[inline(always)]
    fn compression_outside<L: Lanes>(l: L, _materials: &Materials, _at: &Local<L>) -> F<L> {
        l.f(1.0)
    }
}
