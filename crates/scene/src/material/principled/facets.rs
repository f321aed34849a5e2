//! The microfacets of the base or of the coat, and the part of the light that they reflect.
use super::super::{
    anisotropy::{Widths, passed, reflected},
    fresnel::dielectric,
    ggx,
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

/// Microfacets of a dielectric interface.
#[derive(Clone, Copy)]
pub struct Facets<'a, L: Lanes> {
    l: L,
    rows: &'a [[f32; 4]],
    /// First row of the table of E/F.
    table: U<L>,
    /// Their α, and its widths along the tangent and across.
    pub alpha: F<L>,
    pub widths: Widths<L>,
    /// The other lanes are smooth.
    pub rough: M<L>,
    pub anisotropic: M<L>,
}

impl<'a, L: Lanes> Facets<'a, L> {
    /// `rows` are those of all tables.
    #[inline(always)]
    pub fn new(l: L, rows: &'a [[f32; 4]], table: U<L>, alpha: F<L>, anisotropy: F<L>) -> Self {
        let anisotropic = anisotropy.above(0.0);
        let mut widths = Widths::round(alpha);
        if anisotropic.any() {
            widths = Widths::new(alpha, anisotropy).or(anisotropic, widths);
        }
        Facets { l, rows, table, alpha, widths, rough: alpha.ge(alpha.splat(ggx::SMOOTH)), anisotropic }
    }

    /// E(w)/F(w·n) for directions above the surface; 1 in smooth lanes.
    #[inline(always)]
    pub fn quotient(&self, w: V<L>) -> F<L> {
        let smooth = w.z.splat(1.0);
        if !self.rough.any() {
            return smooth;
        }
        self.rough.pick(reflected(self.l, self.rows, self.table, self.widths, self.anisotropic, w), smooth)
    }

    /// The light from w that the interface of an index reflects in all directions.
    #[inline(always)]
    pub fn albedo(&self, w: V<L>, index: F<L>) -> F<L> {
        (dielectric(w.z.max(w.z.splat(0.0)), index).0 * self.quotient(w)).min(w.z.splat(1.0))
    }

    /// 1 − E, averaged over diffuse light, with the index of the table.
    #[inline(always)]
    pub fn passed(&self) -> F<L> {
        passed(self.l, self.rows, self.table, self.widths, self.anisotropic)
    }
}
