//! The ideal diffuse surface: f = ρ/π in all directions of the hemisphere.
use std::f32::consts::FRAC_1_PI;

use super::{Bsdf, BsdfSample, ChosenLobe, Compile, CompiledMaterial, Lobes, Local, MaterialCompiler, Materials, Shade, Stage};
use crate::{
    sampling::Directions,
    texture::{NumberSource, TextureCompiler},
};
use noisefall_base::{
    declare::{Declare, Kind, Meaning, Parameter, Parameters, Problem, Range, Textured},
    math::{F, Lanes, One, Pick, V},
};

/// A diffuse surface in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Lambertian {
    /// Albedo ρ, from 0 to 1 in each channel.
    pub albedo: Textured,
}

impl Default for Lambertian {
    fn default() -> Self {
        Lambertian { albedo: Textured::grey(0.8) }
    }
}

const ALBEDO: Parameter = Parameter::new("albedo", "Fraction of the light that is reflected, per channel.")
    .symbol("ρ")
    .required()
    .aliases("color colour rho reflectance kd Kd rgb base_color")
    .means(Meaning::Colour);

impl Kind for Lambertian {
    const KIND: Parameter = Parameter::new("lambertian", "Ideal diffuse reflection: the same radiance in all directions.")
        .aliases("lambert diffuse matte oren_nayar")
        .advice("such as lambertian = { albedo = 0.8 }");
}

impl Declare for Lambertian {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.textured(&ALBEDO, &mut self.albedo, Range::REFLECTANCE);
    }
}

impl Compile for Lambertian {
    fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        let albedo = compiler.colour(&ALBEDO, &self.albedo, &Range::REFLECTANCE)?;
        Ok(CompiledMaterial::new(Stage::Plain, albedo, compiler))
    }
}

impl CompiledMaterial {
    /// The mixture of two diffuse surfaces: the diffuse surface of their mixed albedo, because the BSDF is proportional to the albedo.
    /// `None` for other kinds, and if the mixture needs too many lookups of textures.
    pub fn mixed(&self, other: &CompiledMaterial, weight: NumberSource, textures: &mut TextureCompiler) -> Option<Self> {
        if [self, other].iter().any(|part| part.stage != Stage::Plain) {
            return None;
        }
        let colour = textures.mixture(self.colour, other.colour, weight)?;
        Some(CompiledMaterial { colour, albedo: textures.largest(colour), ..self.clone() })
    }
}

/// Diffuse surfaces with the geometric normal, in empty space.
pub struct Plain;

impl Shade for Plain {
    type Bsdf<'a, L: Lanes> = LambertianBsdf<L>;
    const STAGE: Stage = Stage::Plain;
    const DIFFUSE: bool = true;
    const DETAILED: bool = false;
    const LOBES: bool = false;

    #[inline(always)]
    fn at<L: Lanes>(_: L, _: &Materials, directions: Directions, at: &Local<L>) -> LambertianBsdf<L> {
        LambertianBsdf { albedo: at.colour, directions }
    }
}

/// Diffuse surfaces with a shading normal or in a medium.
pub struct Diffuse;

impl Shade for Diffuse {
    type Bsdf<'a, L: Lanes> = LambertianBsdf<L>;
    const STAGE: Stage = Stage::Diffuse;
    const DIFFUSE: bool = true;
    const LOBES: bool = false;

    #[inline(always)]
    fn at<L: Lanes>(_: L, _: &Materials, directions: Directions, at: &Local<L>) -> LambertianBsdf<L> {
        LambertianBsdf { albedo: at.colour, directions }
    }
}

/// The BSDF of a diffuse surface at a point.
#[derive(Clone, Copy)]
pub struct LambertianBsdf<L: Lanes> {
    /// Albedo ρ.
    pub albedo: V<L>,
    /// How directions are sampled.
    pub directions: Directions,
}

impl<L: Lanes> Bsdf<L> for LambertianBsdf<L> {
    #[inline(always)]
    fn eval(&self, _wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let zero = wi.z.splat(0.0);
        let cos = wi.z.max(zero);
        (self.albedo * (cos * FRAC_1_PI), wi.z.above(0.0).pick(self.directions.pdf(cos), zero))
    }

    #[inline(always)]
    fn sample(&self, _wo: V<L>, u: (F<L>, F<L>), _lobe: F<L>) -> BsdfSample<L> {
        let wi = self.directions.sample(u);
        let weight = self.albedo * self.directions.lambertian_weight(wi.z);
        BsdfSample { wi, weight, pdf: self.directions.pdf(wi.z), delta: wi.z.below(0.0) }
    }
}

impl Lobes for LambertianBsdf<One> {
    fn chosen(&self, _: V<One>, _: (F<One>, F<One>), _: F<One>) -> ChosenLobe {
        ChosenLobe::only("diffuse reflection")
    }
}
