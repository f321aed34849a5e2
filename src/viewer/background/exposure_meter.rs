//! Finds images that lie far outside the range of the display.
use noisefall::math::colour::luminance;

/// Most pixels that are measured: an even choice of so many tells enough.
const MOST_PIXELS: usize = 1 << 14;
/// Luminance that the middle of the lit pixels gets by the suited exposure.
const MIDDLE: f32 = 0.25;
/// Displayed luminances of the middle lit pixel from which an image is too bright. 1 is white.
const TOO_BRIGHT: f32 = 6.0;
/// Displayed luminance that hardly any pixel reaches if an image is too dark: an eightieth of white.
const TOO_DARK: f32 = 0.0125;
/// Least fraction of the pixels that must have light, for an image to be too bright: a lamp alone may be bright.
const LEAST_LIT: f32 = 0.05;
/// Fraction of the lit pixels that an image that is too dark leaves below the limit.
const DARK_PART: f64 = 0.99;
/// Exposures are multiples of this, stops.
const STEP: f32 = 0.5;

/// An exposure that does not suit an image, and one that does, stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    pub at: f32,
    pub suited: f32,
}

/// Whether an image is far too bright or too dark at an exposure. Robust against noise: a few bright samples change nothing.
pub fn misfit(radiance: &[[f32; 3]], exposure: f32) -> Option<Misfit> {
    let stride = radiance.len().div_ceil(MOST_PIXELS).max(1);
    let all: Vec<f32> = radiance.iter().step_by(stride).map(|rgb| luminance(*rgb)).collect();
    let mut lit: Vec<f32> = all.iter().copied().filter(|y| *y > 0.0 && y.is_finite()).collect();
    if lit.is_empty() {
        return None;
    }
    lit.sort_unstable_by(f32::total_cmp);
    let at = |part: f64| lit[((lit.len() - 1) as f64 * part) as usize];
    let scale = exposure.exp2();
    let is_too_bright = at(0.5) * scale > TOO_BRIGHT && lit.len() as f32 >= LEAST_LIT * all.len() as f32;
    let is_too_dark = at(DARK_PART) * scale < TOO_DARK;
    let suited = ((MIDDLE / at(0.5)).log2() / STEP).round() * STEP;
    (is_too_bright || is_too_dark).then_some(Misfit { at: exposure, suited })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image in which this fraction of the pixels has this radiance, and the others another one.
    fn image(part: f32, radiance: f32, others: f32) -> Vec<[f32; 3]> {
        (0..100_000).map(|i| if (i % 100) as f32 * 0.01 < part { [radiance; 3] } else { [others; 3] }).collect()
    }

    #[test]
    fn what_is_far_outside_the_range_is_found_and_brought_to_its_middle() {
        for radiance in [1e-9_f32, 1e-3, 30.0, 3e4] {
            let found = misfit(&image(1.0, radiance, 0.0), 0.0).expect("it is outside");
            let shown = radiance * found.suited.exp2();
            assert!((0.17..0.36).contains(&shown), "{radiance} is shown as {shown}");
            assert_eq!(misfit(&image(1.0, radiance, 0.0), found.suited), None, "it suits");
        }
        assert_eq!(misfit(&image(1.0, 30.0, 0.0), 2.0).map(|found| found.at), Some(2.0));
    }

    #[test]
    fn what_a_display_can_show_is_left_alone() {
        for radiance in [0.02, 0.2, 2.0] {
            assert_eq!(misfit(&image(1.0, radiance, 0.0), 0.0), None, "{radiance}");
        }
        assert_eq!(misfit(&image(0.03, 100.0, 0.0), 0.0), None, "a lamp in the dark");
        assert_eq!(misfit(&image(0.03, 100.0, 0.001), 0.0), None, "a lamp in a dark room");
        assert_eq!(misfit(&image(1.0, 0.0, 0.0), 0.0), None, "black");
        assert_eq!(misfit(&[[f32::NAN; 3], [f32::INFINITY; 3]], 0.0), None);
        assert_eq!(misfit(&[], 0.0), None);
    }

    #[test]
    fn an_object_that_is_too_bright_is_found_before_a_black_background() {
        assert!(misfit(&image(0.3, 50.0, 0.0), 0.0).is_some_and(|found| found.suited == -7.5));
    }
}
