//! Random numbers of one scene: a pure function of its family, its number, and the count of numbers drawn before.
use std::f64::consts::PI;

use glam::DVec3;
use rand::RngCore;

use noisefall_base::math::{One, U};
use noisefall_scene::sampling::hash::{GOLDEN, hash, hash_one, unit};

pub struct Dice {
    key: u32,
    drawn: u32,
}

/// For functions that accept any random number generator.
impl RngCore for Dice {
    fn next_u32(&mut self) -> u32 {
        self.drawn += 1;
        hash(U::<One>(self.key.wrapping_add(self.drawn.wrapping_mul(GOLDEN)))).0
    }

    fn next_u64(&mut self) -> u64 {
        u64::from(self.next_u32()) << 32 | u64::from(self.next_u32())
    }

    fn fill_bytes(&mut self, bytes: &mut [u8]) {
        bytes.fill_with(|| self.next_u32() as u8);
    }
}

impl Dice {
    pub fn new(family: &str, number: u32) -> Dice {
        let name = family.bytes().fold(GOLDEN, |key, byte| hash_one(key ^ u32::from(byte)));
        Dice { key: hash_one(name.wrapping_add(number)), drawn: 0 }
    }

    /// A number in (0, 1).
    pub fn unit(&mut self) -> f64 {
        unit(U::<One>(self.next_u32())).0.into()
    }

    pub fn within(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.unit()
    }

    /// A power of ten with a uniform exponent.
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

    /// A uniform direction.
    pub fn direction(&mut self) -> DVec3 {
        let (z, turn) = (self.within(-1.0, 1.0), self.within(0.0, 2.0 * PI));
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * turn.cos(), r * turn.sin(), z)
    }

    /// A uniform point of the unit ball.
    pub fn in_ball(&mut self) -> DVec3 {
        self.direction() * self.unit().cbrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_to_their_ranges_and_fill_them() {
        let mut dice = Dice::new("a family", 3);
        let mut of = |draw: &dyn Fn(&mut Dice) -> f64| -> Vec<f64> { (0..4000).map(|_| draw(&mut dice)).collect() };
        // The mean of 4000 uniform numbers has a standard error of 1/√(12 · 4000) of their range.
        let fills = |values: &[f64], low: f64, high: f64| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let part = (mean - low) / (high - low);
            assert!(
                values.iter().all(|x| (low..=high).contains(x)) && (part - 0.5).abs() < 4.0 / (12.0f64 * 4000.0).sqrt(),
                "{part}"
            );
        };
        fills(&of(&Dice::unit), 0.0, 1.0);
        fills(&of(&|dice| dice.within(-3.0, 5.0)), -3.0, 5.0);
        fills(&of(&|dice| dice.decade(-6.0, 2.0).log10()), -6.0, 2.0);
        fills(&of(&|dice| f64::from(dice.pick(&[0u8, 1, 2, 3, 4]))), 0.0, 4.0);
        fills(&of(&|dice| dice.direction().z), -1.0, 1.0);
        fills(&of(&|dice| dice.direction().x), -1.0, 1.0);
        fills(&of(&|dice| dice.in_ball().length().powi(3)), 0.0, 1.0);
        let share = of(&|dice| f64::from(u8::from(dice.chance(0.3)))).iter().sum::<f64>() / 4000.0;
        assert!((share - 0.3).abs() < 4.0 * (0.21f64 / 4000.0).sqrt(), "{share}");
        assert!(of(&|dice| dice.direction().length()).iter().all(|length| (length - 1.0).abs() < 1e-6));
        assert!((0..5).all(|count| of(&|dice| dice.below(5) as f64).contains(&f64::from(count))));
    }
}
