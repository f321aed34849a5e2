//! Rough metal whose facets are wider along one tangent than along the other, such as brushed steel, or have the Beckmann distribution.
//!
//! The facets are those of `anisotropy.rs`. The light that single scattering loses is restored by a factor 1 + ℓ/(1 − ℓ) F_avg E_avg /
//! (1 − F_avg (1 − E_avg)), where ℓ is no more than the loss towards the viewer and E_avg is that of a round distribution (E. Turquin,
//! "Practical multiple scattering compensation for microfacet models", 2019). The factor depends on ω_o alone: with it the BSDF is not
//! reciprocal, and some light stays lost. With Beckmann facets, there is single scattering only.
use super::{
    Bsdf, BsdfSample, ChosenLobe, Lobes, Local, Materials, Shade, Stage,
    albedo::Albedo,
    anisotropy::{Widths, loss},
    beckmann::Beckmann,
    conductor_fresnel::{ConductorFresnel, ConductorRow},
    microfacets::{self, Microfacets},
};
use crate::{
    math::{F, Lanes, M, One, Pick, V},
    sampling::Directions,
};

/// The stage of anisotropic conductors.
pub struct AnisotropicConductor;

/// The further constants of an anisotropic surface.
pub(super) struct TangentRow {
    /// From 0 to 1.
    pub anisotropy: f64,
    /// Degrees.
    pub rotation: f64,
}

impl TangentRow {
    pub fn pack(&self) -> Vec<[f32; 4]> {
        let (sin, cos) = self.rotation.to_radians().sin_cos();
        vec![[self.anisotropy as f32, cos as f32, sin as f32, 0.0]]
    }

    /// Anisotropy, and cosine and sine of the rotation.
    #[inline(always)]
    pub fn read<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> (F<L>, (F<L>, F<L>)) {
        let [_, _, _, row] = materials.row(l, at.material, 2);
        let [anisotropy, cos, sin, _] = l.rows(&materials.further, row.bits());
        (anisotropy, (cos, sin))
    }
}

/// The stage of conductors with Beckmann facets.
pub struct BeckmannConductor;

/// Implements [`Shade`] with facets of the widths at a point.
macro_rules! shade {
    ($Stage:ident, $Facets:ty, $facets:expr) => {
        impl Shade for $Stage {
            type Bsdf<'a, L: Lanes> = AnisotropicConductorBsdf<'a, L, $Facets>;
            const STAGE: Stage = Stage::$Stage;
            const GLOSSY: bool = true;
            const CHARTED: bool = true;
            const LOBES: bool = false;

            #[inline(always)]
            fn at<'a, L: Lanes>(l: L, materials: &'a Materials, _: Directions, at: &Local<L>) -> Self::Bsdf<'a, L> {
                let fresnel = ConductorFresnel::read(l, materials, at.material, at.colour);
                let compensated = ConductorRow::read_compensated(l, materials, at.material);
                let (anisotropy, _) = TangentRow::read(l, materials, at);
                let widths = Widths::new(at.alpha, anisotropy);
                AnisotropicConductorBsdf { l, loss: materials.tables.loss, fresnel, widths, facets: $facets(widths), compensated }
            }

            #[inline(always)]
            fn turn<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> (F<L>, F<L>) {
                TangentRow::read(l, materials, at).1
            }

            #[inline(always)]
            fn alpha<L: Lanes>(_: L, bsdf: &Self::Bsdf<'_, L>) -> F<L> {
                bsdf.widths.mean()
            }
        }
    };
}
shade!(AnisotropicConductor, Widths<L>, std::convert::identity);
shade!(BeckmannConductor, Beckmann<Widths<L>>, Beckmann);

/// The BSDF of an anisotropic conductor at a point.
#[derive(Clone, Copy)]
pub struct AnisotropicConductorBsdf<'a, L: Lanes, D = Widths<L>> {
    l: L,
    /// The table of lost light.
    loss: &'a [[f32; 4]],
    fresnel: ConductorFresnel<L>,
    widths: Widths<L>,
    /// Facets of these widths.
    facets: D,
    compensated: M<L>,
}

impl<L: Lanes, D: Microfacets<L>> AnisotropicConductorBsdf<'_, L, D> {
    /// The factor that restores lost light.
    #[inline(always)]
    fn gain(&self, wo: V<L>) -> V<L> {
        let white = V::splat(self.l, [1.0; 3]);
        if !self.compensated.any() {
            return white;
        }
        let lost = loss(self.l, self.loss, self.widths, self.compensated, wo);
        let mean = Albedo::at(self.loss, self.l.u(0), self.widths.mean()).average(self.l);
        let further = lost / (1.0 - lost) * (1.0 - mean);
        let f = self.fresnel.average();
        let gain = V {
            x: 1.0 + further * f.x / (1.0 - f.x * mean),
            y: 1.0 + further * f.y / (1.0 - f.y * mean),
            z: 1.0 + further * f.z / (1.0 - f.z * mean),
        };
        self.compensated.pick(gain, white)
    }
}

impl<L: Lanes, D: Microfacets<L>> Bsdf<L> for AnisotropicConductorBsdf<'_, L, D> {
    #[inline(always)]
    fn eval(&self, wo: V<L>, wi: V<L>) -> (V<L>, F<L>) {
        let zero = wo.z.splat(0.0);
        let h = (wo + wi).normalized();
        let density = microfacets::reflection_pdf(self.facets, wo, h);
        let f = self.fresnel.reflectance(wo.dot(h)) * self.gain(wo) * (density * microfacets::g1(self.facets, wi));
        let above = wi.z.above(0.0);
        (above.pick(f, V { x: zero, y: zero, z: zero }), above.pick(density, zero))
    }

    #[inline(always)]
    fn sample(&self, wo: V<L>, u: (F<L>, F<L>), _: F<L>) -> BsdfSample<L> {
        let wi = microfacets::sample_reflection(self.facets, wo, u);
        let (f, pdf) = self.eval(wo, wi);
        BsdfSample::of(wi, f, pdf)
    }
}

impl<D: Microfacets<One>> Lobes for AnisotropicConductorBsdf<'_, One, D> {
    fn chosen(&self, _: V<One>, _: (F<One>, F<One>), _: F<One>) -> ChosenLobe {
        ChosenLobe::only("microfacet reflection")
    }
}
