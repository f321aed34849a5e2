//! Anisotropic microfacets: a width along the tangent and one across it.
//!
//! OpenPBR Surface 1.1, section "Microfacet model": α_t = α √(2/(1 + (1 − a)²)) and α_b = (1 − a) α_t keep the mean square of both
//! widths.
use super::{
    albedo::Albedo,
    ggx::{self, SMOOTH, Width, facets},
    microfacets::Microfacets,
};
use noisefall_base::math::{F, Lanes, M, Pick, U, V};

/// The widths along x and along y of the local frame, at least [`SMOOTH`]; those of [`Widths::new`] and [`Widths::round`] are at most 1.
#[derive(Clone, Copy)]
pub struct Widths<L: Lanes> {
    x: F<L>,
    y: F<L>,
}

impl<L: Lanes> Widths<L> {
    /// The widths of α and of the anisotropy a, from 0 to 1.
    #[inline(always)]
    pub fn new(alpha: F<L>, anisotropy: F<L>) -> Self {
        let ratio = 1.0 - anisotropy;
        let x = alpha * (2.0 / (1.0 + ratio * ratio)).sqrt();
        Widths { x, y: x * ratio }.clamped()
    }

    /// A round distribution.
    #[inline(always)]
    pub fn round(alpha: F<L>) -> Self {
        Widths { x: alpha, y: alpha }.clamped()
    }

    /// Given widths along x and along y.
    #[inline(always)]
    pub fn along(x: F<L>, y: F<L>) -> Self {
        let least = x.splat(SMOOTH);
        Widths { x: x.max(least), y: y.max(least) }
    }

    #[inline(always)]
    fn clamped(self) -> Self {
        let (least, most) = (self.x.splat(SMOOTH), self.x.splat(1.0));
        Widths { x: self.x.max(least).min(most), y: self.y.max(least).min(most) }
    }

    /// The width of a round distribution with the same density of normals along z.
    #[inline(always)]
    pub fn mean(self) -> F<L> {
        (self.x * self.y).sqrt()
    }

    /// The width in the azimuth of a direction.
    #[inline(always)]
    pub fn towards(self, w: V<L>) -> F<L> {
        let square = w.x * w.x + w.y * w.y;
        let width = (self.stretched_square(w) / square).sqrt();
        square.above(1e-12).pick(width, self.mean()).max(square.splat(SMOOTH)).min(square.splat(1.0))
    }

    /// The widths along x and along y.
    pub fn both(self) -> [F<L>; 2] {
        [self.x, self.y]
    }

    /// The larger width.
    #[inline(always)]
    pub fn larger(self) -> F<L> {
        self.x.max(self.y)
    }

    /// The smaller width over the larger one.
    #[inline(always)]
    pub fn quotient(self) -> F<L> {
        self.x.min(self.y) / self.larger()
    }

    /// Cosine between the azimuth of a direction and the axis of the larger width, from 0 to 1.
    #[inline(always)]
    pub fn towards_larger(self, w: V<L>) -> F<L> {
        let square = w.x * w.x + w.y * w.y;
        let along = self.x.ge(self.y).pick(w.x, w.y).abs() / square.sqrt();
        square.above(1e-12).pick(along, square.splat(1.0))
    }

    /// This in the lanes of `mask`, `other` in the others.
    #[inline(always)]
    pub fn or(self, mask: M<L>, other: Self) -> Self {
        Widths { x: mask.pick(self.x, other.x), y: mask.pick(self.y, other.y) }
    }
}

facets!(Widths<L>);

impl<L: Lanes> Width<L> for Widths<L> {
    #[inline(always)]
    fn stretch(self, x: F<L>, y: F<L>) -> (F<L>, F<L>) {
        (x * self.x, y * self.y)
    }

    #[inline(always)]
    fn stretched_square(self, w: V<L>) -> F<L> {
        let (x, y) = self.stretch(w.x, w.y);
        x * x + y * y
    }

    #[inline(always)]
    fn squeezed_square(self, w: V<L>) -> F<L> {
        let (x, y) = (w.x / self.x, w.y / self.y);
        x * x + y * y
    }

    #[inline(always)]
    fn area(self) -> F<L> {
        self.x * self.y
    }
}

/// E/F of a coat or an interface seen from `w`, by the table of [`super::albedo_table::build`] that begins at row `first`. In the lanes of
/// `anisotropic` it is that of a round distribution with the width in the azimuth of `w`: within 0.02 of E in most directions.
#[inline(always)]
pub fn reflected<L: Lanes>(l: L, table: &[[f32; 4]], first: U<L>, widths: Widths<L>, anisotropic: M<L>, w: V<L>) -> F<L> {
    if !anisotropic.any() {
        return Albedo::at(table, first, widths.mean()).value(l, w.z);
    }
    Albedo::at(table, first, anisotropic.pick(widths.towards(w), widths.mean())).value(l, w.z)
}

/// The average over diffuse light of what [`reflected`] leaves: 1 − E.
#[inline(always)]
pub fn passed<L: Lanes>(l: L, table: &[[f32; 4]], first: U<L>, widths: Widths<L>, anisotropic: M<L>) -> F<L> {
    /// Cosines and sines of azimuths at equal distances.
    const AZIMUTHS: [[f32; 2]; 4] = [[0.980_785, 0.195_09], [0.831_47, 0.555_57], [0.555_57, 0.831_47], [0.195_09, 0.980_785]];
    let round = Albedo::at(table, first, widths.mean()).average(l);
    if !anisotropic.any() {
        return round;
    }
    let mut passed = l.f(0.0);
    for [x, y] in AZIMUTHS {
        passed = passed + Albedo::at(table, first, widths.towards(V::splat(l, [x, y, 0.0]))).average(l) * 0.25;
    }
    anisotropic.pick(passed, round)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{ggx, microfacets};
    use noisefall_base::math::One;

    fn directions() -> impl Iterator<Item = V<One>> {
        [1.0f32, 0.7, 0.3, 0.1, 0.02].into_iter().flat_map(|cos| {
            let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
            [(1.0, 0.0), (0.6, 0.8), (0.0, 1.0)].map(|(x, y)| V::splat(One, [sin * x, sin * y, cos]))
        })
    }

    #[test]
    fn equal_widths_are_a_round_distribution() {
        for w in directions() {
            let widths = Widths::new(F::<One>(0.3), F(0.0));
            let h = V::splat(One, [0.36, -0.48, 0.8]);
            for (round, wide) in [
                (ggx::d(F::<One>(0.3), h), ggx::d(widths, h)),
                (microfacets::g1(F::<One>(0.3), w), microfacets::g1(widths, w)),
                (microfacets::visible_normal_pdf(F::<One>(0.3), w, h), microfacets::visible_normal_pdf(widths, w, h)),
            ] {
                assert!((round.0 - wide.0).abs() <= 1e-5 * round.0, "{} {}", round.0, wide.0);
            }
        }
    }

    #[test]
    fn both_widths_keep_their_mean_square() {
        for anisotropy in [0.0, 0.3, 0.6, 0.9] {
            let Widths { x, y } = Widths::new(F::<One>(0.2), F(anisotropy));
            assert!((0.5 * (x.0 * x.0 + y.0 * y.0) - 0.04).abs() < 1e-6, "{} {}", x.0, y.0);
            assert!((y.0 - (1.0 - anisotropy) * x.0).abs() < 1e-6);
        }
    }
}
