//! The tape in f64.
use super::super::tape::Quantity;
use noisefall_base::math::One;

/// A number in f64.
#[derive(Clone, Copy, Debug)]
pub struct Exact(pub f64);

impl Quantity<One> for Exact {
    fn constant(_: One, value: f32) -> Self {
        Exact(value.into())
    }
    fn add_constant(&self, by: f32) -> Self {
        Exact(self.0 + f64::from(by))
    }
    fn scale(&self, by: f32) -> Self {
        Exact(self.0 * f64::from(by))
    }
    fn add(&self, b: &Self) -> Self {
        Exact(self.0 + b.0)
    }
    fn subtract(&self, b: &Self) -> Self {
        Exact(self.0 - b.0)
    }
    fn multiply(&self, b: &Self) -> Self {
        Exact(self.0 * b.0)
    }
    fn square(&self) -> Self {
        Exact(self.0 * self.0)
    }
    fn reciprocal(&self) -> Self {
        Exact(1.0 / self.0)
    }
    fn square_root(&self) -> Self {
        Exact(self.0.max(0.0).sqrt())
    }
    fn absolute(&self) -> Self {
        Exact(self.0.abs())
    }
    fn minimum(&self, b: &Self) -> Self {
        Exact(self.0.min(b.0))
    }
    fn maximum(&self, b: &Self) -> Self {
        Exact(self.0.max(b.0))
    }
    fn exponential(&self) -> Self {
        Exact(self.0.exp())
    }
    fn logarithm(&self) -> Self {
        Exact(self.0.max(f32::MIN_POSITIVE.into()).ln())
    }
    fn sine(&self) -> Self {
        Exact(self.0.sin())
    }
    fn cosine(&self) -> Self {
        Exact(self.0.cos())
    }
}
