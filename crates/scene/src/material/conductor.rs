//! Rough metal: GGX microfacets with compensation for multiple scattering (`conductor_bsdf.rs`).
pub use super::anisotropic_conductor::{AnisotropicConductor, BeckmannConductor};
use super::{
    Compile, CompiledMaterial, Local, MaterialCompiler, Materials, Roughness, Shade, Stage,
    albedo::Albedo,
    anisotropic_conductor::TangentRow,
    conductor_bsdf::ConductorBsdf,
    conductor_fresnel::{ConductorRow, Reflectance},
    ggx,
    microfacets::{DISTRIBUTION, Distribution},
};
use crate::sampling::Directions;
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range},
    math::{F, Lanes},
};

/// Metal in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Conductor {
    /// Reflectance of the microfacets.
    pub fresnel: Reflectance,
    /// Roughness, 0 for a smooth surface.
    pub roughness: Roughness,
    /// Distribution of the microfacets.
    pub distribution: Distribution,
    /// How much longer the highlight is along the tangent ∂p/∂u, from 0 (round) to 1.
    pub anisotropy: f64,
    /// Rotation of the tangent about the normal, degrees.
    pub tangent_rotation: f64,
    /// Whether to add the light that scatters more than once between microfacets.
    pub energy_compensation: bool,
}

impl Default for Conductor {
    fn default() -> Self {
        Conductor {
            fresnel: Reflectance::default(),
            roughness: Roughness::SMOOTH,
            distribution: Distribution::Ggx,
            anisotropy: 0.0,
            tangent_rotation: 0.0,
            energy_compensation: true,
        }
    }
}

impl Conductor {
    /// Metal of constant α.
    pub fn new(fresnel: Reflectance, alpha: f32, energy_compensation: bool) -> Conductor {
        Conductor { fresnel, roughness: Roughness::alpha(alpha), energy_compensation, ..Conductor::default() }
    }
}

/// The flag of conductors and dielectrics.
pub(super) const ENERGY_COMPENSATION: Parameter =
    Parameter::new("energy_compensation", "Whether to add the light that scatters more than once between microfacets.");

/// The anisotropy of conductors and dielectrics.
pub(super) const ANISOTROPY: Parameter =
    Parameter::new("anisotropy", "How much longer the highlight is along the tangent ∂p/∂u; 0 is round.");
pub(super) const TANGENT_ROTATION: Parameter =
    Parameter::new("tangent_rotation", "Rotation of the tangent about the normal.").unit("°");

impl Kind for Conductor {
    const KIND: Parameter = Parameter::new("conductor", "Metal, smooth or rough: microfacets with Fresnel's reflectance.")
        .aliases("metal metallic gold copper rough_conductor")
        .advice("such as conductor = { f0 = [1.0, 0.78, 0.34], roughness = 0.3 }");
}

impl Declare for Conductor {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(&mut self.fresnel);
        p.one_of(&mut self.roughness);
        p.word(&DISTRIBUTION, &mut self.distribution);
        p.number(&ANISOTROPY, &mut self.anisotropy, Range::UNIT);
        p.number(&TANGENT_ROTATION, &mut self.tangent_rotation, Range::linear(-360.0, 360.0));
        p.flag(&ENERGY_COMPENSATION, &mut self.energy_compensation);
    }
}

impl Compile for Conductor {
    fn compile(&self, compiler: &mut MaterialCompiler) -> Result<CompiledMaterial, Problem> {
        let (alpha, most) = compiler.alpha(&self.roughness)?;
        let is_beckmann = self.distribution == Distribution::Beckmann;
        let compensated = self.energy_compensation && !is_beckmann;
        if compensated {
            compiler.tables.need_loss(self.anisotropy > 0.0);
        }
        let row = ConductorRow::new(&self.fresnel, compensated);
        let colour = self.fresnel.colour(compiler)?;
        let mut stage = if most < ggx::SMOOTH { Stage::Mirror } else { Stage::Conductor };
        let mut further = Vec::new();
        if stage == Stage::Conductor && (is_beckmann || self.anisotropy > 0.0) {
            stage = if is_beckmann { Stage::BeckmannConductor } else { Stage::AnisotropicConductor };
            further = TangentRow { anisotropy: self.anisotropy, rotation: self.tangent_rotation }.pack();
        }
        let plain = CompiledMaterial::new(stage, colour, compiler);
        Ok(CompiledMaterial {
            alpha,
            rows: row.pack(),
            charted: !further.is_empty() && self.anisotropy > 0.0,
            further,
            scatters_where_black: !matches!(self.fresnel, Reflectance::Constant(_)),
            albedo: self.fresnel.head_on().unwrap_or(plain.albedo),
            ..plain
        })
    }
}

impl Shade for Conductor {
    type Bsdf<'a, L: Lanes> = ConductorBsdf<L, F<L>, Albedo<'a, L>>;
    const STAGE: Stage = Stage::Conductor;
    const GLOSSY: bool = true;

    #[inline(always)]
    fn at<'a, L: Lanes>(l: L, materials: &'a Materials, _: Directions, at: &Local<L>) -> Self::Bsdf<'a, L> {
        let alpha = at.alpha.max(l.f(ggx::SMOOTH));
        ConductorBsdf::new(l, materials, at, alpha, alpha, Albedo::at(materials.tables.loss, l.u(0), alpha))
    }

    #[inline(always)]
    fn alpha<L: Lanes>(_l: L, bsdf: &Self::Bsdf<'_, L>) -> F<L> {
        bsdf.alpha
    }
}
