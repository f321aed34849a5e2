//! How much of a light a glossy surface reflects to the viewer: what the choice of a light knows of microfacets.
use crate::math::{F, Lanes, Pick, V};

/// The lobe of a conductor; with an `alpha` of 0 there is none.
#[derive(Clone, Copy)]
pub struct Lobe<L: Lanes> {
    /// Unit, towards the viewer.
    pub wo: V<L>,
    /// Width of the distribution of slopes.
    pub alpha: F<L>,
}

impl<L: Lanes> Lobe<L> {
    /// What stands for f cos θᵢ π, on average over a light within the angle of sine² `sin_squared` around `axis`, where `facing` is
    /// about its cosine at the surface. Where there is no lobe that is `facing`.
    ///
    /// For the microfacets' density D that of GGX is taken (Walter et al. 2007, equation 33), wider by as much as the directions
    /// to points of the light differ; and some of the cosine, for what is scattered more than once.
    #[inline(always)]
    pub(super) fn reflected(&self, n: V<L>, axis: V<L>, sin_squared: F<L>, facing: F<L>) -> F<L> {
        const SCATTERED: f32 = 0.05;
        const GRAZING: f32 = 0.05;
        let h = (self.wo + axis).normalized();
        let (across, along) = (h.dot(n), h.dot(self.wo));
        let along = along.max(along.splat(GRAZING));
        // Halfway vectors turn by half the angle, out of the plane of incidence by as much over the cosine.
        let alpha2 = self.alpha * self.alpha + sin_squared.min(sin_squared.splat(1.0)) * 0.25 / (along * along);
        // The squared sine by itself: 1 − cos² would have no digits left where α is least.
        let e = across * across * alpha2 + (h - n * across).length_squared();
        let lobe = alpha2 / (e * e * along * 4.0);
        self.alpha.above(0.0).pick(lobe + facing * SCATTERED, facing)
    }

    /// The same for light from everywhere.
    #[inline(always)]
    pub(super) fn of_sky(&self) -> F<L> {
        const LEAST: f32 = 0.02;
        // By cosine-distributed directions a narrow lobe is hardly met.
        self.alpha.above(0.0).pick((self.alpha * self.alpha).max(self.alpha.splat(LEAST)), self.alpha.splat(1.0))
    }
}
