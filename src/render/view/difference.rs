//! The difference from another image.
use super::{Field, Quantity, Sources, legend::part_below};
use crate::{declare::Word, math::colour::luminance, measure::Floor};

pub(super) struct Difference;

impl Quantity for Difference {
    const WORD: Word = Word {
        name: "difference",
        title: "Difference",
        doc: "Radiance minus that of the pinned image, relative to it. (For A minus B, choose the layout Difference under Compare.)",
    };

    const SHOWS_LIGHT: bool = true;
    const IS_SIGNED: bool = true;
    fn unit() -> &'static str {
        "relative to pinned image or B"
    }

    fn missing() -> &'static str {
        "No image of this size to compare with yet: wait for the first sample of B, or pin an image below Display"
    }

    fn field(sources: &Sources) -> Field {
        difference(sources).map_or(Field::Missing, Field::Numbers)
    }

    fn ends(numbers: &[f32]) -> [f32; 2] {
        around(numbers)
    }
}

/// The relative difference of luminance from the pinned image, with the floor of relMSE for dark pixels.
fn difference(sources: &Sources) -> Option<Vec<f32>> {
    let pinned = sources.pinned?;
    let radiance = sources.radiance.unwrap_or(&sources.frame.radiance);
    let same = pinned.radiance.len() == radiance.len() && pinned.width == sources.frame.width;
    let floor = Floor::DEFAULT.of_picture(&pinned.radiance);
    let relative = |(a, b): (&[f32; 3], &[f32; 3])| {
        let (a, b) = (f64::from(luminance(*a)), f64::from(luminance(*b)));
        // Two black pixels of a black picture do not differ.
        if a == b { 0.0 } else { ((a - b) / (b * b + floor).sqrt()) as f32 }
    };
    same.then(|| radiance.iter().zip(&pinned.radiance).map(relative).collect())
}

/// Powers of ten, from a thousandth to one, around nearly all numbers.
fn around(numbers: &[f32]) -> [f32; 2] {
    let sizes: Vec<f32> = numbers.iter().map(|x| x.abs()).collect();
    let end = 10f32.powf(part_below(&sizes, 0.98).max(1e-3).log10().ceil().min(0.0));
    [-end, end]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_lie_around_nearly_all_numbers() {
        assert_eq!([around(&[-0.05, 0.02]), around(&[5.0, -7.0]), around(&[0.0])], [[-0.1, 0.1], [-1.0, 1.0], [-0.001, 0.001]]);
    }
}
