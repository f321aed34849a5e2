//! A thin sheet that reflects and transmits diffusely, such as a leaf: f = ρ/π on the side of the viewer and τ/π on the other.
//!
//! Both sides are alike. Light that passes leaves in all directions of the other side, so no medium is entered.
use std::f32::consts::FRAC_1_PI;

use super::{Bsdf, BsdfSample, ChosenLobe, Compile, CompiledMaterial, Lobes, Local, MaterialCompiler, Materials, Shade, Stage};
use crate::{sampling::Directions, texture::ColourSource};
use noisefall_base::{
    declare::{Declare, Kind, Meaning, Parameter, Parameters, Problem, Range, Textured},
    math::{F, Lanes, One, Pick, V},
};

/// A thin sheet that reflects and transmits diffusely, in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct DiffuseTransmission {
    /// Fraction of the light that is reflected.
    pub reflectance: Textured,
    /// Fraction of the light that is transmitted.
    pub transmittance: Textured,
}

impl Default for DiffuseTransmission {
    fn default() -> Self {
        DiffuseTransmission { reflectance: Textured::grey(0.25), transmittance: Textured::grey(0.25) }
    }
}

const REFLECTANCE: Parameter = Parameter::new("reflectance", "Fraction of the light that is reflected, per channel.")
    .symbol("ρ")
    .required()
    .means(Meaning::Colour);
const TRANSMITTANCE: Parameter =
    Parameter::new("transmittance", "Fraction of the light that is transmitted, per channel.").symbol("τ").required();

impl Kind for DiffuseTransmission {
    const KIND: Parameter =
        Parameter::new("diffuse_transmission", "A thin sheet, such as a leaf or paper, that reflects and transmits diffusely.")
            .aliases("translucent leaf paper diffusetransmission")
            .advice("such as diffuse_transmission = { reflectance = 0.3, transmittance = 0.2 }");
}

impl Declare for DiffuseTransmission {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.textured(&REFLECTANCE, &mut self.reflectance, Range::REFLECTANCE);
        p.textured(&TRANSMITTANCE, &mut self.transmittance, Range::REFLECTANCE);
    }
}

impl Compile for DiffuseTransmission {
    fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        let reflectance = compiler.colour(&REFLECTANCE, &self.reflectance, &Range::REFLECTANCE)?;
        let transmittance = compiler.colour(&TRANSMITTANCE, &self.transmittance, &Range::REFLECTANCE)?;
        let albedo = check_sum(compiler.maximum(reflectance), compiler.maximum(transmittance))?;
        Ok(CompiledMaterial {
            transmittance: Some(transmittance),
            scatters_where_black: transmittance != ColourSource::Constant([0.0; 3]),
            albedo,
            ..CompiledMaterial::new(Stage::DiffuseTransmission, reflectance, compiler)
        })
    }

    fn check(&self) -> Result<(), Problem> {
        match (&self.reflectance, &self.transmittance) {
            (Textured::Constant(reflectance), Textured::Constant(transmittance)) => {
                let [reflectance, transmittance] = [reflectance, transmittance].map(|rgb| rgb.map(|x| x as f32));
                check_sum(reflectance, transmittance).map(drop)
            }
            _ => Ok(()),
        }
    }
}

/// The largest sum of both fractions in any channel, which must not exceed 1.
fn check_sum(reflectance: [f32; 3], transmittance: [f32; 3]) -> Result<f32, Problem> {
    const ROUNDING: f32 = 1e-6;
    let sums = [0, 1, 2].map(|channel| reflectance[channel] + transmittance[channel]);
    match sums.iter().zip(["red", "green", "blue"]).find(|(sum, _)| **sum > 1.0 + ROUNDING) {
        Some((sum, channel)) => Err(Problem::at(
            "transmittance",
            format!("`reflectance` and `transmittance` add up to {sum} in {channel}; the sum must be at most 1"),
            "a sheet cannot scatter more light than it receives",
        )
        .help("textures count with their largest value")),
        None => Ok(sums.into_iter().fold(0.0, f32::max).min(1.0)),
    }
}

impl Shade for DiffuseTransmission {
    type Bsdf<'a, L: Lanes> = DiffuseTransmissionBsdf<L>;
    const STAGE: Stage = Stage::DiffuseTransmission;
    const DIFFUSE: bool = true;
    const TRANSMITS: bool = true;
    const ENTERS: bool = false;
    const HAS_TRANSMITTANCE: bool = true;

    #[inline(always)]
    fn at<L: Lanes>(l: L, _: &Materials, directions: Directions, at: &Local<L>) -> DiffuseTransmissionBsdf<L> {
        DiffuseTransmissionBsdf { reflectance: at.colour, transmittance: V::splat(l, [0.0; 3]), directions }
    }

    #[inline(always)]
    fn with_transmittance<'a, L: Lanes>(bsdf: Self::Bsdf<'a, L>, transmittance: V<L>) -> Self::Bsdf<'a, L> {
        DiffuseTransmissionBsdf { transmittance, ..bsdf }
    }
}

/// The BSDF of a sheet at a point.
#[derive(Clone, Copy)]
pub struct DiffuseTransmissionBsdf<L: Lanes> {
    /// Fraction of the light that is reflected.
    pub reflectance: V<L>,
    /// Fraction of the light that is transmitted.
    pub transmittance: V<L>,
    /// How directions are sampled.
    pub directions: Directions,
}

impl<L: Lanes> DiffuseTransmissionBsdf<L> {
    /// The probability of choosing reflection: its fraction of the light in the channel with the most reflected or transmitted light.
    #[inline(always)]
    fn chance(&self) -> F<L> {
        let (reflected, transmitted) = (self.reflectance.max_component(), self.transmittance.max_component());
        reflected / (reflected + transmitted).max(reflected.splat(f32::MIN_POSITIVE))
    }
}

impl<L: Lanes> Bsdf<L> for DiffuseTransmissionBsdf<L> {
    #[inline(always)]
    fn eval(&self, _wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let (cos, zero) = (wi.z.abs(), wi.z.splat(0.0));
        let reflects = wi.z.above(0.0);
        let chance = self.chance();
        let colour = reflects.pick(self.reflectance, self.transmittance);
        let pdf = self.directions.pdf(cos) * reflects.pick(chance, 1.0 - chance);
        (colour * (cos * FRAC_1_PI), cos.above(0.0).pick(pdf, zero))
    }

    #[inline(always)]
    fn sample(&self, _wo: V<L>, u: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let chance = self.chance();
        let reflects = lobe.lt(chance);
        let above = self.directions.sample(u);
        let of_side = reflects.pick(chance, 1.0 - chance);
        let colour = reflects.pick(self.reflectance, self.transmittance);
        BsdfSample {
            wi: V { z: reflects.pick(above.z, -above.z), ..above },
            weight: colour * (self.directions.lambertian_weight(above.z) / of_side),
            pdf: self.directions.pdf(above.z) * of_side,
            delta: above.z.below(0.0),
        }
    }
}

impl Lobes for DiffuseTransmissionBsdf<One> {
    fn chosen(&self, _: V<One>, _: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        ChosenLobe::of_two(["diffuse reflection", "diffuse transmission"], self.chance().0, lobe)
    }
}
