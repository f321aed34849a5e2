//! The number of samples of each pixel.
use super::{Field, Quantity, Sources};
use noisefall_base::declare::Word;

pub(super) struct SampleCount;

impl Quantity for SampleCount {
    const WORD: Word = Word {
        name: "sample-count",
        title: "Sample count",
        doc: "Number of samples N of each pixel. Adaptive sampling and regions make it vary.",
    };

    fn unit() -> &'static str {
        "samples"
    }

    fn field(sources: &Sources) -> Field {
        let frame = sources.frame;
        Field::Numbers((0..frame.radiance.len()).map(|i| frame.spp_at(i) as f32).collect())
    }

    fn ends(numbers: &[f32]) -> [f32; 2] {
        [0.0, numbers.iter().copied().fold(1.0, f32::max)]
    }
}
