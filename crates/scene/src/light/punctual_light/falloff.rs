//! The falloff of spots from their inner to their outer angle.
use noisefall_base::declare::words;

words! {
    /// How the intensity of a spot falls to 0 between its inner angle and its edge.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Falloff {
        /// As pbrt does.
        Smooth: "smooth", "Smooth", "Smoothstep of the cosine of the angle.";
        /// As Mitsuba does.
        Linear: "linear", "Linear", "Linear in the angle.";
        /// As glTF does.
        Square: "square", "Square", "Square of a ramp that is linear in the cosine of the angle.";
    }
}
