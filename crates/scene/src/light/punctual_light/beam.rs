//! The radiance of punctual lights at points, in lanes: each lane has a light of its own, or all have the same.
use std::f32::consts::TAU;

use super::row::{BY_ANGLE, EVEN, PICTURE, PunctualRow, PunctualRows};
use crate::sampling::warp::cap;
use noisefall_base::math::{
    F, Frame, Lanes, M, Pick, U, V,
    trig::{sin_cos_turns, turns_of},
};

/// Lights in lanes.
pub struct Beam<L: Lanes> {
    row: PunctualRow<F<L>>,
}

/// The way from points to their lights.
pub struct Way<L: Lanes> {
    /// Unit direction towards the light.
    pub wi: V<L>,
    /// Distance, metres; infinite for directional lights.
    pub distance: F<L>,
    /// Irradiance of a surface that faces the light, for each unit of its power: 1/distance², or 1 for directional lights.
    pub spread: F<L>,
}

impl<L: Lanes> Beam<L> {
    /// The lights of these numbers.
    #[inline(always)]
    pub fn read(l: L, rows: &[[f32; 4]], punctual_light: U<L>) -> Self {
        let first = punctual_light * 5;
        let rows = [
            l.rows(rows, first),
            l.rows(rows, first + 1),
            l.rows(rows, first + 2),
            l.rows(rows, first + 3),
            l.rows(rows, first + 4),
        ];
        Beam { row: PunctualRow::read(rows) }
    }

    /// One light in all lanes.
    #[inline(always)]
    pub fn of_all(l: L, rows: &PunctualRows) -> Self {
        let mut lanes = [[l.f(0.0); 4]; 5];
        for (lanes, row) in lanes.iter_mut().zip(rows) {
            for (lane, x) in lanes.iter_mut().zip(row) {
                *lane = l.f(*x);
            }
        }
        Beam { row: PunctualRow::read(lanes) }
    }

    /// The way from `p` to the light.
    #[inline(always)]
    pub fn way_from(&self, l: L, p: V<L>) -> Way<L> {
        /// Square of the smallest distance, so that no number becomes infinite.
        const NEAREST: f32 = 1e-30;
        let PunctualRow { origin, w, .. } = self.row;
        let way = vector(origin) - p * w;
        let squared = way.length_squared().max(l.f(NEAREST));
        let length = squared.sqrt();
        let spread = w.above(0.0).pick(1.0 / squared, l.f(1.0));
        Way { wi: way * (1.0 / length), distance: length / w, spread }
    }

    /// The position and, in the lanes of directional lights, the unit direction towards them.
    #[inline(always)]
    pub fn origin(&self) -> (V<L>, M<L>) {
        (vector(self.row.origin), !self.row.w.above(0.0))
    }

    /// The axis of the cap of directions that contains all light, and its height: 2 is the sphere. Images lie in the hemisphere
    /// around the normal of their plane.
    #[inline(always)]
    fn cap(&self, l: L) -> (V<L>, F<L>) {
        let word = self.word();
        let (even, is_cone) = (word.is(EVEN), word.below(PICTURE));
        let PunctualRow { axis_or_x, edge, z, .. } = self.row;
        let axis = even.pick(V::splat(l, [0.0, 0.0, 1.0]), is_cone.pick(vector(axis_or_x), vector(z)));
        // The edge is a cosine, or an angle as negative turns.
        let (_, cos_of_angle) = sin_cos_turns(-edge);
        let cos = word.is(BY_ANGLE).pick(cos_of_angle, edge);
        // Wider than the cone by more than the rounding.
        let height = (1.0 - cos + 1e-4).min(l.f(2.0));
        (axis.normalized(), even.pick(l.f(2.0), is_cone.pick(height, l.f(1.0))))
    }

