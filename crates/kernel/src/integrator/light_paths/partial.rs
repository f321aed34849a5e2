//! Partial sums of the balance heuristic.
//!
//! The weight of a strategy is 1/Σ pₖ/p over all strategies k that could have found the path. When a path has reached a vertex, the terms
//! of the strategies with fewer vertices of this path are known except for two pdfs that depend on the next vertex: P, per area, with
//! which the other end would find this vertex, and R, per solid angle, with which the other path would go on from this vertex to the one
//! before. The sum is P (v + c R), and v and c are the numbers here. Between vertices, P is not yet a pdf per area at the next one:
//! [`Partial::arrive`] converts the numbers.
//!
//! In a single direction, as off a mirror, no other strategy can sample, so v becomes 0. Both pdfs of such a direction count as 1 at either
//! end. Roulette is no part of any pdf. Where vertices are merged, a term `merged` stands beside v: see `bidirectional/merge.rs`.
use noisefall_base::math::{F, Lanes, M, Pick, V};

/// Largest value of either number. Where a path has it, others find its light far more likely; larger numbers would become infinite.
const MOST: f32 = 1e30;

/// The cosine of the angle between a unit direction and a normal on either side, of which reciprocals are finite.
#[inline(always)]
pub fn cosine<L: Lanes>(d: V<L>, n: V<L>) -> F<L> {
    finite(d.dot(n))
}

/// A cosine as [`cosine`] returns it.
#[inline(always)]
pub fn finite<L: Lanes>(cos: F<L>) -> F<L> {
    cos.abs().max(cos.splat(1e-9))
}

/// Strategies with more vertices from the other end than a light sample has.
#[derive(Clone, Copy, PartialEq)]
pub enum CompetingStrategies {
    /// There are all of them.
    All,
    /// Strategies of earlier vertices remain only behind surfaces with a single direction.
    AfterDelta,
    /// There are none.
    None,
}

/// The two numbers of a path.
#[derive(Clone, Copy)]
pub struct Partial<L: Lanes> {
    pub v: F<L>,
    pub c: F<L>,
}

impl<L: Lanes> Partial<L> {
    /// At the next surface, after `t` metres, at an angle with this cosine.
    #[inline(always)]
    pub fn arrive(self, t: F<L>, cos: F<L>) -> Self {
        let inverse = 1.0 / cos;
        Partial { v: self.v * (t * t * inverse), c: self.c * inverse }.bounded()
    }

    /// After a direction with the pdf `pdf` has been sampled at an angle with the cosine `cos`; `reverse` is the pdf of the direction back
    /// to the vertex before.
    #[inline(always)]
    pub fn scatter(self, delta: M<L>, [pdf, reverse]: [F<L>; 2], cos: F<L>, others: CompetingStrategies, merged: f32) -> Self {
        let zero = pdf.splat(0.0);
        let of_delta = self.c * cos;
        let c = match others {
            CompetingStrategies::All => delta.pick(of_delta, (self.before(reverse) + merged) * (cos / pdf)),
            CompetingStrategies::AfterDelta => delta.pick(of_delta, zero),
            CompetingStrategies::None => zero,
        };
        Partial { v: delta.pick(zero, 1.0 / pdf), c }.bounded()
    }

    #[inline(always)]
    fn bounded(self) -> Self {
        let most = self.v.splat(MOST);
        Partial { v: self.v.min(most), c: self.c.min(most) }
    }

    /// The sum at a vertex for these P and R.
    #[inline(always)]
    pub fn sum(self, found: F<L>, sent_back: F<L>, merged: f32) -> F<L> {
        found * (self.before(sent_back) + merged)
    }

    /// The part of the strategies that join the paths before this vertex.
    #[inline(always)]
    pub fn before(self, sent_back: F<L>) -> F<L> {
        self.v + self.c * sent_back
    }
}
