//! The background: the same radiance from every direction that meets no surface.

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Background {
    /// W·sr⁻¹·m⁻², linear Rec. 709.
    pub radiance: [f32; 3],
}
