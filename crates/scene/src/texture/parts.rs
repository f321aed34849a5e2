//! Parts of textures that combine several: constants, and textures that are looked up at the same point.
use super::{ColourSource, Constant, NumberSource, Pattern, Summary, TextureCoordinates, Textures};
use noisefall_base::math::{
    F, Lanes, M, V,
    colour::{LUMINANCE, luminance},
};

/// Properties of a fraction.
pub(super) struct FractionSummary {
    /// Mean over the unit square.
    pub mean: f32,
    /// The largest value.
    pub maximum: f32,
    /// In u, in v, and in metres, as in [`Summary`].
    pub steps: [f32; 3],
    /// Lookups of textures.
    pub lookups: u32,
}

impl Textures {
    /// The colour of a part in the lanes `here`.
    #[inline(always)]
    pub(super) fn part<L: Lanes>(&self, l: L, part: ColourSource, here: M<L>, at: &TextureCoordinates<L>) -> V<L> {
        match part {
            ColourSource::Constant(colour) => V::splat(l, colour),
            ColourSource::Texture(id) => self.colour(l, l.u(id), here, at),
        }
    }

    /// The fraction of a part in the lanes `here`.
    #[inline(always)]
    pub(super) fn fraction<L: Lanes>(&self, l: L, part: NumberSource, here: M<L>, at: &TextureCoordinates<L>) -> F<L> {
        match part {
            NumberSource::Constant(x) => l.f(x),
            // The weights of luminance add up to 1 only within rounding.
            NumberSource::Texture(id) => self.colour(l, l.u(id), here, at).dot_with(LUMINANCE).min(l.f(1.0)),
        }
    }

    /// Properties of a part. A texture counts as a lookup, besides those that it makes itself.
    pub(super) fn summary_of_part(&self, part: ColourSource) -> Summary {
        match part {
            ColourSource::Constant(colour) => Constant(colour).summary(self),
            ColourSource::Texture(id) => {
                let summary = self.summary_of(id);
                Summary { lookups: summary.lookups.saturating_add(1), ..summary }
            }
        }
    }

    /// Properties of a fraction, counted likewise.
    pub(super) fn summary_of_fraction(&self, part: NumberSource) -> FractionSummary {
        let (mean, maximum, Summary { steps, lookups, .. }) = match part {
            NumberSource::Constant(x) => (x, x, self.summary_of_part(ColourSource::Constant([x; 3]))),
            NumberSource::Texture(id) => {
                let summary = self.summary_of_part(ColourSource::Texture(id));
                (luminance(summary.mean).min(1.0), luminance(summary.maximum).min(1.0), summary)
            }
        };
        FractionSummary { mean, maximum, steps, lookups }
    }
}

/// The smallest steps of several textures.
pub(super) fn finest(steps: impl IntoIterator<Item = [f32; 3]>) -> [f32; 3] {
    steps.into_iter().fold([Summary::COARSEST, Summary::COARSEST, f32::INFINITY], |a, b| [0, 1, 2].map(|i| f32::min(a[i], b[i])))
}
