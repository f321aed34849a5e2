//! Solid-angle sampling of rectangles.
//!
//! C. Ureña, M. Fajardo and A. King, "An Area-Preserving Parametrization for Spherical Rectangles", Computer Graphics Forum
//! 32(4), 2013. Angles between the sides are computed from tangents rather than cosines, and 1 − x² is never computed for x²
//! close to 1, so f32 suffices at any distance from the rectangle or its plane.
use std::f32::consts::TAU;

use noisefall_base::math::{
    F, Lanes, M, V,
    trig::{sin_cos_turns, turns_of},
};

/// A rectangle is sampled by area if its area over the squared distance of its nearest point is less than this, in steradians:
/// that is as good and costs less.
const NEAR: f32 = 1.0;
/// It is also sampled by area if its solid angle is less than this number of turns (2π steradians), because the error of the
/// solid angle is 3e-7 turns.
const LEAST: f32 = 0.04;

/// A rectangle as seen from a point. The origin is the foot of the perpendicular from the point to the plane.
pub(super) struct SphericalRectangle<L: Lanes> {
    /// Least and greatest coordinates along the edges, in metres.
    x: [F<L>; 2],
    y: [F<L>; 2],
    /// Distance of the point from the plane.
    height: F<L>,
    /// Offset of the solid angle, in turns.
    start: F<L>,
    /// The solid angle in turns.
    angle: F<L>,
    /// Unit edges.
    along: [V<L>; 2],
}

impl<L: Lanes> SphericalRectangle<L> {
    /// Returns the lanes of `rectangles` that are better sampled by solid angle than by area, if there may be any, with their
    /// spherical rectangles. `place` has the coordinates of the point in edges, and `height` is that over the plane.
    #[inline(always)]
    pub fn of_near(rectangles: M<L>, edges: [V<L>; 2], place: [F<L>; 2], height: F<L>) -> Option<(M<L>, Self)> {
        if !rectangles.any() {
            return None;
        }
        let near = rectangles & is_near(edges, place, height);
        if !near.any() {
            return None;
        }
        let seen = SphericalRectangle::new(edges, place, height.abs());
        Some((near & seen.angle.above(LEAST), seen))
    }

    #[inline(always)]
    fn new(edges: [V<L>; 2], place: [F<L>; 2], height: F<L>) -> Self {
        let lengths = [edges[0].length_squared().sqrt(), edges[1].length_squared().sqrt()];
        let x = [-place[0] * lengths[0], (1.0 - place[0]) * lengths[0]];
        let y = [-place[1] * lengths[1], (1.0 - place[1]) * lengths[1]];
        let start = 1.0 - corner_angle(height, x[0], y[1], x[0] * y[1]) - corner_angle(height, x[0], y[0], -(x[0] * y[0]));
        let end = corner_angle(height, x[1], y[0], x[1] * y[0]) + corner_angle(height, x[1], y[1], -(x[1] * y[1]));
        let along = [edges[0] * (1.0 / lengths[0]), edges[1] * (1.0 / lengths[1])];
        SphericalRectangle { x, y, height, start, angle: end - start, along }
    }

    /// One over the solid angle.
    #[inline(always)]
    pub fn pdf(&self) -> F<L> {
        1.0 / (self.angle * TAU)
    }

    /// Samples a point of the rectangle, relative to the foot of the perpendicular.
    #[inline(always)]
    pub fn sample(&self, u: (F<L>, F<L>)) -> V<L> {
        let square = self.height * self.height;
        let [x0, x1] = self.x;
        let [y0, y1] = self.y;
        // The strip from x₀ to x has the solid angle φ − start.
        let (sin, cos) = sin_cos_turns(u.0 * self.angle + self.start);
        let side = 1.0 / (square + y0 * y0);
        let b0 = -y0 * side.sqrt();
        let b1 = y1 / (square + y1 * y1).sqrt();
        let f = (cos * b0 - b1) / sin;
        let x = self.height / (f * f - square * side).max(f.splat(f32::MIN_POSITIVE)).sqrt();
        let x = x.copysign(f).max(x0).min(x1);
        // And along the strip, uniform in the sine of the elevation.
        let from_edge = square + x * x;
        let (low, high) = (y0 / (from_edge + y0 * y0).sqrt(), y1 / (from_edge + y1 * y1).sqrt());
        let h = low + u.1 * (high - low);
        let rest = ((1.0 - h) * (1.0 + h)).max(h.splat(f32::MIN_POSITIVE));
        let y = (h * (from_edge / rest).sqrt()).max(y0).min(y1);
        self.along[0] * x + self.along[1] * y
    }
}

