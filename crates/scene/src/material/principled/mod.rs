//! OpenPBR Surface 1.1: a base of metal, glass or diffuse material, under a film, a coat and fuzz.
//!
//! Academy Software Foundation, "OpenPBR Surface", version 1.1, 2024. With ω_o fixed, the BSDF is, from outside to inside,
//!
//! f = F f_fuzz + (1 − F E_fuzz) [C f_coat + (1 − C E_coat) A Δ f_base],
//! f_base = M f_metal + (1 − M) [T f_clear + (1 − T) (f_interface + f_diffuse)],
//!
//! where F, C, M and T are the weights of fuzz, coat, metal and transmission, E are directional albedos at ω_o, A is the absorption
//! of the coat, and Δ its darkening. Every layer gets what the one above leaves, so that no more light is reflected than arrives.
//!
//! **Exact**, up to tables and rounding: the dielectric interfaces (Fresnel, GGX, Smith's separable shadowing), smooth and rough
//! glass, Lambert's and the rough diffuse base under an interface (what the interface reflects, and what it lets in, sum to 1), F82
//! metals, the fuzz lobe, the absorption of the coat, anisotropic facets and their sampling.
//!
//! **Approximate**:
//! * Layers do not see each other's lobes: light between them is in E and Δ alone. The terms of coat and fuzz depend on ω_o and not
//!   on ω_i, and thus are not reciprocal. Neither are fuzz itself, metals and glass with α > 0 (see below). Everything else is.
//! * Light that single scattering loses between the facets of a metal or glass is restored by a factor that depends on ω_o (E. Turquin,
//!   "Practical multiple scattering compensation for microfacet models", 2019): white ones are lossless, but the restored light has
//!   the directions of the other. Glass of textured anisotropy gets what
//!   round facets of the width towards the viewer lose.
//! * E/F of rough interfaces is tabulated for indices that are rounded to multiples of 0.05, and for textured weights at weight 1.
//! * The coat widens the base's facets by their sum of squares, also if these are anisotropic.
//! * The film has one Gaussian band of wavelengths per channel and sees a metal as a dielectric: see `thin_film.rs`. An opaque base
//!   gets what the brightest film of that index would let in, so that some light is lost between film and base.
//! * Rays inside of glass see neither its coat nor its fuzz.
//! * Diffuse bases without roughness are Lambert's; there is no subsurface scattering.
//!
//! Emission belongs to the object.
mod bsdf;
mod compile;
mod facets;
mod fuzz;
mod interface;
mod layout;
mod parameters;
mod point;
mod rough_diffuse;
mod thin_film;
mod values;
mod view;

pub use self::bsdf::PrincipledBsdf;
use self::{layout::Constants, point::Point};
use super::{Local, Materials, Shade, Stage, refraction::uncompressed};
use crate::{
    sampling::Directions,
    texture::{TextureCoordinates, Textures},
};
use noisefall_base::{
    declare::{Kind, Parameter, Textured},
    math::{F, Lanes, M, Pick},
};

/// OpenPBR Surface 1.1 in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Principled {
    /// Factor of the base color.
    pub base_weight: Textured<f64>,
    /// Albedo of the diffuse base, and reflectance of the metal at normal incidence.
    pub base_color: Textured,
    /// Roughness of the diffuse base; 0 is Lambertian.
    pub base_diffuse_roughness: Textured<f64>,
    /// Fraction of the base that is metal.
    pub base_metalness: Textured<f64>,
    /// Factor that multiplies the reflectance of the interface; for metals, also at grazing angles.
    pub specular_weight: Textured<f64>,
    /// Tint of the reflection off the interface; for metals, only at grazing angles.
    pub specular_color: Textured,
    /// Square root of the width α of the GGX distribution.
    pub specular_roughness: Textured<f64>,
    /// How much longer the highlight is along the tangent; 0 is round.
    pub specular_roughness_anisotropy: Textured<f64>,
    /// Index of refraction of the base.
    pub specular_ior: f64,
    /// Fraction of the non-metallic base that is clear and refracts.
    pub transmission_weight: Textured<f64>,
    /// Colour of the light that passes: at each interface, or after the depth.
    pub transmission_color: Textured,
    /// Distance after which the inside has its colour; 0 tints the interface. Metres.
    pub transmission_depth: f64,
    /// Fraction of the surface under a clear coat.
    pub coat_weight: Textured<f64>,
    /// Fraction of the light that the coat transmits, in and out.
    pub coat_color: Textured,
    /// Square root of the width α of the coat.
    pub coat_roughness: Textured<f64>,
    /// Anisotropy of the coat; 0 is round.
    pub coat_roughness_anisotropy: Textured<f64>,
    /// Index of refraction of the coat.
    pub coat_ior: f64,
    /// How much reflections inside the coat darken the base.
    pub coat_darkening: Textured<f64>,
    /// Fraction of the surface under fuzz.
    pub fuzz_weight: Textured<f64>,
    /// Albedo of the fuzz.
    pub fuzz_color: Textured,
    /// Roughness of the fuzz.
    pub fuzz_roughness: Textured<f64>,
    /// Fraction of the surface with a thin film.
    pub thin_film_weight: Textured<f64>,
    /// Thickness of the film. Micrometres.
    pub thin_film_thickness: Textured<f64>,
    /// Index of refraction of the film.
    pub thin_film_ior: f64,
    /// Rotation of the tangent about the normal, degrees.
    pub tangent_rotation: f64,
    /// Whether the surface is a thin sheet, which refracts nothing.
    pub thin_walled: bool,
}