    /// Samples a unit direction of light away from lights with a position.
    #[inline(always)]
    pub fn sample_direction(&self, l: L, u: (F<L>, F<L>)) -> V<L> {
        let (axis, height) = self.cap(l);
        Frame::new(axis).world_from_local(cap(height, u))
    }

    /// The pdf of [`Beam::sample_direction`] per solid angle, the same for all directions.
    #[inline(always)]
    pub fn direction_pdf(&self, l: L) -> F<L> {
        let (_, height) = self.cap(l);
        1.0 / (height * TAU)
    }

    /// The power of the beam on its axis.
    #[inline(always)]
    pub fn power(&self) -> V<L> {
        vector(self.row.power)
    }

    /// The word of the shape.
    #[inline(always)]
    fn word(&self) -> U<L> {
        self.row.shape.bits()
    }

    /// Lanes that cast the image of this number: 0 is white.
    #[inline(always)]
    pub fn casts(&self, picture: u32) -> M<L> {
        self.word().is(PICTURE + picture)
    }

    /// The fraction of the power in the unit direction `d` away from the light, without the image of a projector.
    #[inline(always)]
    pub fn strength(&self, l: L, d: V<L>) -> F<L> {
        let word = self.word();
        let even = word.is(EVEN);
        if !(!even).any() {
            return l.f(1.0);
        }
        let is_cone = word.below(PICTURE);
        let (_, _, inside) = self.picture_place(l, d);
        let picture = inside.pick(self.rise(l, d) * self.dimming(l, d), l.f(0.0));
        even.pick(l.f(1.0), is_cone.pick(self.cone(l, d), picture))
    }

    /// The rise of a flat image's intensity away from its axis, 1/cos³; 1 for other images.
    #[inline(always)]
    fn rise(&self, l: L, d: V<L>) -> F<L> {
        let PunctualRow { z, length, .. } = self.row;
        let slant = length / d.dot(vector(z));
        length.above(0.0).pick(slant * slant * slant, l.f(1.0))
    }

    /// The falloff of an image's cone; 1 without one.
    #[inline(always)]
    fn dimming(&self, l: L, d: V<L>) -> F<L> {
        let PunctualRow { edge, factor, z, .. } = self.row;
        let axis = vector(z);
        let place = -turns_of(d.dot(axis), d.cross(axis).length_squared().sqrt());
        let t = ((place - edge) * factor).max(l.f(0.0)).min(l.f(1.0));
        factor.above(0.0).pick(t, l.f(1.0))
    }

    /// The falloff of a cone.
    #[inline(always)]
    fn cone(&self, l: L, d: V<L>) -> F<L> {
        let PunctualRow { axis_or_x, edge, falloff_or_y: [a, b, c], factor, .. } = self.row;
        let axis = vector(axis_or_x);
        let cos = d.dot(axis);
        let angle = -turns_of(cos, d.cross(axis).length_squared().sqrt());
        let place = self.word().is(BY_ANGLE).pick(angle, cos);
        let t = ((place - edge) * factor).max(l.f(0.0)).min(l.f(1.0));
        t * (a + t * (b + t * c))
    }

    /// Where the direction `d` is in the image: u to the right and v down, and whether both are in [0, 1].
    #[inline(always)]
    pub fn picture_place(&self, l: L, d: V<L>) -> (F<L>, F<L>, M<L>) {
        let PunctualRow { axis_or_x, falloff_or_y, z, .. } = self.row;
        let z = d.dot(vector(z));
        let half = 0.5 / z;
        let (u, v) = (d.dot(vector(axis_or_x)) * half + 0.5, 0.5 - d.dot(vector(falloff_or_y)) * half);
        let (zero, one) = (l.f(0.0), l.f(1.0));
        (u, v, z.above(0.0) & u.ge(zero) & one.ge(u) & v.ge(zero) & one.ge(v))
    }
}

#[inline(always)]
fn vector<L: Lanes>([x, y, z]: [F<L>; 3]) -> V<L> {
    V { x, y, z }
}