/// Whether the area is more than [`NEAR`] allows.
#[inline(always)]
fn is_near<L: Lanes>(edges: [V<L>; 2], place: [F<L>; 2], height: F<L>) -> M<L> {
    let squares = [edges[0].length_squared(), edges[1].length_squared()];
    let one = height.splat(1.0);
    let (x, y) = (place[0] - place[0].max(one.splat(0.0)).min(one), place[1] - place[1].max(one.splat(0.0)).min(one));
    let distance_squared = height * height + (x * x * squares[0] + y * y * squares[1]);
    let cubed = distance_squared * distance_squared * distance_squared;
    (cubed * (NEAR * NEAR)).lt(squares[0] * squares[1] * (height * height))
}

/// The angle at a corner of the spherical rectangle, or its supplement to half a turn, in turns: arccos of `product` over the
/// distances of the two sides.
#[inline(always)]
fn corner_angle<L: Lanes>(height: F<L>, x: F<L>, y: F<L>, product: F<L>) -> F<L> {
    turns_of(product, height * (height * height + (x * x + y * y)).sqrt())
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use rand::{Rng, SeedableRng, rngs::SmallRng};

    use super::*;
    use noisefall_base::math::One;

    /// Solid angle of a polygon, and the integral of the unit direction over it (Lambert's formula), from unit vectors to its
    /// corners.
    fn exact(corners: [DVec3; 4]) -> (f64, DVec3) {
        let triangle = |a: DVec3, b: DVec3, c: DVec3| {
            // A. van Oosterom and J. Strackee, "The Solid Angle of a Plane Triangle", 1983.
            2.0 * a.dot(b.cross(c)).abs().atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
        };
        let [a, b, c, d] = corners;
        let side = |a: DVec3, b: DVec3| a.cross(b).normalize() * a.angle_between(b) / 2.0;
        (triangle(a, b, c) + triangle(a, c, d), side(a, b) + side(b, c) + side(c, d) + side(d, a))
    }

    #[test]
    fn solid_angles_and_mean_directions_are_exact() {
        const GRID: u32 = 96;
        let mut rng = SmallRng::seed_from_u64(1);
        let mut met = 0;
        for _ in 0..4000 {
            let [width, depth] = [0, 1].map(|_| 10f32.powf(rng.random_range(-1.0..1.0)));
            let place = [0, 1].map(|_| rng.random_range(-0.5..1.5f32));
            let height = width.min(depth) * 10f32.powf(rng.random_range(-4.0..0.3));
            let edges = [V::splat(One, [width, 0.0, 0.0]), V::splat(One, [0.0, depth, 0.0])];
            let Some((M(true), seen)) = SphericalRectangle::of_near(M(true), edges, place.map(F), F(height)) else { continue };
            met += 1;
            let corner = |x: f32, y: f32| {
                let [x, y] = [(x - place[0]) * width, (y - place[1]) * depth].map(f64::from);
                DVec3::new(x, y, f64::from(height)).normalize()
            };
            let (angle, sum) = exact([corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)]);
            let measured = 1.0 / f64::from(seen.pdf().0);
            assert!((measured - angle).abs() < 3e-6, "{measured} {angle}: {width} {depth} {place:?} {height}");
            if height < 0.05 * width.min(depth) {
                // Directions along the plane fall between the cells of the grid.
                continue;
            }
            let mut mean = DVec3::ZERO;
            for (i, j) in (0..GRID).flat_map(|i| (0..GRID).map(move |j| (i, j))) {
                let u = |i: u32| F((i as f32 + 0.5) / GRID as f32);
                let V { x, y, .. } = seen.sample((u(i), u(j)));
                mean += DVec3::new(x.0.into(), y.0.into(), height.into()).normalize() / f64::from(GRID * GRID);
            }
            assert!(mean.distance(sum / angle) < 1e-3, "{mean} {}: {width} {depth} {place:?} {height}", sum / angle);
        }
        assert!(met > 1000, "{met}");
    }
}
