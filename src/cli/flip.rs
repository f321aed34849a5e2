//! The FLIP error of two pictures: how large an observer finds their difference who looks at one after the other.
//!
//! P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
use noisefall::render::Frame;
#[cfg(feature = "flip")]
use noisefall::render::{Display, tone::to_srgb};

/// What finding the error takes: two pictures in colours that are as far apart as they look, each with what filters make of it.
#[cfg(feature = "flip")]
pub const BYTES_OF_PIXEL: u64 = 8 * 12;
#[cfg(not(feature = "flip"))]
pub const BYTES_OF_PIXEL: u64 = 0;

/// The mean error from 0 to 1 at 67 pixels a degree, of the pictures as the screen shows them; `None` in a program built without FLIP.
#[cfg(feature = "flip")]
pub fn mean_error(picture: &Frame, reference: &Frame) -> Option<f64> {
    let shown = |frame: &Frame| {
        let mut pixels = Vec::new();
        to_srgb(&frame.radiance, Display::default(), &mut pixels);
        let rgb: Vec<u8> = pixels.into_iter().flat_map(|[r, g, b, _]| [r, g, b]).collect();
        nv_flip::FlipImageRgb8::with_data(frame.width, frame.height, &rgb)
    };
    let errors = nv_flip::flip(shown(reference), shown(picture), nv_flip::DEFAULT_PIXELS_PER_DEGREE);
    Some(f64::from(nv_flip::FlipPool::from_image(&errors).mean()))
}

#[cfg(not(feature = "flip"))]
pub fn mean_error(_: &Frame, _: &Frame) -> Option<f64> {
    None
}
