//! Disney's principled BSDF, as in Mitsuba.
//!
//! B. Burley, "Physically Based Shading at Disney", 2012, and "Extending the Disney BRDF to a BSDF with Integrated Subsurface
//! Scattering", 2015; W. Jakob et al., "Mitsuba 3", plugin `principled`. With metallic m, spec_trans t and base colour c, the BSDF is
//! the sum of
//!
//! * a diffuse lobe with retro-reflection that grows with the roughness, and `flatness` towards the look of thin subsurface
//!   scattering: (1 − m)(1 − t) c f_d (`diffuse.rs`),
//! * sheen: (1 − m) sheen (1 − cos θ_d)⁵, white or of the hue of c (`diffuse.rs`),
//! * GGX facets with Smith's separable masking, whose reflectance is m times Schlick's metal, and (1 − m) times Fresnel's equations or
//!   a Schlick interface of the hue of c; they transmit (1 − m) t √c (1 − F) (`point.rs`),
//! * a clear coat with facets of a distribution of its own, which has no effect on what is below it (`coat.rs`).
//!
//! From inside, only the clear interface is there. Light that scatters more than once between facets is lost.
//!
//! The model does not conserve energy: the diffuse lobe does not know what the facets reflect, and clear coat and sheen add light.
//! A white, rough surface reflects up to 1.6 times the light that arrives at grazing angles. Light between such surfaces can grow
//! with every bounce, so that a closed room of them has no image without a cap of bounces. It is reciprocal.
//!
//! Mitsuba's sampling rates are not here: they have no effect on the image. An index of 1 reflects nothing but the clear coat, as there.
//! Mitsuba's scalar variants, unlike its vectorized ones, leave out the sheen where `spec_trans` is exactly 1; here it stays.
mod bsdf;
mod coat;
mod compile;
mod diffuse;
mod parameters;
mod point;
mod row;

pub use self::bsdf::DisneyBsdf;
use self::point::Point;
use super::{Local, Materials, Shade, Stage, refraction::uncompressed};
use crate::{
    sampling::Directions,
    texture::{TextureCoordinates, Textures},
};
use noisefall_base::{
    declare::{Kind, Parameter, Textured},
    math::{F, Lanes, M, Pick},
};

/// Disney's BSDF in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Disney {
    /// Albedo of the diffuse base, reflectance of the metal at normal incidence, and square of the tint of the interface.
    pub base_color: Textured,
    /// Fraction of the base that is metal.
    pub metallic: Textured<f64>,
    /// Square root of the width α of the GGX distribution.
    pub roughness: Textured<f64>,
    /// How much longer the highlight is along the tangent: the widths are α/s and α s with s² = 1 − 0.9 × this.
    pub anisotropic: Textured<f64>,
    /// Index of refraction.
    pub ior: f64,
    /// Amount of the base color's hue in the reflection of the interface.
    pub spec_tint: Textured<f64>,
    /// Fraction of the non-metallic base that is clear and refracts.
    pub spec_trans: Textured<f64>,
    /// How strongly the diffuse lobe resembles thin subsurface scattering.
    pub flatness: Textured<f64>,
    /// Amount of light that fibres reflect at grazing angles.
    pub sheen: Textured<f64>,
    /// Amount of the base color's hue in the sheen.
    pub sheen_tint: Textured<f64>,
    /// Amount of the clear coat.
    pub clearcoat: Textured<f64>,
    /// Sharpness of the clear coat: its facets have a width from 0.1 to 0.001.
    pub clearcoat_gloss: Textured<f64>,
}

impl Default for Disney {
    fn default() -> Self {
        const NONE: Textured<f64> = Textured::Constant(0.0);
        Disney {
            base_color: Textured::grey(0.5),
            metallic: NONE,
            roughness: Textured::Constant(0.5),
            anisotropic: NONE,
            ior: 1.5,
            spec_tint: NONE,
            spec_trans: NONE,
            flatness: NONE,
            sheen: NONE,
            sheen_tint: NONE,
            clearcoat: NONE,
            clearcoat_gloss: NONE,
        }
    }
}

impl Kind for Disney {
    const KIND: Parameter = Parameter::new(
        "disney",
        "Disney's principled BSDF, exactly as in Mitsuba; bright, rough surfaces reflect more light than arrives.",
    )
    .aliases("disney_bsdf disney_principled burley");
}

/// The stage of materials that transmit light.
pub struct DisneyGlass;

/// Implements [`Shade`] for an opaque or a clear stage.
macro_rules! shade {
    ($Stage:ident, $CLEAR:literal, { $($more:tt)* }) => {
        impl Shade for $Stage {
            type Bsdf<'a, L: Lanes> = DisneyBsdf<L, $CLEAR>;
            const STAGE: Stage = Stage::$Stage;
            const CHARTED: bool = true;

            #[inline(always)]
            fn at<L: Lanes>(l: L, materials: &Materials, _: Directions, at: &Local<L>) -> DisneyBsdf<L, $CLEAR> {
                DisneyBsdf(Point::new(l, materials, at, None))
            }

            #[inline(always)]
            fn at_chart<L: Lanes>(
                l: L,
                materials: &Materials,
                _: Directions,
                at: &Local<L>,
                lookup: Option<(&Textures, TextureCoordinates<L>)>,
            ) -> DisneyBsdf<L, $CLEAR> {
                DisneyBsdf(Point::new(l, materials, at, lookup))
            }

            $($more)*
        }
    };
}

shade!(Disney, false, {
    const GLOSSY: bool = true;

    /// The width of metals; lights are chosen for other bases as for diffuse ones.
    #[inline(always)]
    fn alpha<L: Lanes>(l: L, bsdf: &DisneyBsdf<L, false>) -> F<L> {
        bsdf.0.metal.above(0.5).pick(bsdf.0.facets.mean().min(l.f(1.0)), l.f(0.0))
    }
});

shade!(DisneyGlass, true, {
    const TRANSMITS: bool = true;

    #[inline(always)]
    fn roulette_scale<L: Lanes>(bsdf: &DisneyBsdf<L, true>, front: M<L>, z: F<L>) -> F<L> {
        uncompressed(bsdf.0.relative, front, z)
    }
});
