//! The smooth mirror: a delta lobe times a metal's Fresnel reflectance.
use super::{
    Bsdf, BsdfSample, ChosenLobe, Compile, CompiledMaterial, Lobes, Local, MaterialCompiler, Materials, Shade, Stage,
    conductor_fresnel::ConductorFresnel,
};
use crate::sampling::Directions;
use noisefall_base::{
    declare::{Declare, Kind, Meaning, Parameter, Parameters, Problem, Range, Textured},
    math::{F, Lanes, One, V},
};

/// A mirror in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// Reflectance, from 0 to 1 in each channel.
    pub reflectance: Textured,
}

impl Default for Mirror {
    fn default() -> Self {
        Mirror { reflectance: Textured::grey(0.9) }
    }
}

const REFLECTANCE: Parameter = Parameter::new("reflectance", "Fraction of the light that is reflected, the same at every angle.")
    .symbol("r")
    .required()
    .aliases("color colour albedo rgb")
    .means(Meaning::Colour);

impl Kind for Mirror {
    const KIND: Parameter = Parameter::new("mirror", "A smooth mirror.").aliases("specular perfect_mirror reflective");
}

impl Declare for Mirror {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.textured(&REFLECTANCE, &mut self.reflectance, Range::REFLECTANCE);
    }
}

impl Compile for Mirror {
    fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        let reflectance = compiler.colour(&REFLECTANCE, &self.reflectance, &Range::REFLECTANCE)?;
        Ok(CompiledMaterial::new(Stage::Mirror, reflectance, compiler))
    }
}

impl Shade for Mirror {
    type Bsdf<'a, L: Lanes> = MirrorBsdf<L>;
    const STAGE: Stage = Stage::Mirror;
    const SEES_LIGHTS: bool = false;
    const LOBES: bool = false;

    #[inline(always)]
    fn at<L: Lanes>(l: L, materials: &Materials, _: Directions, at: &Local<L>) -> MirrorBsdf<L> {
        MirrorBsdf { fresnel: ConductorFresnel::read(l, materials, at.material, at.colour) }
    }
}

/// The BSDF of a mirror at a point.
#[derive(Clone, Copy)]
pub struct MirrorBsdf<L: Lanes> {
    fresnel: ConductorFresnel<L>,
}

impl<L: Lanes> Bsdf<L> for MirrorBsdf<L> {
    #[inline(always)]
    fn sample(&self, wo: V<L>, _u: (F<L>, F<L>), _lobe: F<L>) -> BsdfSample<L> {
        let wi = V { x: -wo.x, y: -wo.y, z: wo.z };
        let zero = wo.z.splat(0.0);
        BsdfSample { wi, weight: self.fresnel.reflectance(wo.z), pdf: zero, delta: zero.ge(zero) }
    }
}

impl Lobes for MirrorBsdf<One> {
    fn chosen(&self, _: V<One>, _: (F<One>, F<One>), _: F<One>) -> ChosenLobe {
        ChosenLobe::only("mirror reflection")
    }
}
