//! A mixture of two colours or textures.
use fearless_simd_macros::simd;

use super::{
    ColourSource, LookupResult, NumberSource, Pattern, Summary, Texture, TextureCompiler, TextureCoordinates, Textures,
    Texturing, compiler::MOST_LOOKUPS, parts::finest,
};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Textured},
    math::{Lanes, M, Pick, V},
};

/// A mixture of two colours or textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Mix {
    /// Colour where the weight is 0.
    pub a: Textured,
    /// Colour where the weight is 1.
    pub b: Textured,
    /// Fraction of the second color.
    pub weight: Textured<f64>,
}

impl Default for Mix {
    fn default() -> Self {
        Mix { a: Textured::grey(0.0), b: Textured::grey(1.0), weight: Textured::Constant(0.5) }
    }
}

impl Kind for Mix {
    const KIND: Parameter = Parameter::new("mix", "A mixture of two colours or textures.").aliases("lerp blend_texture");
}

impl Declare for Mix {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const A: Parameter = Parameter::new("a", "Colour where the weight is 0.").required();
        const B: Parameter = Parameter::new("b", "Colour where the weight is 1.").required();
        const WEIGHT: Parameter = Parameter::new("weight", "Fraction of the second colour; a texture counts by its luminance.");
        p.textured(&A, &mut self.a, Range::RADIANCE);
        p.textured(&B, &mut self.b, Range::RADIANCE);
        p.textured_number(&WEIGHT, &mut self.weight, Range::UNIT);
    }
}

impl Texturing for Mix {
    type Pattern = Mixture;

    fn compile(&self, compiler: &mut TextureCompiler) -> Result<Mixture, Problem> {
        let (a, b) = (compiler.source("a", &self.a)?, compiler.source("b", &self.b)?);
        Ok(Mixture { a, b, weight: compiler.fraction("weight", &self.weight)? })
    }
}

/// A mixture as the renderer looks it up.
pub struct Mixture {
    /// Colour where the weight is 0.
    pub a: ColourSource,
    /// Colour where the weight is 1.
    pub b: ColourSource,
    /// Fraction of the second colour.
    pub weight: NumberSource,
}

impl Mixture {
    #[simd]
    fn colour<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, textures: &Textures) -> V<L> {
        let weight = textures.fraction(l, self.weight, here, at);
        textures.part(l, self.a, here, at) * (1.0 - weight) + textures.part(l, self.b, here, at) * weight
    }

    /// The largest value of a channel: a mixture by any weight up to the largest is at most the larger one of its ends.
    fn most(&self, a: f32, b: f32, weight: f32) -> f32 {
        let end = a * (1.0 - weight) + b * weight;
        if let NumberSource::Constant(_) = self.weight { end } else { a.max(end) }
    }
}

impl TextureCompiler<'_> {
    /// The mixture of two colours: constant if everything is, or else a texture without a name. `None` if that needs too many lookups.
    pub fn mixture(&mut self, a: ColourSource, b: ColourSource, weight: NumberSource) -> Option<ColourSource> {
        if a == b {
            return Some(a);
        }
        if let (ColourSource::Constant(a), ColourSource::Constant(b), NumberSource::Constant(weight)) = (a, b, weight) {
            let [a, b, weight] = [a, b, [weight; 3]].map(|of| of.map(f64::from));
            // Rounded once.
            return Some(ColourSource::Constant([0, 1, 2].map(|i| (a[i] * (1.0 - weight[i]) + b[i] * weight[i]) as f32)));
        }
        let mixture = Mixture { a, b, weight };
        let is_quick = mixture.summary(&self.textures).lookups <= MOST_LOOKUPS;
        is_quick.then(|| ColourSource::Texture(self.push(Texture::Mix(mixture))))
    }
}

impl Pattern for Mixture {
    /// The mean is that of a weight that does not depend on the colours; it is exact if the weight or both colours are constant.
    fn summary(&self, textures: &Textures) -> Summary {
        let [a, b] = [self.a, self.b].map(|part| textures.summary_of_part(part));
        let weight = textures.summary_of_fraction(self.weight);
        let mean = |channel: usize| a.mean[channel] * (1.0 - weight.mean) + b.mean[channel] * weight.mean;
        Summary {
            mean: [0, 1, 2].map(mean),
            maximum: [0, 1, 2].map(|channel| self.most(a.maximum[channel], b.maximum[channel], weight.maximum)),
            steps: finest([a.steps, b.steps, weight.steps]),
            lookups: a.lookups.saturating_add(b.lookups).saturating_add(weight.lookups),
        }
    }

    #[inline(always)]
    fn apply<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, textures: &Textures, found: &mut LookupResult<L>) {
        found.colour = here.pick(self.colour(l, here, at, textures), found.colour);
    }
}
