//! Colours along a scale, interpolated between stops.
use fearless_simd_macros::simd;

use super::{LookupResult, NumberSource, Pattern, Summary, TextureCompiler, TextureCoordinates, Textures, Texturing};
use crate::sampling::hash::hash_one;
use noisefall_base::{
    declare::{Declare, Kind, Parameter, Parameters, Problem, Range, Textured},
    math::{F, Lanes, M, One, Pick, V},
};

/// Colours along a scale, interpolated between stops.
#[derive(Clone, Debug, PartialEq)]
pub struct Ramp {
    /// Position on the scale.
    pub input: Textured<f64>,
    /// Colours by position, in ascending order.
    pub stops: Vec<Stop>,
}

/// A colour at a place of a scale.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stop {
    /// Place, from 0 to 1.
    pub at: f64,
    /// The colour there.
    pub color: [f64; 3],
}

impl Declare for Stop {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const AT: Parameter = Parameter::new("at", "Position on the scale.").required();
        const COLOR: Parameter = Parameter::new("color", "The colour there.").required();
        p.number(&AT, &mut self.at, Range::UNIT);
        p.colour(&COLOR, &mut self.color, Range::RADIANCE);
    }
}

impl Default for Ramp {
    fn default() -> Self {
        Ramp { input: Textured::Constant(0.5), stops: vec![Stop { at: 0.0, color: [0.0; 3] }, Stop { at: 1.0, color: [1.0; 3] }] }
    }
}

impl Kind for Ramp {
    const KIND: Parameter =
        Parameter::new("ramp", "Colours along a scale, interpolated between stops.").aliases("gradient color_ramp");
}

impl Declare for Ramp {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const INPUT: Parameter = Parameter::new("input", "Position on the scale; a texture counts by its luminance.").required();
        const STOPS: Parameter = Parameter::new("stops", "Colours by position, in ascending order.");
        p.textured_number(&INPUT, &mut self.input, Range::UNIT);
        p.list(&STOPS, &mut self.stops);
    }
}

impl Texturing for Ramp {
    type Pattern = Gradient;

    fn compile(&self, compiler: &mut TextureCompiler) -> Result<Gradient, Problem> {
        /// A lookup runs through all stops.
        const MOST: usize = 256;
        let count = self.stops.len();
        if count == 0 || count > MOST {
            return Err(Problem::at("stops", format!("the ramp has {count} stops"), format!("expected from 1 to {MOST}")));
        }
        if let Some(place) = self.stops.windows(2).position(|pair| pair[0].at > pair[1].at) {
            let at = format!("stops.{}.at", place + 1);
            return Err(Problem::at(&at, "the stops are not in ascending order", "this is before the stop above it"));
        }
        let stop = |stop: &Stop| (stop.at as f32, stop.color.map(|x| x as f32));
        Ok(Gradient { input: compiler.fraction("input", &self.input)?, stops: self.stops.iter().map(stop).collect() })
    }
}

/// A ramp as the renderer looks it up.
pub struct Gradient {
    /// Position on the scale.
    pub input: NumberSource,
    /// Places in ascending order, with their colours; at least one.
    pub stops: Vec<(f32, [f32; 3])>,
}

impl Gradient {
    #[simd]
    fn colour<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, textures: &Textures) -> V<L> {
        self.at(l, textures.fraction(l, self.input, here, at))
    }

    /// The colour at a place, that of the last stop where several stand there.
    #[inline(always)]
    fn at<L: Lanes>(&self, l: L, place: F<L>) -> V<L> {
        let (zero, one) = (l.f(0.0), l.f(1.0));
        let (mut before, first) = self.stops[0];
        let (mut before_colour, mut colour) = (first, V::splat(l, first));
        for (start, stop) in &self.stops[1..] {
            // Stops at the same place give an infinite number, or NaN at the place itself, which becomes 1.
            let t = ((place - before) / l.f(start - before)).min(one).max(zero);
            let between = V::splat(l, before_colour) * (1.0 - t) + V::splat(l, *stop) * t;
            colour = place.ge(l.f(before)).pick(between, colour);
            (before, before_colour) = (*start, *stop);
        }
        colour
    }

    /// The mean over a grid of points of the unit square, at random positions. A channel that is black there, but not in all stops,
    /// has that of the stops.
    fn mean(&self, textures: &Textures) -> [f32; 3] {
        const SIDE: u32 = 32;
        if let NumberSource::Constant(place) = self.input {
            return self.at(One, F(place)).lane(0);
        }
        let mut sum = [0.0; 3];
        for i in 0..SIDE * SIDE {
            let centre = |i: u32| F::<One>((i as f32 + 0.5) / SIDE as f32);
            // Within a kilometre, so that noise of any scale varies.
            let position = |axis: u32| F::<One>(hash_one(3 * i + axis) as f32 * (1000.0 / 4_294_967_296.0));
            let p = V { x: position(0), y: position(1), z: position(2) };
            let at = TextureCoordinates { u: centre(i % SIDE), v: centre(i / SIDE), p, vertex: None };
            let colour = self.colour(One, M(true), &at, textures).lane(0);
            (0..3).for_each(|channel| sum[channel] += f64::from(colour[channel]));
        }
        let of_stops =
            |channel: usize| self.stops.iter().map(|(_, colour)| colour[channel]).sum::<f32>() / self.stops.len() as f32;
        let found = sum.map(|x| (x / f64::from(SIDE * SIDE)) as f32);
        [0, 1, 2].map(|channel| if found[channel] > 0.0 { found[channel] } else { of_stops(channel) })
    }
}

impl Pattern for Gradient {
    fn summary(&self, textures: &Textures) -> Summary {
        let input = textures.summary_of_fraction(self.input);
        Summary {
            mean: self.mean(textures),
            maximum: [0, 1, 2].map(|channel| self.stops.iter().map(|(_, colour)| colour[channel]).fold(0.0, f32::max)),
            steps: input.steps,
            lookups: input.lookups,
        }
    }

    #[inline(always)]
    fn apply<L: Lanes>(&self, l: L, here: M<L>, at: &TextureCoordinates<L>, textures: &Textures, found: &mut LookupResult<L>) {
        found.colour = here.pick(self.colour(l, here, at, textures), found.colour);
    }
}
