//! `V`: 3-vectors (points, directions, colours) in lanes.
use std::ops::{Add, Mul, Neg, Sub};

use super::{
    lanes::{F, Lanes, M},
    number::Pick,
};

/// A 3-vector per lane. Colours use the same type: x, y, z are linear red, green, blue.
pub struct V<L: Lanes> {
    /// First component.
    pub x: F<L>,
    /// Second component.
    pub y: F<L>,
    /// Third component.
    pub z: F<L>,
}

impl<L: Lanes> Clone for V<L> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<L: Lanes> Copy for V<L> {}

macro_rules! by_component {
    ($($op:ident $method:ident),*) => { $(
        impl<L: Lanes> $op for V<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                V { x: self.x.$method(b.x), y: self.y.$method(b.y), z: self.z.$method(b.z) }
            }
        }
        impl<L: Lanes> $op<[f32; 3]> for V<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: [f32; 3]) -> Self {
                V { x: self.x.$method(b[0]), y: self.y.$method(b[1]), z: self.z.$method(b[2]) }
            }
        }
    )* };
}
by_component!(Add add, Sub sub, Mul mul);

impl<L: Lanes> Mul<F<L>> for V<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: F<L>) -> Self {
        V { x: self.x * b, y: self.y * b, z: self.z * b }
    }
}

impl<L: Lanes> Mul<f32> for V<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: f32) -> Self {
        V { x: self.x * b, y: self.y * b, z: self.z * b }
    }
}

impl<L: Lanes> Neg for V<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        V { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl<L: Lanes> V<L> {
    /// Fills all lanes with a vector.
    #[inline(always)]
    pub fn splat(l: L, a: [f32; 3]) -> Self {
        V { x: l.f(a[0]), y: l.f(a[1]), z: l.f(a[2]) }
    }
    /// a · b.
    #[inline(always)]
    pub fn dot(self, b: Self) -> F<L> {
        self.x * b.x + (self.y * b.y + self.z * b.z)
    }
    /// Dot product with one vector, the same for all lanes.
    #[inline(always)]
    pub fn dot_with(self, b: [f32; 3]) -> F<L> {
        self.x * b[0] + (self.y * b[1] + self.z * b[2])
    }
    /// a × b.
    #[inline(always)]
    pub fn cross(self, b: Self) -> Self {
        V { x: self.y * b.z - self.z * b.y, y: self.z * b.x - self.x * b.z, z: self.x * b.y - self.y * b.x }
    }
    /// |a|².
    #[inline(always)]
    pub fn length_squared(self) -> F<L> {
        self.dot(self)
    }
    /// a/|a|.
    #[inline(always)]
    pub fn normalized(self) -> Self {
        self * (1.0 / self.length_squared().sqrt())
    }
    /// The largest component.
    #[inline(always)]
    pub fn max_component(self) -> F<L> {
        self.x.max(self.y).max(self.z)
    }
    /// The largest absolute component.
    #[inline(always)]
    pub fn max_abs(self) -> F<L> {
        self.x.abs().max(self.y.abs()).max(self.z.abs())
    }
    /// Lane `lane` as plain numbers.
    pub fn lane(self, lane: usize) -> [f32; 3] {
        [self.x.to_array()[lane], self.y.to_array()[lane], self.z.to_array()[lane]]
    }
}

impl<L: Lanes> Pick<V<L>> for M<L> {
    #[inline(always)]
    fn pick(self, a: V<L>, b: V<L>) -> V<L> {
        V { x: self.pick(a.x, b.x), y: self.pick(a.y, b.y), z: self.pick(a.z, b.z) }
    }
}
