//! Affine forms contain what they enclose.
use glam::DVec3;
use rand::{Rng, SeedableRng, rngs::SmallRng};

use super::{
    super::{
        affine_form::AffineForm,
        tape::{Quantity, REGISTERS, run},
    },
    Expression, SHAPES,
    random::tree,
    unit_vector, v, value,
};
use noisefall_base::math::{F, One, V};

struct Piece {
    o: V<One>,
    d: V<One>,
    middle: f32,
    half: f32,
}

impl Piece {
    fn random(rng: &mut SmallRng) -> Piece {
        let o = v(unit_vector(rng) * rng.random_range(0.0..3.0));
        let half = 10f32.powf(rng.random_range(-6.0..0.5));
        Piece {
            o,
            d: v(unit_vector(rng)),
            middle: rng.random_range(0.0..2.0),
            half: if rng.random_range(0..9) == 0 { 0.0 } else { half },
        }
    }

    fn affine_form(&self, expression: &Expression) -> AffineForm<One> {
        let mut registers = [AffineForm::constant(One, 0.0); REGISTERS];
        let along = |o, d| AffineForm::along(o, d, F(self.middle), F(self.half));
        let (o, d) = (self.o, self.d);
        registers[..3].copy_from_slice(&[along(o.x, d.x), along(o.y, d.y), along(o.z, d.z)]);
        run(One, &expression.tape, &mut registers)
    }

    fn point(&self, s: f64) -> DVec3 {
        super::exact(self.o) + super::exact(self.d) * (f64::from(self.middle) + f64::from(self.half) * s)
    }
}

/// Checks an affine form, and returns whether it bounds anything.
fn assert_contains(expression: &Expression, piece: &Piece, rng: &mut SmallRng, what: &str) -> bool {
    let f = piece.affine_form(expression);
    let [a, b, r, q] = [f.a, f.b, f.r, f.q].map(|x| f64::from(x.0));
    if !(r.is_finite() && a.is_finite()) {
        return false;
    }
    let mut last: Option<(f64, f64)> = None;
    for i in 0..12 {
        let s = if i < 2 { f64::from(i) * 2.0 - 1.0 } else { rng.random_range(-1.0..1.0) };
        let exact = value(expression, piece.point(s));
        if !exact.is_finite() {
            continue;
        }
        let error = (exact - (a + b * s)).abs();
        assert!(error <= r * (1.0 + 1e-9), "{what} at s = {s}: {exact:e} is {error:e} from the line {a:e} + {b:e} s, not {r:e}");
        if let Some((s0, f0)) = last {
            let bent = ((exact - f0) - b * (s - s0)).abs();
            let slack = 1e-12 * (1.0 + exact.abs());
            assert!(q.is_nan() || bent <= q * (s - s0).abs() + slack, "{what}: bent by {bent:e} from {s0} to {s}, not {q:e}");
        }
        last = Some((s, exact));
    }
    true
}

#[test]
fn values_and_slopes_lie_in_affine_forms() {
    let mut rng = SmallRng::seed_from_u64(3);
    let (mut all, mut known) = (0, 0);
    for _ in 0..30_000 {
        let depth = rng.random_range(1..6);
        let text = tree(&mut rng, depth).to_string();
        let Ok(expression) = Expression::parse(&text) else { continue };
        for _ in 0..4 {
            let piece = Piece::random(&mut rng);
            all += 1;
            known += usize::from(assert_contains(&expression, &piece, &mut rng, &text));
        }
    }
    assert!(known * 2 > all, "{known} of {all}");
}

/// Half of how far the function is from its tangent at an end of the range, and a fifth of that more.
#[test]
fn lines_lie_as_near_to_their_functions_as_they_can() {
    let piece = Piece { o: v(DVec3::ZERO), d: v(DVec3::X), middle: 1.0, half: 0.125 };
    for text in ["1/x", "sqrt(x)", "exp(x)", "log(x)", "sin(x)", "cos(x)"] {
        let expression = Expression::parse(text).expect("an expression");
        let f = piece.affine_form(&expression);
        let exact = |s: f64| value(&expression, piece.point(s));
        let off = |s: f64| (exact(s) - exact(0.0) - f64::from(f.b.0) * s).abs();
        let least = 0.5 * off(-1.0).max(off(1.0));
        assert!((0.99..1.2).contains(&(f64::from(f.r.0) / least)), "{text}: {} for {least}", f.r.0);
    }
}

#[test]
fn affine_forms_of_shapes_shrink_with_the_square_of_the_piece() {
    let mut rng = SmallRng::seed_from_u64(4);
    for (name, text, _) in SHAPES.into_iter().filter(|(name, ..)| !["shell", "union"].contains(name)) {
        let expression = Expression::parse(text).expect("an expression");
        for _ in 0..1000 {
            let mut piece = Piece::random(&mut rng);
            piece.half = 1.0 / 128.0;
            assert_contains(&expression, &piece, &mut rng, name);
            let wide = piece.affine_form(&expression);
            piece.half = 1.0 / 1024.0;
            let narrow = piece.affine_form(&expression);
            assert!(narrow.r.0 < wide.r.0 / 50.0 + 3e-5 * (1.0 + wide.a.0.abs()), "{name}: {} {}", narrow.r.0, wide.r.0);
        }
    }
}
