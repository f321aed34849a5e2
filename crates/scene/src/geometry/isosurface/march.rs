//! The first point along a ray where f changes its sign.
//!
//! The march covers the segment of the ray in the box from its start, in pieces that grow by half after a decision and are halved
//! otherwise. Over a piece, the [`AffineForm`] of f shows one of these:
//!
//! * f has no zero: the march continues;
//! * f is monotone, and its sign at the end is known: if that is the sign so far, there is no zero either; otherwise there is
//!   exactly one, which [`refine`] finds;
//! * neither: the march tries half of the piece.
//!
//! So no change of sign is skipped, except two of them within 2⁻²² of the segment, or two between which |f| stays below its own
//! rounding. Such pieces are not halved further but passed, and the sign of f after them is compared with that before. A zero
//! without a change of sign is not a hit. A pole with a change of sign is.
//!
//! The start of the segment is not a hit: while rounding hides the sign of f, it has none, and later signs are compared with the
//! first known one.
use fearless_simd_macros::simd;

use super::{
    affine_form::{AffineForm, WIDEN},
    jet::Jet,
    tape::{Quantity, REGISTERS, Tape, run},
};
use noisefall_base::math::{F, Lanes, M, Pick, V};

/// Length of the shortest piece, as a fraction of the segment.
const SHORTEST: f32 = 1.0 / 4_194_304.0;
/// After this many pieces, the shortest length doubles with every [`COARSER`] further ones, so after 22 times it is the whole
/// segment. Features smaller than the pieces are then sampled, without proof.
const PATIENCE: u32 = 512;
const COARSER: u32 = 32;
/// Maximum number of pieces. Only a ray whose segment is so short that its pieces underflow does not reach its end; it misses.
const MOST_PIECES: u32 = PATIENCE + 24 * COARSER;
/// Pieces shorter than this fraction are tested for whether rounding hides f, and so are all after [`SUSPICIOUS_MANY`] pieces.
const SUSPICIOUS: f32 = 1.0 / 512.0;
const SUSPICIOUS_MANY: u32 = 64;
/// Rounding hides f if |f| is below this multiple of the bound of the rounding.
const HIDDEN: f32 = 4.0;
/// Steps of [`refine`] by Newton's method alone; further ones alternate with bisection, of which 24 steps exhaust f32.
const NEWTON_STEPS: u32 = 8;
const STEPS: u32 = 56;
/// The rounding of a position, as a fraction of its coordinates.
const RESOLUTION: f32 = 0.5 * f32::EPSILON;

type Registers<L> = [AffineForm<L>; REGISTERS];

/// The rays o + td with t from 0 to `end`.
pub(super) struct Segment<L: Lanes> {
    pub o: V<L>,
    pub d: V<L>,
    pub end: F<L>,
}

/// A change of sign of f, between `from` and `to` and about at `guess`; f has the sign of `side` before it.
struct Bracket<L: Lanes> {
    from: F<L>,
    to: F<L>,
    guess: F<L>,
    side: F<L>,
}

/// The conclusion from an affine form of a piece.
struct Verdict<L: Lanes> {
    /// Lanes where f is nowhere 0.
    sure: M<L>,
    /// Lanes where f is nowhere 0, or monotone with a known sign at the end.
    decided: M<L>,
    /// The sign of f at the end, where decided: ±1.
    sign: F<L>,
}

impl<L: Lanes> Verdict<L> {
    #[inline(always)]
    fn of(f: &AffineForm<L>) -> Self {
        let end = f.a + f.b;
        let sure = f.has_no_zero();
        let end_known = ((f.r + end.abs() * f32::EPSILON) * WIDEN).lt(end.abs());
        let sign = end.splat(1.0).copysign(sure.pick(f.a, end));
        Verdict { sure, decided: sure | (f.is_monotone() & end_known), sign }
    }
}

impl<L: Lanes> Segment<L> {
    /// Encloses f from `middle` − `half` to `middle` + `half`.
    #[inline(always)]
    fn enclose(&self, l: L, tape: &Tape, middle: F<L>, half: F<L>, registers: &mut Registers<L>) -> AffineForm<L> {
        let (o, d) = (self.o, self.d);
        registers[0] = AffineForm::along(o.x, d.x, middle, half);
        registers[1] = AffineForm::along(o.y, d.y, middle, half);
        registers[2] = AffineForm::along(o.z, d.z, middle, half);
        run(l, tape, registers)
    }

    /// Lanes whose piece around `middle`, enclosed by `f`, has values of f about as small as their rounding, so that further
    /// halving does not help.
    #[inline(always)]
    fn rounding_hides(&self, l: L, tape: &Tape, middle: F<L>, f: &AffineForm<L>, registers: &mut Registers<L>) -> M<L> {
        let point = self.enclose(l, tape, middle, l.f(0.0), registers);
        !point.has_no_zero() & (f.a.abs() + f.reach()).lt(point.r * HIDDEN)
    }
}

