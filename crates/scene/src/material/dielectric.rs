//! The smooth dielectric: mirror reflection and refraction.
use super::{
    AlphaSource, Bsdf, BsdfSample, ChosenLobe, Compile, CompiledMaterial, Lobes, Local, MaterialCompiler, Materials, Roughness,
    Shade, Stage,
    anisotropic_conductor::TangentRow,
    conductor::{ANISOTROPY, ENERGY_COMPENSATION, TANGENT_ROTATION},
    fresnel, ggx, ior,
    microfacets::{DISTRIBUTION, Distribution},
    refraction::{FAINT, uncompressed},
    tables::Interface,
};
pub use super::{rough_dielectric::RoughDielectric, tinted_dielectric::TintedDielectric};
use crate::sampling::Directions;
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Textured},
    math::{F, Lanes, M, One, Pick, U, V},
};

/// Glass in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Dielectric {
    /// Index of refraction on the back of the surface.
    pub ior: f64,
    /// Index of refraction on the side of the normal.
    pub ior_outside: f64,
    /// Roughness of the interface, 0 for a smooth one.
    pub roughness: Roughness,
    /// Distribution of the microfacets.
    pub distribution: Distribution,
    /// How much longer the highlight is along the tangent ∂p/∂u, from 0 (round) to 1.
    pub anisotropy: f64,
    /// Rotation of the tangent about the normal, degrees.
    pub tangent_rotation: f64,
    /// Transmittance of a metre of the interior, per channel.
    pub transmittance: [f64; 3],
    /// Factor of the light that the interface reflects.
    pub specular_reflectance: Textured,
    /// Factor of the light that passes the interface.
    pub specular_transmittance: Textured,
    /// Whether to add the light that scatters more than once between microfacets.
    pub energy_compensation: bool,
}

impl Default for Dielectric {
    fn default() -> Self {
        Dielectric {
            ior: 1.5,
            ior_outside: 1.0,
            roughness: Roughness::SMOOTH,
            distribution: Distribution::Ggx,
            anisotropy: 0.0,
            tangent_rotation: 0.0,
            transmittance: [1.0; 3],
            specular_reflectance: Textured::grey(1.0),
            specular_transmittance: Textured::grey(1.0),
            energy_compensation: true,
        }
    }
}

impl Dielectric {
    fn is_tinted(&self) -> bool {
        let white = Textured::grey(1.0);
        self.specular_reflectance != white || self.specular_transmittance != white
    }

    /// Glass with tints, Beckmann or anisotropic facets. With Beckmann facets, the light that scatters more than once is lost.
    fn tinted(
        &self,
        compiler: &mut MaterialCompiler,
        indices: [f32; 2],
        (alpha, most): (AlphaSource, f32),
    ) -> Result<CompiledMaterial, Problem> {
        let beckmann = self.distribution == Distribution::Beckmann;
        let compensated = self.energy_compensation && !beckmann && most >= ggx::SMOOTH;
        let row =
            DielectricRow { beckmann, ..DielectricRow::rough(compiler, indices, (alpha, most), self.anisotropy, compensated) };
        let colour = compiler.colour(&SPECULAR_REFLECTANCE, &self.specular_reflectance, &Range::UNIT)?;
        let transmittance = compiler.colour(&SPECULAR_TRANSMITTANCE, &self.specular_transmittance, &Range::UNIT)?;
        Ok(CompiledMaterial {
            alpha,
            colour,
            transmittance: Some(transmittance),
            inside: Some(self.transmittance.map(|x| x as f32)),
            rows: row.pack(),
            further: TangentRow { anisotropy: self.anisotropy, rotation: self.tangent_rotation }.pack(),
            charted: self.anisotropy > 0.0,
            ..CompiledMaterial::colourless(Stage::TintedDielectric)
        })
    }

    /// Glass of constant α, in a medium of index 1.
    pub fn new(ior: f32, alpha: f32, energy_compensation: bool) -> Dielectric {
        Dielectric { ior: f64::from(ior), roughness: Roughness::alpha(alpha), energy_compensation, ..Dielectric::default() }
    }
}

/// The tints of interfaces.
pub(super) const SPECULAR_REFLECTANCE: Parameter =
    Parameter::new("specular_reflectance", "Factor that multiplies the reflected light; 1 is physical.");
