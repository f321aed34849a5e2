//! The product of two colours or textures.
use fearless_simd_macros::simd;

use super::{
    ColourSource, LookupResult, Pattern, Summary, TextureCompiler, TextureCoordinates, Textures, Texturing, parts::finest,
};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Textured},
    math::{Lanes, M, Pick, V},
};

/// The product of two colours or textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Product {
    /// First factor.
    pub a: Textured,
    /// Second factor.
    pub b: Textured,
}

impl Default for Product {
    fn default() -> Self {
        Product { a: Textured::grey(1.0), b: Textured::grey(1.0) }
    }
}

impl Kind for Product {
    const KIND: Parameter = Parameter::new("product", "The product of two colours or textures.").aliases("multiply scale");
}

impl Declare for Product {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const A: Parameter = Parameter::new("a", "First factor.").required();
        const B: Parameter = Parameter::new("b", "Second factor.").required();
        p.textured(&A, &mut self.a, Range::RADIANCE);
        p.textured(&B, &mut self.b, Range::RADIANCE);
    }
}

impl Texturing for Product {
    type Pattern = Factors;

    fn compile(&self, compiler: &mut TextureCompiler) -> Result<Factors, Problem> {
        let factors = Factors { a: compiler.source("a", &self.a)?, b: compiler.source("b", &self.b)? };
        let most = factors.summary(&compiler.textures).maximum.into_iter().fold(0.0, f32::max);
        if f64::from(most) > Range::RADIANCE.most {
            let message = format!("the product is out of range: it reaches {most}");
            return Err(Problem::at("b", message, Range::RADIANCE.expected));
        }
        Ok(factors)
    }
}

/// A product as the renderer looks it up.
pub struct Factors {
    /// The first factor.
    pub a: ColourSource,
    /// The second factor.
    pub b: ColourSource,
}

impl Factors {
    #[simd]
    fn colour<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, textures: &Textures) -> V<L> {
        textures.part(l, self.a, here, at) * textures.part(l, self.b, here, at)
    }
}

impl Pattern for Factors {
    /// The mean is that of factors that do not depend on each other; it is exact if one is constant.
    fn summary(&self, textures: &Textures) -> Summary {
        let [a, b] = [self.a, self.b].map(|part| textures.summary_of_part(part));
        Summary {
            mean: [0, 1, 2].map(|channel| a.mean[channel] * b.mean[channel]),
            maximum: [0, 1, 2].map(|channel| a.maximum[channel] * b.maximum[channel]),
            steps: finest([a.steps, b.steps]),
            lookups: a.lookups.saturating_add(b.lookups),
        }
    }

    #[inline(always)]
    fn apply<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, textures: &Textures, found: &mut LookupResult<L>) {
        found.colour = here.pick(self.colour(l, here, at, textures), found.colour);
    }
}
