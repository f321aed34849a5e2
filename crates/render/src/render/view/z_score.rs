//! The deviation from the reference in standard errors.
use super::{Field, Quantity, Sources};
use crate::render::{frame::Frame, reference::Reference};
use noisefall_base::{declare::Word, math::colour::luminance};

pub(super) struct ZScore;

impl Quantity for ZScore {
    const WORD: Word = Word {
        name: "z-score",
        title: "Z-score",
        doc: "(estimate - reference)/standard error. Unbiased images show noise without structure; independent samples follow the unit normal distribution unless light is rare.",
    };

    const HAS_SCORES: bool = true;
    const IS_SIGNED: bool = true;
    fn unit() -> &'static str {
        "σ"
    }

    fn missing() -> &'static str {
        "No reference: render or open one of this size (panel Display). That of a scene is for its own camera (Home)."
    }

    fn field(sources: &Sources) -> Field {
        sources.reference.and_then(|reference| scores(sources.frame, reference)).map_or(Field::Missing, Field::Numbers)
    }

    fn ends(_: &[f32]) -> [f32; 2] {
        [-4.0, 4.0]
    }
}

/// The luminance minus the exact one, in standard errors; NaN before the second sample, 0 if there is neither difference nor
/// variance.
pub(super) fn scores(frame: &Frame, reference: &Reference) -> Option<Vec<f32>> {
    let score = |((radiance, reference), error): ((&[f32; 3], &[f32; 3]), &f32)| {
        let difference = luminance(*radiance) - luminance(*reference);
        if difference == 0.0 && *error == 0.0 { 0.0 } else { difference / error }
    };
    let reference = reference.radiance_of(frame)?;
    Some(frame.radiance.iter().zip(reference.iter()).zip(&frame.standard_error).map(score).collect())
}
