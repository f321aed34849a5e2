//! The values of a view, pixel by pixel.
use super::Sources;
use noisefall_kernel::integrator::Features;

/// The values of a view before they become colours, row by row from the top left.
pub enum Field {
    /// The data of the view is missing.
    Missing,
    /// Numbers for a scale; NaN is grey.
    Numbers(Vec<f32>),
    /// 8-bit sRGB.
    Colours(Vec<[u8; 3]>),
}

impl Field {
    /// A number for each pixel, from the features and the place of the pixel in them.
    pub(super) fn numbers_of_features(sources: &Sources, number: impl Fn(&Features, usize) -> f32) -> Field {
        of_features(sources, number).map_or(Field::Missing, Field::Numbers)
    }

    /// A colour for each pixel, from the features and the place of the pixel in them.
    pub(super) fn colours_of_features(sources: &Sources, colour: impl Fn(&Features, usize) -> [u8; 3]) -> Field {
        of_features(sources, colour).map_or(Field::Missing, Field::Colours)
    }
}

/// A coarse frame shows every n-th pixel of the features.
fn of_features<T>(sources: &Sources, value: impl Fn(&Features, usize) -> T) -> Option<Vec<T>> {
    let features = sources.features?;
    let [width, height] = [sources.frame.width, sources.frame.height];
    let scaled = |at: u32, from: u32, to: u32| (u64::from(at) * u64::from(to) / u64::from(from.max(1))) as usize;
    let place = |x: u32, y: u32| scaled(y, height, features.height) * features.width as usize + scaled(x, width, features.width);
    let value = &value;
    Some((0..height).flat_map(|y| (0..width).map(move |x| value(features, place(x, y)))).collect())
}
