//! Random numbers of one scene: a pure function of its family, its number, and how many were drawn before.
use std::f64::consts::PI;

use glam::DVec3;

use crate::{
    math::{One, U},
    sampling::hash::{GOLDEN, hash, hash_one, unit},
};

pub struct Dice {
    key: u32,
    drawn: u32,
}

impl Dice {
    pub fn new(family: &str, number: u32) -> Dice {
        let name = family.bytes().fold(GOLDEN, |key, byte| hash_one(key ^ u32::from(byte)));
        Dice { key: hash_one(name.wrapping_add(number)), drawn: 0 }
    }

    /// In (0, 1).
    pub fn unit(&mut self) -> f64 {
        self.drawn += 1;
        unit(hash(U::<One>(self.key.wrapping_add(self.drawn.wrapping_mul(GOLDEN))))).0.into()
    }

    pub fn within(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.unit()
    }

    /// A power of ten, its exponent uniform.
    pub fn decade(&mut self, least: f64, most: f64) -> f64 {
        10f64.powf(self.within(least, most))
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    pub fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }

    /// Uniform over the unit sphere.
    pub fn direction(&mut self) -> DVec3 {
        let (z, turn) = (self.within(-1.0, 1.0), self.within(0.0, 2.0 * PI));
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * turn.cos(), r * turn.sin(), z)
    }

    /// Uniform over the unit ball.
    pub fn in_ball(&mut self) -> DVec3 {
        self.direction() * self.unit().cbrt()
    }
}
