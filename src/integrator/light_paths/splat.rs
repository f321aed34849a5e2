//! Light that arrives in any pixel.

/// Light that a path from a light brings to the image. The mean over all paths of its filtered sums is the image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splat {
    /// Where it arrives, in pixels from the upper left corner; maybe outside of the image.
    pub place: [f32; 2],
    /// Two random numbers, which choose among the pixels whose filter reaches the place.
    pub u: [f32; 2],
    /// Linear Rec. 709.
    pub light: [f32; 3],
}
