//! The first surfaces that rays hit.
use noisefall_base::math::{F, Lanes, U};

/// The nearest hits of rays.
pub struct Nearest<L: Lanes> {
    /// Distance along the ray, in units of its direction; infinite on a miss.
    pub t: F<L>,
    /// Primitive id, or [`super::MISS`].
    pub primitive: U<L>,
    /// The triangle of a mesh.
    pub element: U<L>,
}
