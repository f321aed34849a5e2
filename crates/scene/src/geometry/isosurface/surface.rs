//! Points and normals of an isosurface, and offsets of rays that leave it.
use fearless_simd_macros::simd;

use super::{
    affine_form::AffineForm,
    jet::Jet,
    tape::{Quantity, REGISTERS, Tape, run},
};
use crate::geometry::SurfacePoint;
use noisefall_base::math::{F, Lanes, M, Pick, V};

/// The rounding of a point p + n·error off the surface, relative to its largest coordinate.
const ROUNDINGS_OF_X: f32 = 4.0 * f32::EPSILON;
/// Maximum number of times that the error bound is doubled if its proof fails.
const DOUBLINGS: u32 = 6;

/// The point of f = 0 near `p`, by one step of Newton's method along the gradient.
///
/// If the gradient vanishes or is not finite, such as at the tip of a cone, the point stays, and its normal is +y.
#[simd]
pub(super) fn surface_point<L: Lanes>(l: L, tape: &Tape, p: V<L>) -> SurfacePoint<L> {
    let mut registers = [Jet::<L, 3>::constant(l, 0.0); REGISTERS];
    let (zero, one) = (l.f(0.0), l.f(1.0));
    registers[0] = Jet { value: p.x, slope: [one, zero, zero] };
    registers[1] = Jet { value: p.y, slope: [zero, one, zero] };
    registers[2] = Jet { value: p.z, slope: [zero, zero, one] };
    let f = run(l, tape, &mut registers);
    let [x, y, z] = f.slope;
    let gradient = V { x, y, z };
    // Scaled to its largest component, so that its square cannot overflow.
    let largest = gradient.max_abs();
    let known = largest.above(0.0) & largest.below(f32::INFINITY);
    let direction = gradient * (1.0 / largest);
    let length = direction.length_squared().sqrt();
    let known = known & length.above(0.0);
    let n = known.pick(direction * (1.0 / length), V::splat(l, [0.0, 1.0, 0.0]));
    let steepness = known.pick(length * largest, one);
    let step = known.pick(f.value / steepness, zero);
    let p = p - n * step;
    SurfacePoint { p, n_geometric: n, error: clearance(l, tape, p, n, steepness, known) + p.max_abs() * ROUNDINGS_OF_X }
}

/// f at p.
#[simd]
pub(super) fn value<L: Lanes>(l: L, tape: &Tape, p: V<L>) -> F<L> {
    let mut registers = [Jet::<L, 0>::constant(l, 0.0); REGISTERS];
    for (register, value) in registers.iter_mut().zip([p.x, p.y, p.z]) {
        *register = Jet { value, slope: [] };
    }
    run(l, tape, &mut registers).value
}

/// The offset along ±n from p at which the sign of f is certain: the affine form of f over p ± δn proves it at both ends with a
/// margin of three times the rounding of f, one for the evaluation there and one for the affine form here. The first δ is twice
/// the sum of |f(p)| and the rounding over the `steepness`. At a crease, where the gradient is not that of both sides, there may
/// be no proof. The offset is kept then, and a ray that starts there has no side until f exceeds its rounding.
#[inline(always)]
fn clearance<L: Lanes>(l: L, tape: &Tape, p: V<L>, n: V<L>, steepness: F<L>, known: M<L>) -> F<L> {
    let mut registers = [AffineForm::constant(l, 0.0); REGISTERS];
    let zero = l.f(0.0);
    let here = around(l, tape, p, n, zero, &mut registers);
    let first = (here.a.abs() + here.r * 3.0) * 2.0 / steepness;
    let (mut distance, mut wanting) = (first, known);
    for _ in 0..DOUBLINGS {
        let f = around(l, tape, p, n, distance, &mut registers);
        let needed = f.r * 3.0;
        wanting = wanting & !(needed.lt(f.a + f.b) & needed.lt(f.b - f.a));
        if !wanting.any() {
            break;
        }
        distance = wanting.pick(distance + distance, distance);
    }
    known.pick(wanting.pick(first, distance), zero)
}

/// Encloses f from p − n·distance to p + n·distance.
#[inline(always)]
fn around<L: Lanes>(
    l: L,
    tape: &Tape,
    p: V<L>,
    n: V<L>,
    distance: F<L>,
    registers: &mut [AffineForm<L>; REGISTERS],
) -> AffineForm<L> {
    let zero = l.f(0.0);
    registers[0] = AffineForm::along(p.x, n.x, zero, distance);
    registers[1] = AffineForm::along(p.y, n.y, zero, distance);
    registers[2] = AffineForm::along(p.z, n.z, zero, distance);
    run(l, tape, registers)
}
