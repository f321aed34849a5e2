//! A constant colour, for textures that are only a colour.
use super::{LookupResult, Pattern, Summary, TextureCoordinates, Textures};
use noisefall_base::math::{Lanes, M, Pick, V};

/// Linear Rec. 709.
pub struct Constant(pub [f32; 3]);

impl Pattern for Constant {
    fn summary(&self, _: &Textures) -> Summary {
        Summary { mean: self.0, maximum: self.0, steps: [Summary::COARSEST, Summary::COARSEST, f32::INFINITY], lookups: 0 }
    }

    #[inline(always)]
    fn apply<L: Lanes>(&self, l: L, here: M<L>, _: &TextureCoordinates<L>, _: &Textures, found: &mut LookupResult<L>) {
        found.colour = here.pick(V::splat(l, self.0), found.colour);
    }
}
