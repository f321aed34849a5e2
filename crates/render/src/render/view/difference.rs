//! The difference from another image.
use std::borrow::Cow;

use super::{
    Field, Quantity, Sources,
    legend::{part_below, round_up},
};
use noisefall_base::{declare::Word, math::colour::luminance};
use noisefall_kernel::measure::Floor;

pub(super) struct Difference;

impl Quantity for Difference {
    const WORD: Word = Word {
        name: "difference",
        title: "Difference",
        doc: "Radiance minus that of the pinned image, or of the reference if none is pinned, relative to it. (For A minus B, choose \
              the layout Difference under Compare.)",
    };

    const SHOWS_LIGHT: bool = true;
    const IS_SIGNED: bool = true;

    fn title(sources: &Sources) -> &'static str {
        match sources.pinned {
            _ if sources.is_comparison => "Difference A − B",
            None if sources.reference.is_some() => "Difference image − reference",
            _ => "Difference image − pinned image",
        }
    }

    fn unit_of(sources: &Sources) -> &'static str {
        match sources.pinned {
            _ if sources.is_comparison => "relative to B",
            None if sources.reference.is_some() => "relative to the reference",
            _ => "relative to the pinned image",
        }
    }

    fn missing() -> &'static str {
        "No image of this size to compare with yet: wait for the first sample of B, pin an image below Display, or open a reference"
    }

    fn field(sources: &Sources) -> Field {
        difference(sources).map_or(Field::Missing, Field::Numbers)
    }

    fn ends(numbers: &[f32]) -> [f32; 2] {
        around(numbers)
    }
}

/// The relative difference of luminance from the pinned image, else from the reference, with the floor of relMSE for dark pixels.
fn difference(sources: &Sources) -> Option<Vec<f32>> {
    let frame = sources.frame;
    let other: Cow<[[f32; 3]]> = match sources.pinned {
        Some(pinned) => (pinned.width == frame.width).then(|| pinned.radiance.as_slice().into())?,
        None => sources.reference?.radiance_of(frame)?,
    };
    let radiance = sources.radiance.unwrap_or(&frame.radiance);
    let floor = Floor::DEFAULT.of_picture(&other);
    let relative = |(a, b): (&[f32; 3], &[f32; 3])| {
        let (a, b) = (f64::from(luminance(*a)), f64::from(luminance(*b)));
        // Two black pixels of a black image do not differ.
        if a == b { 0.0 } else { ((a - b) / (b * b + floor).sqrt()) as f32 }
    };
    (other.len() == radiance.len()).then(|| radiance.iter().zip(other.iter()).map(relative).collect())
}

/// Round numbers around nearly all numbers, at least a thousandth.
fn around(numbers: &[f32]) -> [f32; 2] {
    let sizes: Vec<f32> = numbers.iter().map(|x| x.abs()).collect();
    let end = round_up(part_below(&sizes, 0.98).max(1e-3));
    [-end, end]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_lie_around_nearly_all_numbers() {
        let many = |x: f32| vec![x; 100];
        let is = |ends: [f32; 2], end: f32| (ends[1] / end - 1.0).abs() < 1e-5 && ends[0] == -ends[1];
        assert!(is(around(&[many(-0.04), many(0.02), vec![90.0]].concat()), 0.05));
        assert!(is(around(&many(-7.0)), 10.0) && is(around(&[0.0]), 0.001));
    }
}
