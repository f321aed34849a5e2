//! The isosurface: the set where a function of x, y and z, given as text, changes its sign. The inside is where it is negative.
//!
//! | | |
//! |---|---|
//! | `token.rs`, `names.rs`, `parse.rs`, `parse_error.rs`, `graph.rs` | text → tokens → a graph without duplicates |
//! | `tape.rs` | graph → a list of operations, evaluated for up to sixteen rays at once |
//! | `jet.rs` | values with derivatives |
//! | `affine_form.rs`, `lines.rs` | rigorous bounds of value and derivative over a segment |
//! | `functions.rs` | exp, log, sin and cos |
//! | `march.rs` | the first change of sign along a ray |
//! | `surface.rs` | point, normal and error bound |
//! | `light.rs` | surface coordinates; directions towards an emitting surface |
//!
//! f is evaluated in f32, with its constants rounded to f32. It is defined everywhere: √a is 0 for a < 0, and log a is at least
//! that of the smallest normal number.
mod affine_form;
mod functions;
mod graph;
mod jet;
mod light;
mod lines;
mod march;
mod names;
mod parse;
mod parse_error;
mod surface;
mod tape;
#[cfg(test)]
mod tests;
mod token;

pub use self::parse_error::ParseError;
use self::{
    march::{Segment, first_change},
    tape::Tape,
};
use crate::geometry::SurfacePoint;
use noisefall_base::math::{F, Lanes, Pick, V};

/// A function of x, y and z.
#[derive(Clone, Debug)]
pub struct Expression {
    tape: Tape,
}

impl Expression {
    /// Parses a formula of x, y and z.
    pub fn parse(text: &str) -> Result<Expression, ParseError> {
        let (graph, value) = parse::parse(text)?;
        Ok(Expression { tape: Tape::new(&graph, value, text)? })
    }
}

/// The part of a surface f = 0 inside a box; open where the box cuts it. Its front is the side with f > 0.
#[derive(Clone, Debug)]
pub struct Isosurface {
    expression: Expression,
    min: [f32; 3],
    max: [f32; 3],
    middle: [f32; 3],
}

impl Isosurface {
    /// The box.
    pub fn bounds(&self) -> ([f32; 3], [f32; 3]) {
        (self.min, self.max)
    }

    /// Builds an isosurface. `min` must be below `max`, and both finite.
    pub fn new(expression: Expression, min: [f32; 3], max: [f32; 3]) -> Isosurface {
        let middle = [0, 1, 2].map(|axis| 0.5 * min[axis] + 0.5 * max[axis]);
        Isosurface { expression, min, max, middle }
    }

    /// The nearest intersection with o + td, d of unit length, with 0 < t < `limit`; NaN if there is none.
    #[inline(always)]
    pub fn intersect<L: Lanes>(&self, l: L, o: V<L>, d: V<L>, limit: F<L>) -> F<L> {
        let (enter, leave) = self.inside_box(l, o, d);
        let end = leave.min(limit) - enter;
        let live = end.above(0.0) & end.below(f32::INFINITY);
        if !live.any() {
            return l.f(f32::NAN);
        }
        // From here on t counts from the box, so that f is evaluated with numbers of its size however far away the ray starts.
        let segment = Segment { o: o + d * enter, d, end };
        first_change(l, &self.expression.tape, &segment, live) + enter
    }

    /// The distances at which the ray enters the box, or 0 if it starts inside, and leaves it.
    #[inline(always)]
    fn inside_box<L: Lanes>(&self, l: L, o: V<L>, d: V<L>) -> (F<L>, F<L>) {
        let (mut enter, mut leave) = (l.f(0.0), l.f(f32::INFINITY));
        let (o, d) = ([o.x, o.y, o.z], [d.x, d.y, d.z]);
        for axis in 0..3 {
            let inverse = 1.0 / d[axis];
            let (a, b) = ((self.min[axis] - o[axis]) * inverse, (self.max[axis] - o[axis]) * inverse);
            // A ray within a face gives 0 · ∞, which the comparisons leave out.
            let forwards = inverse.above(0.0);
            enter = forwards.pick(a, b).max(enter);
            leave = forwards.pick(b, a).min(leave);
        }
        (enter, leave)
    }

    /// The surface at a point `p`, which is off the surface only by rounding.
    #[inline(always)]
    pub fn surface_point<L: Lanes>(&self, l: L, p: V<L>) -> SurfacePoint<L> {
        surface::surface_point(l, &self.expression.tape, p)
    }
}
