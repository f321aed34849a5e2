//! Finds images that lie far outside the range of the display.
use noisefall_base::math::colour::luminance;

/// The image is measured by the means of SIDE × SIDE blocks: noise averages out within them.
const SIDE: usize = 6;
/// Luminance that the middle block with light gets by the suited exposure.
const MIDDLE: f64 = 0.25;
/// Displayed luminance of the middle block from which an image is too bright. 1 is white.
const TOO_BRIGHT: f64 = 6.0;
/// Displayed luminance that no block reaches if an image is too dark: an eightieth of white.
const TOO_DARK: f64 = 0.0125;
/// Least fraction of the pixels that must have light, for an image to be too bright: a light alone may be bright.
const LEAST_LIT: f64 = 0.05;
/// Exposures are multiples of this, stops.
const STEP: f64 = 0.5;

/// An exposure that does not suit an image, and one that does, stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    pub at: f32,
    pub suited: f32,
}

/// Whether an image of this width is far too bright or too dark at an exposure.
pub fn misfit(radiance: &[[f32; 3]], width: usize, exposure: f32) -> Option<Misfit> {
    let (mut blocks, lit) = blocks(radiance, width);
    blocks.retain(|mean| *mean > 0.0);
    blocks.sort_unstable_by(f64::total_cmp);
    let (middle, brightest) = (*blocks.get(blocks.len() / 2)?, *blocks.last()?);
    let scale = f64::from(exposure).exp2();
    let is_too_bright = middle * scale > TOO_BRIGHT && lit >= LEAST_LIT;
    let suited = ((MIDDLE / middle).log2() / STEP).round() * STEP;
    (is_too_bright || brightest * scale < TOO_DARK).then_some(Misfit { at: exposure, suited: suited as f32 })
}

/// The mean luminances of the blocks, and the fraction of the pixels that have light.
fn blocks(radiance: &[[f32; 3]], width: usize) -> (Vec<f64>, f64) {
    let height = radiance.len().checked_div(width).unwrap_or(0);
    let (mut sums, mut lit) = ([(0.0, 0u32); SIDE * SIDE], 0u32);
    for (place, rgb) in radiance.iter().enumerate().take(width * height) {
        let (sum, count) = &mut sums[(place / width) * SIDE / height * SIDE + (place % width) * SIDE / width];
        let y = f64::from(luminance(*rgb));
        if y.is_finite() {
            (*sum, *count) = (*sum + y, *count + 1);
            lit += u32::from(y > 0.0);
        }
    }
    let means = sums.iter().filter(|(_, count)| *count > 0).map(|(sum, count)| sum / f64::from(*count));
    (means.collect(), f64::from(lit) / radiance.len().max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image in which every so many pixels have a radiance, and the others another one.
    fn speckled(every: usize, radiance: f32, others: f32) -> Vec<[f32; 3]> {
        (0..120 * 90).map(|i| if i % every == 0 { [radiance; 3] } else { [others; 3] }).collect()
    }

    /// An image whose left part has a radiance, and the rest is black.
    fn object(columns: usize, radiance: f32) -> Vec<[f32; 3]> {
        (0..120 * 90).map(|i| if i % 120 < columns { [radiance; 3] } else { [0.0; 3] }).collect()
    }

    fn found(image: &[[f32; 3]], exposure: f32) -> Option<Misfit> {
        misfit(image, 120, exposure)
    }

    #[test]
    fn radiance_far_outside_the_range_is_found_and_brought_to_its_middle() {
        for radiance in [1e-9_f32, 1e-3, 30.0, 3e4] {
            let image = object(120, radiance);
            let misfit = found(&image, 0.0).expect("it is outside");
            let shown = radiance * misfit.suited.exp2();
            assert!((0.2..0.31).contains(&shown), "{radiance} is shown as {shown}");
            assert_eq!(found(&image, misfit.suited), None, "it suits");
        }
        assert_eq!(found(&object(120, 30.0), 2.0).map(|misfit| misfit.at), Some(2.0));
        assert!(found(&object(40, 50.0), 0.0).is_some_and(|misfit| misfit.suited == -7.5), "before a black background");
    }

    #[test]
    fn radiance_that_a_display_can_show_is_left_alone() {
        for radiance in [0.02, 0.2, 2.0] {
            assert_eq!(found(&object(120, radiance), 0.0), None, "{radiance}");
        }
        assert_eq!(found(&object(4, 100.0), 0.0), None, "a light in the dark");
        assert_eq!(found(&speckled(13, 10.0, 0.0), 0.0), None, "noise with a mean that can be shown");
        for nothing in [vec![[0.0; 3]; 240], vec![[f32::NAN; 3]; 240], vec![[f32::INFINITY; 3]; 240], Vec::new()] {
            assert_eq!(found(&nothing, 0.0), None);
        }
        assert_eq!(misfit(&[], 0, 0.0), None);
    }
}