/// The smallest t at which f changes its sign, for the rays of `live`; NaN if there is none.
#[simd]
pub(super) fn first_change<L: Lanes>(l: L, tape: &Tape, segment: &Segment<L>, live: M<L>) -> F<L> {
    let zero = l.f(0.0);
    let mut registers = [AffineForm::constant(l, 0.0); REGISTERS];
    let start = segment.enclose(l, tape, zero, zero, &mut registers);
    // ±1, or 0 as long as it is not known.
    let mut side = start.has_no_zero().pick(l.f(1.0).copysign(start.a), zero);
    let mut bracket = Bracket { from: zero, to: zero, guess: zero, side };
    let (mut from, mut width, mut shortest) = (zero, segment.end * 0.25, segment.end * SHORTEST);
    // Up to where f has the sign of `side` for sure; beyond, up to `from`, pieces were passed.
    let mut known = zero;
    let (mut active, mut found) = (live, zero.below(0.0));
    let mut pieces = 0;
    while active.any() && pieces < MOST_PIECES {
        let to = (from + width).min(segment.end);
        let middle = (from + to) * 0.5;
        let half = (to - middle).max(middle - from) * (1.0 + 2.0 * f32::EPSILON);
        let f = segment.enclose(l, tape, middle, half, &mut registers);
        let Verdict { sure, decided, sign } = Verdict::of(&f);

        let changed = active & decided & (side * sign).below(0.0);
        let guess = middle - half * (f.a / f.b);
        bracket = changed.pick(Bracket { from: known, to: sure.pick(from, to), guess, side }, bracket);
        found = found | changed;

        let mut forward = decided | !shortest.lt(width);
        let shorter = segment.end * if pieces < SUSPICIOUS_MANY { SUSPICIOUS } else { 2.0 };
        let suspicious = active & !forward & width.lt(shorter);
        if suspicious.any() {
            forward = forward | (suspicious & segment.rounding_hides(l, tape, middle, &f, &mut registers));
        }
        side = (decided & !side.abs().above(0.0)).pick(sign, side);
        known = decided.pick(to, known);
        from = forward.pick(to, from);
        width = forward.pick(width * 1.5, width * 0.5);
        active = active & !changed & from.lt(segment.end);
        pieces += 1;
        if pieces > PATIENCE && pieces % COARSER == 0 {
            shortest = shortest + shortest;
        }
    }
    if !found.any() {
        return l.f(f32::NAN);
    }
    found.pick(refine(l, tape, segment, found, bracket), l.f(f32::NAN))
}

impl<L: Lanes> Pick<Bracket<L>> for M<L> {
    #[inline(always)]
    fn pick(self, a: Bracket<L>, b: Bracket<L>) -> Bracket<L> {
        Bracket {
            from: self.pick(a.from, b.from),
            to: self.pick(a.to, b.to),
            guess: self.pick(a.guess, b.guess),
            side: self.pick(a.side, b.side),
        }
    }
}

/// Newton's method, bracketed by ends at which the signs of f differ, until a step is below the rounding of the position.
#[simd]
fn refine<L: Lanes>(l: L, tape: &Tape, segment: &Segment<L>, found: M<L>, bracket: Bracket<L>) -> F<L> {
    let mut registers = [Jet::<L, 1>::constant(l, 0.0); REGISTERS];
    let Bracket { mut from, mut to, guess, side } = bracket;
    let mut t = guess.max(from).min(to);
    let (o, d) = (segment.o, segment.d);
    let origin = o.max_abs();
    let mut active = found;
    for step in 0..STEPS {
        registers[0] = Jet { value: o.x + d.x * t, slope: [d.x] };
        registers[1] = Jet { value: o.y + d.y * t, slope: [d.y] };
        registers[2] = Jet { value: o.z + d.z * t, slope: [d.z] };
        let f = run(l, tape, &mut registers);
        let before = (f.value * side).above(0.0);
        from = (active & before).pick(t, from);
        to = (active & !before).pick(t, to);
        let newton = t - f.value / f.slope[0];
        let halved = (from + to) * 0.5;
        let trusted = newton.ge(from) & to.ge(newton);
        let next = if step > NEWTON_STEPS && step % 2 == 0 { halved } else { trusted.pick(newton, halved) };
        let moved = (next - t).abs();
        t = active.pick(next, t);
        active = active & ((t + origin) * RESOLUTION).lt(moved);
        if !active.any() {
            break;
        }
    }
    t
}