impl Default for Principled {
    fn default() -> Self {
        Principled {
            base_weight: Textured::Constant(1.0),
            base_color: Textured::grey(0.8),
            base_diffuse_roughness: Textured::Constant(0.0),
            base_metalness: Textured::Constant(0.0),
            specular_weight: Textured::Constant(1.0),
            specular_color: Textured::grey(1.0),
            specular_roughness: Textured::Constant(0.3),
            specular_roughness_anisotropy: Textured::Constant(0.0),
            specular_ior: 1.5,
            transmission_weight: Textured::Constant(0.0),
            transmission_color: Textured::grey(1.0),
            transmission_depth: 0.0,
            coat_weight: Textured::Constant(0.0),
            coat_color: Textured::grey(1.0),
            coat_roughness: Textured::Constant(0.0),
            coat_roughness_anisotropy: Textured::Constant(0.0),
            coat_ior: 1.6,
            coat_darkening: Textured::Constant(1.0),
            fuzz_weight: Textured::Constant(0.0),
            fuzz_color: Textured::grey(1.0),
            fuzz_roughness: Textured::Constant(0.5),
            thin_film_weight: Textured::Constant(0.0),
            thin_film_thickness: Textured::Constant(0.5),
            thin_film_ior: 1.4,
            tangent_rotation: 0.0,
            thin_walled: false,
        }
    }
}

impl Kind for Principled {
    const KIND: Parameter =
        Parameter::new("principled", "OpenPBR Surface: diffuse base, metal or glass, with coat, fuzz and thin film.")
            .aliases("openpbr standard_surface pbr uber");
}

/// The stage of principled materials whose base transmits light.
pub struct PrincipledGlass;

/// Implements [`Shade`] for an opaque or a clear stage.
macro_rules! shade {
    ($Stage:ident, $CLEAR:literal, { $($more:tt)* }) => {
        impl Shade for $Stage {
            type Bsdf<'a, L: Lanes> = PrincipledBsdf<'a, L, $CLEAR>;
            const STAGE: Stage = Stage::$Stage;
            const CHARTED: bool = true;

            #[inline(always)]
            fn at<'a, L: Lanes>(l: L, materials: &'a Materials, _: Directions, at: &Local<L>) -> PrincipledBsdf<'a, L, $CLEAR> {
                PrincipledBsdf(Point::new(l, materials, at, None))
            }

            #[inline(always)]
            fn at_chart<'a, L: Lanes>(
                l: L,
                materials: &'a Materials,
                _: Directions,
                at: &Local<L>,
                lookup: Option<(&Textures, TextureCoordinates<L>)>,
            ) -> PrincipledBsdf<'a, L, $CLEAR> {
                PrincipledBsdf(Point::new(l, materials, at, lookup))
            }

            #[inline(always)]
            fn turn<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> (F<L>, F<L>) {
                Constants::read(l, materials, at.material).turn
            }

            $($more)*
        }
    };
}

shade!(Principled, false, {
    const GLOSSY: bool = true;

    /// The width of metals; lights are chosen for other bases as for diffuse ones.
    #[inline(always)]
    fn alpha<L: Lanes>(l: L, bsdf: &PrincipledBsdf<L, false>) -> F<L> {
        let Point { base, values, .. } = &bsdf.0;
        (base.rough & values.metalness.above(0.5)).pick(base.widths.mean(), l.f(0.0))
    }
});

shade!(PrincipledGlass, true, {
    const TRANSMITS: bool = true;
    const SHEETS: bool = true;

    #[inline(always)]
    fn roulette_scale<L: Lanes>(bsdf: &PrincipledBsdf<L, true>, front: M<L>, z: F<L>) -> F<L> {
        uncompressed(bsdf.0.interface.relative, front, z)
    }
});
