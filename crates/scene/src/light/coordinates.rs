//! The random numbers of a light sample.
use noisefall_base::math::{F, Lanes};

/// The random numbers of a light sample.
pub struct LightCoordinates<L: Lanes> {
    /// Selects the light; read if there are several.
    pub choice: F<L>,
    /// Selects the cell of an environment image; read if there is one.
    pub cell: (F<L>, F<L>),
    /// Selects the point on the light.
    pub place: (F<L>, F<L>),
    /// Selects the direction to an environment [that is sampled like a diffuse surface](crate::light::Environment::is_even).
    pub sky: (F<L>, F<L>),
}
