//! The normal of the first surface.
use super::{Field, Quantity, Sources};
use noisefall_base::declare::Word;
use noisefall_kernel::integrator::Features;

pub(super) struct Normals;

impl Quantity for Normals {
    const WORD: Word = Word {
        name: "normals",
        title: "Normals",
        doc: "Shading normal n of the first surface along a camera ray: red is x, green y, blue z.",
    };

    const SHOWS_FEATURES: bool = true;

    fn vector(features: &Features, index: usize) -> Option<(&'static str, [f32; 3])> {
        Some(("n", *features.normal.get(index)?))
    }

    fn field(sources: &Sources) -> Field {
        Field::colours_of_features(sources, |features, i| features.normal[i].map(|c| ((c * 0.5 + 0.5) * 255.0).round() as u8))
    }
}
