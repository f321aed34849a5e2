//! Functions that smooth, rough and layered interfaces between transparent media share.
use noisefall_base::math::{F, Lanes, M, Pick};

/// Interfaces whose indices differ by less are treated as smooth. Even at the roughest facet they refract light by a smaller
/// angle than this, too small for a half vector in f32, and the facets would be visible only through their masking, which is an
/// artefact there.
pub const FAINT: f32 = 1e-3;

/// The squared ratio of the index that a path is in to the one outside the surface that it leaves, by which radiance grows
/// outside. `eta` is the index beyond the surface relative to that on the viewer's side.
#[inline(always)]
pub fn uncompressed<L: Lanes>(eta: F<L>, front: M<L>, z: F<L>) -> F<L> {
    let inside = front ^ z.above(0.0);
    let ratio = front.pick(eta, 1.0 / eta);
    inside.pick(ratio * ratio, z.splat(1.0))
}