pub(super) const SPECULAR_TRANSMITTANCE: Parameter =
    Parameter::new("specular_transmittance", "Factor that multiplies the transmitted light; 1 is physical.");

impl Kind for Dielectric {
    const KIND: Parameter =
        Parameter::new("dielectric", "Glass, water: an interface that reflects and refracts, smooth or rough.")
            .aliases("glass refractive water transparent")
            .advice("such as dielectric = { ior = 1.5 }");
}

impl Declare for Dielectric {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const IOR: Parameter = ior("Index of refraction inside.");
        const IOR_OUTSIDE: Parameter =
            Parameter::new("ior_outside", "Index of refraction on the side of the normal.").symbol("η'");
        const TRANSMITTANCE: Parameter =
            Parameter::new("transmittance", "Fraction of the light that one metre of the interior transmits.")
                .symbol("T")
                .aliases("tint absorption");
        p.number(&IOR, &mut self.ior, Range::INDEX);
        p.number(&IOR_OUTSIDE, &mut self.ior_outside, Range::INDEX);
        p.one_of(&mut self.roughness);
        p.word(&DISTRIBUTION, &mut self.distribution);
        p.number(&ANISOTROPY, &mut self.anisotropy, Range::UNIT);
        p.number(&TANGENT_ROTATION, &mut self.tangent_rotation, Range::linear(-360.0, 360.0));
        let range =
            Range::UNIT.expected("every channel must lie in [0, 1]: the fraction that one metre of the interior transmits");
        p.colour(&TRANSMITTANCE, &mut self.transmittance, range);
        p.textured(&SPECULAR_REFLECTANCE, &mut self.specular_reflectance, Range::UNIT);
        p.textured(&SPECULAR_TRANSMITTANCE, &mut self.specular_transmittance, Range::UNIT);
        p.flag(&ENERGY_COMPENSATION, &mut self.energy_compensation);
    }
}

impl Compile for Dielectric {
    fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        let (alpha, most) = compiler.alpha(&self.roughness)?;
        let outside = self.ior_outside as f32;
        let eta = self.ior as f32 / outside;
        let is_beckmann = most >= ggx::SMOOTH && self.distribution == Distribution::Beckmann;
        let is_anisotropic = most >= ggx::SMOOTH && self.anisotropy > 0.0;
        if is_beckmann || is_anisotropic || self.is_tinted() {
            return self.tinted(compiler, [eta, outside], (alpha, most));
        }
        let mut row = DielectricRow { eta, outside, table: 0, varies: false, turned: false, beckmann: false };
        let mut stage = Stage::Dielectric;
        if most >= ggx::SMOOTH {
            row = DielectricRow::rough(compiler, [eta, outside], (alpha, most), 0.0, self.energy_compensation);
            stage = Stage::RoughDielectric;
        }
        let inside = Some(self.transmittance.map(|x| x as f32));
        Ok(CompiledMaterial { alpha, inside, rows: row.pack(), ..CompiledMaterial::colourless(stage) })
    }
}

/// The constants of an interface.
pub(super) struct DielectricRow {
    /// Index inside over that outside.
    eta: f32,
    /// Index outside.
    outside: f32,
    /// First row of the table of lost energy.
    table: u32,
    /// The table has rows for every roughness.
    varies: bool,
    /// The table has rows for every azimuth.
    turned: bool,
    /// Its facets have the Beckmann distribution.
    beckmann: bool,
}

impl DielectricRow {
    const VARIES: u32 = 1;
    const BECKMANN: u32 = 2;
    const TURNED: u32 = 4;

    /// A rough interface with GGX facets and its table.
    fn rough(
        compiler: &mut MaterialCompiler,
        [eta, outside]: [f32; 2],
        (alpha, most): (AlphaSource, f32),
        anisotropy: f64,
        compensated: bool,
    ) -> DielectricRow {
        let varies = matches!(alpha, AlphaSource::Texture { .. });
        let compensated = compensated && (eta - 1.0).abs() >= FAINT;
        let anisotropy = anisotropy as f32;
        let interface = Interface { eta, alpha: if varies { None } else { Some(most) }, anisotropy };
        let table = compiler.tables.interface(compensated.then_some(interface));
        let turned = compensated && anisotropy > 0.0;
        DielectricRow { eta, outside, table, varies: varies && compensated, turned, beckmann: false }
    }

