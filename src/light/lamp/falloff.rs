//! The falloff of spots from their inner to their outer angle.
use crate::declare::words;

/// How the intensity of a spot falls to 0 between its inner angle and its edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Falloff {
    /// Smoothstep of the cosine, as pbrt does.
    Smooth,
    /// Linear in the angle, as Mitsuba does.
    Linear,
    /// The square of the cosine's fraction, as glTF does.
    Square,
}

words! {
    Falloff {
        Smooth: "smooth", "Smooth", "Smoothstep of the cosine of the angle.";
        Linear: "linear", "Linear", "Linear in the angle.";
        Square: "square", "Square", "Square of a ramp that is linear in the cosine of the angle.";
    }
}
