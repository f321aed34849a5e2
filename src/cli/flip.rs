//! FLIP: the difference that an observer perceives when alternating between two images.
//!
//! P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.
use noisefall_render::render::Frame;
#[cfg(feature = "flip")]
use noisefall_render::render::{Display, tone::to_srgb};

/// Memory for both images in a perceptually uniform colour space, each with its filtered copies.
#[cfg(feature = "flip")]
pub const BYTES_OF_PIXEL: u64 = 8 * 12;
#[cfg(not(feature = "flip"))]
pub const BYTES_OF_PIXEL: u64 = 0;

/// Mean FLIP error from 0 to 1 of two images as the screen shows them, at 67 pixels per degree. `None` if built without FLIP.
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