    fn pack(&self) -> [[f32; 4]; 3] {
        let flag = |set: bool, flag: u32| if set { flag } else { 0 };
        let flags = flag(self.varies, Self::VARIES) | flag(self.beckmann, Self::BECKMANN) | flag(self.turned, Self::TURNED);
        let outside = self.outside * self.outside;
        [[self.eta, f32::from_bits(self.table), f32::from_bits(flags), outside], [0.0; 4], [0.0; 4]]
    }

    /// Lanes with Beckmann facets.
    #[inline(always)]
    pub fn read_beckmann<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> M<L> {
        let [_, _, flags, _] = materials.row(l, at.material, 0);
        !(flags.bits() & Self::BECKMANN).is(0)
    }

    /// Lanes whose tables have rows for every azimuth.
    #[inline(always)]
    pub fn read_turned<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> M<L> {
        let [_, _, flags, _] = materials.row(l, at.material, 0);
        !(flags.bits() & Self::TURNED).is(0)
    }

    /// The squared index outside, by which radiance there is less than in empty space.
    #[inline(always)]
    pub fn read_compression<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> F<L> {
        let [.., outside] = materials.row(l, at.material, 0);
        outside
    }

    /// The index beyond the surface over that on the side of the viewer, the table, and whether roughness varies.
    #[inline(always)]
    pub fn read<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> (F<L>, U<L>, M<L>) {
        let [inside_over_outside, table, flags, _] = materials.row(l, at.material, 0);
        let eta = at.front.pick(inside_over_outside, 1.0 / inside_over_outside);
        (eta, table.bits(), !(flags.bits() & Self::VARIES).is(0))
    }
}

impl Shade for Dielectric {
    type Bsdf<'a, L: Lanes> = DielectricBsdf<L>;
    const STAGE: Stage = Stage::Dielectric;
    const SEES_LIGHTS: bool = false;
    const TRANSMITS: bool = true;

    #[inline(always)]
    fn at<L: Lanes>(l: L, materials: &Materials, _: Directions, at: &Local<L>) -> DielectricBsdf<L> {
        let (eta, _, _) = DielectricRow::read(l, materials, at);
        DielectricBsdf { eta }
    }

    #[inline(always)]
    fn roulette_scale<L: Lanes>(bsdf: &DielectricBsdf<L>, front: M<L>, z: F<L>) -> F<L> {
        uncompressed(bsdf.eta, front, z)
    }

    #[inline(always)]
    fn compression_outside<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> F<L> {
        DielectricRow::read_compression(l, materials, at)
    }
}

/// The smooth interface between two transparent media.
///
/// Transmitted radiance is scaled by 1/η², because refraction changes the solid angle (Veach 1997, section 5.2). Light that
/// enters and leaves again keeps its radiance.
#[derive(Clone, Copy)]
pub struct DielectricBsdf<L: Lanes> {
    /// The index of refraction beyond the surface over that on the side of the viewer.
    pub eta: F<L>,
}

impl<L: Lanes> Bsdf<L> for DielectricBsdf<L> {
    /// Reflects with a probability equal to the reflectance, so the weight is 1 apart from the scale of radiance.
    #[inline(always)]
    fn sample(&self, wo: V<L>, _: (F<L>, F<L>), lobe: F<L>) -> BsdfSample<L> {
        let (reflectance, cos_t) = fresnel::dielectric(wo.z, self.eta);
        let reflects = lobe.lt(reflectance);
        let inverse = 1.0 / self.eta;
        let bend = reflects.pick(wo.z.splat(1.0), inverse);
        let wi = V { x: -(wo.x * bend), y: -(wo.y * bend), z: reflects.pick(wo.z, -cos_t) };
        let scale = bend * bend;
        BsdfSample { wi, weight: V { x: scale, y: scale, z: scale }, pdf: wo.z.splat(0.0), delta: everywhere(wo.z) }
    }
}

/// The mask of all lanes.
#[inline(always)]
fn everywhere<L: Lanes>(like: F<L>) -> M<L> {
    like.splat(0.0).below(1.0)
}

impl Lobes for DielectricBsdf<One> {
    fn chosen(&self, wo: V<One>, _: (F<One>, F<One>), lobe: F<One>) -> ChosenLobe {
        ChosenLobe::of_two(["mirror reflection", "refraction"], fresnel::dielectric(wo.z, self.eta).0.0, lobe)
    }
}
