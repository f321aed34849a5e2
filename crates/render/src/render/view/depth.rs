//! The distance of the first surface.
use super::{Field, Quantity, Sources};
use noisefall_base::declare::Word;

pub(super) struct Depth;

impl Quantity for Depth {
    const WORD: Word =
        Word { name: "depth", title: "Depth", doc: "The distance to x_M, the first surface along a camera ray, in metres." };

    const SHOWS_FEATURES: bool = true;
    fn unit() -> &'static str {
        "m"
    }

    fn field(sources: &Sources) -> Field {
        Field::numbers_of_features(sources, |features, i| Some(features.depth[i]).filter(|t| t.is_finite()).unwrap_or(f32::NAN))
    }
}
