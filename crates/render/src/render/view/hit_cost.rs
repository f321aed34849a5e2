//! The time that the first ray takes.
use super::{
    Field, Quantity, Sources,
    legend::{part_below, round_up},
};
use noisefall_base::declare::Word;

pub(super) struct HitCost;

impl Quantity for HitCost {
    const WORD: Word = Word {
        name: "hit-cost",
        title: "Hit cost",
        doc: "Measured time to find the first surface along a camera ray, in nanoseconds.",
    };

    const SHOWS_FEATURES: bool = true;
    fn unit() -> &'static str {
        "ns per ray"
    }

    fn field(sources: &Sources) -> Field {
        Field::numbers_of_features(sources, |features, i| features.cost[i])
    }

    fn ends(numbers: &[f32]) -> [f32; 2] {
        [0.0, round_up(part_below(numbers, 0.99))]
    }
}
