//! The standard error of each pixel.
use super::{Field, Quantity, Sources, legend::part_below};
use noisefall_base::declare::Word;

pub(super) struct StandardError;

impl Quantity for StandardError {
    const WORD: Word = Word {
        name: "standard-error",
        title: "Standard error",
        doc: "Standard error of each pixel's luminance from the variance of its samples: an upper bound for stratified and Sobol samples.",
    };

    fn unit() -> &'static str {
        "W·sr⁻¹·m⁻²"
    }

    const IS_LOG: bool = true;

    fn field(sources: &Sources) -> Field {
        Field::Numbers(sources.frame.standard_error.clone())
    }

    fn ends(numbers: &[f32]) -> [f32; 2] {
        decades(numbers)
    }
}

/// Powers of ten around all but the outermost of the positive numbers, at least two decades.
fn decades(numbers: &[f32]) -> [f32; 2] {
    let positive: Vec<f32> = numbers.iter().copied().filter(|x| *x > 0.0).collect();
    if positive.is_empty() {
        return [0.01, 1.0];
    }
    let high = part_below(&positive, 0.99).log10().ceil();
    let low = part_below(&positive, 0.02).log10().floor().min(high - 2.0).max(high - 6.0);
    [10f32.powf(low), 10f32.powf(high)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_hold_nearly_all_positive_numbers() {
        assert_eq!(decades(&[0.0, f32::NAN]), [0.01, 1.0]);
        assert_eq!(decades(&[0.02, 0.5, 30.0, 0.3]), [0.01, 1.0]);
    }
}
