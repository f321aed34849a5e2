//! Checker: squares of two textures in turn. The square at u = v = 0 is even.
use super::{LookupResult, Pattern, Summary, TextureCompiler, TextureCoordinates, Textures, Texturing};
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Textured},
    math::{F, Lanes, M, Pick, round::floor},
};

/// A checker in a scene description.
#[derive(Clone, Debug, PartialEq)]
pub struct Checker {
    /// Colour of the even squares.
    pub even: Textured,
    /// Colour of the odd squares.
    pub odd: Textured,
    /// Squares per unit of u and of v.
    pub scale: f64,
}

impl Default for Checker {
    fn default() -> Self {
        Checker { even: Textured::grey(0.8), odd: Textured::grey(0.2), scale: 8.0 }
    }
}

impl Kind for Checker {
    const KIND: Parameter =
        Parameter::new("checker", "Alternating squares of two colours over u and v.").aliases("checkerboard chess");
}

impl Declare for Checker {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const EVEN: Parameter =
            Parameter::new("even", "Colour of the square at u = v = 0 and of every second one.").required().aliases("color0 a");
        const ODD: Parameter = Parameter::new("odd", "Colour of the other squares.").required().aliases("color1 b");
        const SCALE: Parameter = Parameter::new("scale", "Squares along each side of the unit square.").required();
        p.textured(&EVEN, &mut self.even, Range::RADIANCE);
        p.textured(&ODD, &mut self.odd, Range::RADIANCE);
        p.number(&SCALE, &mut self.scale, Range::log(1e-6, 1e5));
    }
}

impl Texturing for Checker {
    type Pattern = Squares;

    fn compile(&self, compiler: &mut TextureCompiler) -> Result<Squares, Problem> {
        let (even, odd) = (compiler.part("even", &self.even)?, compiler.part("odd", &self.odd)?);
        Ok(Squares { even, odd, scale: self.scale as f32 })
    }
}

/// A checker as the renderer looks it up.
pub struct Squares {
    /// Ids of other textures.
    pub even: u32,
    /// Number of the texture of the odd squares.
    pub odd: u32,
    /// Squares per unit of u and v.
    pub scale: f32,
}

impl Pattern for Squares {
    fn summary(&self, textures: &Textures) -> Summary {
        let (even, odd) = (textures.summary_of(self.even), textures.summary_of(self.odd));
        let share = even_share(self.scale);
        let step = step(self.scale);
        let [[eu, ev, ep], [ou, ov, op]] = [even.steps, odd.steps];
        Summary {
            mean: [0, 1, 2].map(|channel| even.mean[channel] * share + odd.mean[channel] * (1.0 - share)),
            maximum: [0, 1, 2].map(|channel| f32::max(even.maximum[channel], odd.maximum[channel])),
            steps: [eu.min(ou).min(step), ev.min(ov).min(step), ep.min(op)],
            lookups: even.lookups.saturating_add(odd.lookups),
        }
    }

    #[inline(always)]
    fn apply<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, _: &Textures, found: &mut LookupResult<L>) {
        found.id = here.pick(is_even(at.u, at.v, self.scale).pick(l.u(self.even), l.u(self.odd)), found.id);
    }
}

/// Whether (u, v) lies on an even square, with `scale` squares per unit.
#[inline(always)]
pub fn is_even<L: Lanes>(u: F<L>, v: F<L>, scale: f32) -> M<L> {
    let (_, column) = floor(u * scale);
    let (_, row) = floor(v * scale);
    ((column ^ row) & 1).is(0)
}

/// The area of the even squares in the unit square.
pub fn even_share(scale: f32) -> f32 {
    let scale = f64::from(scale);
    let whole = scale.floor();
    let rest = scale - whole;
    let even_stripes = (whole / 2.0).ceil() + if whole % 2.0 == 0.0 { rest } else { 0.0 };
    let e = even_stripes / scale;
    (e * e + (1.0 - e) * (1.0 - e)) as f32
}

/// Step of finite differences, 1/32 of a square. A checker as a height field consists of cliffs, which become slopes of that
/// width.
pub fn step(scale: f32) -> f32 {
    1.0 / (32.0 * scale)
}
