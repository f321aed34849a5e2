//! The albedo of the first surface.
use super::{Field, Quantity, Sources};
use noisefall_base::{declare::Word, math::colour::srgb_from_linear};
use noisefall_kernel::integrator::Features;

pub(super) struct Albedo;

impl Quantity for Albedo {
    const WORD: Word =
        Word { name: "albedo", title: "Albedo", doc: "Colour of the BSDF at the first surface along a camera ray." };

    const SHOWS_FEATURES: bool = true;

    fn vector(features: &Features, index: usize) -> Option<(&'static str, [f32; 3])> {
        Some(("Albedo RGB", *features.albedo.get(index)?))
    }

    fn field(sources: &Sources) -> Field {
        Field::colours_of_features(sources, |features, i| {
            features.albedo[i].map(|c| (srgb_from_linear(f64::from(c.clamp(0.0, 1.0))) * 255.0).round() as u8)
        })
    }
}
