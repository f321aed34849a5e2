//! Rough metal whose facets are wider along one tangent than along the other, such as brushed steel, or have the Beckmann distribution.
//!
//! The facets are those of `anisotropy.rs`. The light that single scattering loses is restored as in `conductor_bsdf.rs`, by the table of
//! `anisotropic_loss.rs`. With Beckmann facets, there is single scattering only.
use super::{
    Local, Materials, Shade, Stage,
    anisotropic_loss::AnisotropicLoss,
    anisotropy::Widths,
    beckmann::Beckmann,
    conductor_bsdf::{ConductorBsdf, FacetLoss},
    conductor_fresnel::ConductorRow,
};
use crate::sampling::Directions;
use noisefall_base::math::{F, Lanes, V};

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
    ($Stage:ident, $Facets:ty, $facets:expr, $lobes:expr) => {
        impl Shade for $Stage {
            type Bsdf<'a, L: Lanes> = ConductorBsdf<L, $Facets, AnisotropicLoss<'a, L>>;
            const STAGE: Stage = Stage::$Stage;
            const GLOSSY: bool = true;
            const CHARTED: bool = true;
            const LOBES: bool = $lobes;

            #[inline(always)]
            fn at<'a, L: Lanes>(l: L, materials: &'a Materials, _: Directions, at: &Local<L>) -> Self::Bsdf<'a, L> {
                let compensated = ConductorRow::read_compensated(l, materials, at.material);
                let (anisotropy, _) = TangentRow::read(l, materials, at);
                let widths = Widths::new(at.alpha, anisotropy);
                let loss = AnisotropicLoss::new(l, materials.tables.losses(), widths, compensated & anisotropy.above(0.0));
                ConductorBsdf::new(l, materials, at, $facets(widths), widths.mean(), loss)
            }

            #[inline(always)]
            fn turn<L: Lanes>(l: L, materials: &Materials, at: &Local<L>) -> (F<L>, F<L>) {
                TangentRow::read(l, materials, at).1
            }

            #[inline(always)]
            fn alpha<L: Lanes>(_: L, bsdf: &Self::Bsdf<'_, L>) -> F<L> {
                bsdf.alpha
            }
        }
    };
}
shade!(AnisotropicConductor, Widths<L>, std::convert::identity, true);
shade!(BeckmannConductor, Beckmann<Widths<L>>, Beckmann, false);

impl<L: Lanes> FacetLoss<L> for AnisotropicLoss<'_, L> {
    #[inline(always)]
    fn at(&self, _: L, w: V<L>) -> F<L> {
        self.at(w)
    }

    #[inline(always)]
    fn average(&self, _: L) -> F<L> {
        self.average()
    }

    #[inline(always)]
    fn width(&self) -> F<L> {
        self.width()
    }
}
