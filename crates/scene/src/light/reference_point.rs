//! A point that is lit.
use super::lobe::Lobe;
use noisefall_base::math::{Lanes, M, V};

/// A point for which lights are sampled.
#[derive(Clone, Copy)]
pub struct ReferencePoint<L: Lanes> {
    /// Position in world space, metres.
    pub p: V<L>,
    /// Unit normal on the side of the viewer.
    pub n: V<L>,
    /// Lanes whose surface receives light from both sides.
    pub transmits: M<L>,
    /// The glossy lobe at the point; `None` if surfaces are diffuse or light samples do not depend on lobes.
    pub lobe: Option<Lobe<L>>,
}
