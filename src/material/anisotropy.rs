//! Anisotropic microfacets: a width along the tangent and one across it.
//!
//! OpenPBR Surface 1.1, section "Microfacet model": α_t = α √(2/(1 + (1 − a)²)) and α_b = (1 − a) α_t keep the mean square of both
//! widths. The tables of lost light know round distributions only. [`loss`] is therefore an approximation from below: compensation
//! restores a part of the lost light, and never adds light.
use super::{
    albedo::Albedo,
    ggx::{self, SMOOTH, Width, facets},
    microfacets::Microfacets,
};
use crate::math::{F, Lanes, M, Pick, U, V};

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

/// 1 − E of perfectly reflecting microfacets seen from `w` above the surface, by the table of [`super::albedo::LOSS`]: exact within
/// its interpolation for round distributions, and nowhere more than the true loss in the lanes of `anisotropic`.
#[inline(always)]
pub fn loss<L: Lanes>(l: L, table: &[[f32; 4]], widths: Widths<L>, anisotropic: M<L>, w: V<L>) -> F<L> {
    /// The loss of the better of two round distributions exceeds the true one by up to a tenth; measured for α from 0.02 to 1 and
    /// anisotropies from 0.3 to 0.9.
    const MARGIN: f32 = 0.85;
    let round = Albedo::at(table, l.u(0), widths.mean()).value(l, w.z);
    if !anisotropic.any() {
        return round;
    }
    let turned = Albedo::at(table, l.u(0), widths.towards(w)).value(l, w.z);
    anisotropic.pick(round.min(turned) * MARGIN, round)
}

/// E/F of a coat or an interface seen from `w`, by the table of [`super::albedo_table::build`] that begins at row `first`: at least
/// the true quotient in the lanes of `anisotropic`.
#[inline(always)]
pub fn reflected<L: Lanes>(l: L, table: &[[f32; 4]], first: U<L>, widths: Widths<L>, anisotropic: M<L>, w: V<L>) -> F<L> {
    const MARGIN: f32 = 1.03;
    let round = Albedo::at(table, first, widths.mean()).value(l, w.z);
    if !anisotropic.any() {
        return round;
    }
    let turned = Albedo::at(table, first, widths.towards(w)).value(l, w.z);
    anisotropic.pick(round.max(turned) * MARGIN, round)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        material::{albedo::LOSS, ggx, microfacets},
        math::One,
    };

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

    #[test]
    fn the_loss_is_nowhere_more_than_the_true_one() {
        for (alpha, anisotropy) in [(0.02, 0.6), (0.1, 0.3), (0.1, 0.9), (0.3, 0.6), (0.6, 0.3), (0.6, 0.9), (1.0, 0.6)] {
            let widths = Widths::new(F::<One>(alpha), F(anisotropy));
            for w in directions() {
                let (mut kept, count) = (0.0, 28_657);
                for u in super::super::tests::lattice(count, 17_711) {
                    let wi = microfacets::sample_reflection(widths, w, u);
                    kept += if wi.z.0 > 0.0 { f64::from(microfacets::g1(widths, wi).0) } else { 0.0 };
                }
                let lost = 1.0 - kept / f64::from(count);
                let table = f64::from(loss(One, &LOSS, widths, M(true), w).0);
                assert!(table < lost + 1e-3, "{alpha} {anisotropy} at {}: {table} {lost}", w.z.0);
            }
        }
    }
}
