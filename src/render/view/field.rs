//! The values of a view, pixel by pixel.
use super::{Sources, View};
use crate::{
    integrator::Features,
    math::colour::{luminance, srgb_from_linear},
    measure::Floor,
    render::{colour_map::ColourMap, frame::Frame, truth::Reference},
};

/// The values of a view before they become colours, row by row from the top left.
pub enum Field {
    /// The data of the view is missing.
    Missing,
    /// Numbers for a scale; NaN is grey.
    Numbers(Vec<f32>),
    /// 8-bit sRGB.
    Colours(Vec<[u8; 3]>),
}

/// Distinct with any colour vision (M. Okabe and K. Ito, "Color Universal Design", 2008), then once more, lighter.
const CATEGORIES: [[u8; 3]; 8] =
    [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [213, 94, 0], [240, 228, 66], [150, 150, 150]];

/// The colour of a material by its number.
pub(super) fn category(id: u32) -> [u8; 3] {
    let colour = CATEGORIES[id as usize % CATEGORIES.len()];
    let rounds = (id as usize / CATEGORIES.len()) % 3;
    colour.map(|c| c - (u32::from(c) * rounds as u32 / 4) as u8)
}

impl Field {
    pub(super) fn of(view: View, sources: &Sources) -> Field {
        let Sources { frame, .. } = sources;
        match view {
            View::Radiance => Field::Missing,
            View::StandardError => Field::Numbers(frame.standard_error.clone()),
            View::SampleCount => Field::Numbers((0..frame.radiance.len()).map(|i| frame.spp_at(i) as f32).collect()),
            View::ZScore => sources.truth.and_then(|truth| scores(frame, truth)).map_or(Field::Missing, Field::Numbers),
            View::Difference => difference(sources).map_or(Field::Missing, Field::Numbers),
            _ => sources.features.map_or(Field::Missing, |features| Field::of_features(view, frame, features)),
        }
    }

    /// The features for a view; a coarse frame shows every n-th pixel.
    fn of_features(view: View, frame: &Frame, features: &Features) -> Field {
        let [width, height] = [frame.width, frame.height];
        let scaled = |at: u32, from: u32, to: u32| (u64::from(at) * u64::from(to) / u64::from(from.max(1))) as usize;
        let index =
            |x: u32, y: u32| scaled(y, height, features.height) * features.width as usize + scaled(x, width, features.width);
        let places: Vec<usize> = (0..height).flat_map(|y| (0..width).map(move |x| index(x, y))).collect();
        let numbers = |values: &[f32]| Field::Numbers(places.iter().map(|i| values[*i]).collect());
        let colours = |colour: &dyn Fn(usize) -> [u8; 3]| Field::Colours(places.iter().map(|i| colour(*i)).collect());
        match view {
            View::Normals => colours(&|i| features.normal[i].map(|c| ((c * 0.5 + 0.5) * 255.0).round() as u8)),
            View::Albedo => {
                colours(&|i| features.albedo[i].map(|c| (srgb_from_linear(f64::from(c.clamp(0.0, 1.0))) * 255.0).round() as u8))
            }
            View::Materials => colours(&|i| match features.material[i] {
                u32::MAX => [24; 3],
                id => category(id),
            }),
            View::HitCost => numbers(&features.cost),
            _ => Field::Numbers(
                places.iter().map(|i| Some(features.depth[*i]).filter(|t| t.is_finite()).unwrap_or(f32::NAN)).collect(),
            ),
        }
    }
}

/// The luminance minus the exact one, in standard errors; NaN before the second sample, 0 if there is neither difference nor
/// variance.
pub fn scores(frame: &Frame, truth: &Reference) -> Option<Vec<f32>> {
    let score = |((radiance, truth), error): ((&[f32; 3], &[f32; 3]), &f32)| {
        let difference = luminance(*radiance) - luminance(*truth);
        if difference == 0.0 && *error == 0.0 { 0.0 } else { difference / error }
    };
    let truth = truth.radiance_of(frame)?;
    Some(frame.radiance.iter().zip(truth.iter()).zip(&frame.standard_error).map(score).collect())
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

/// The colour map of a view: `chosen` for unsigned numbers; signed ones have their own map.
pub(super) fn map_of(view: View, chosen: ColourMap) -> ColourMap {
    if matches!(view, View::ZScore | View::Difference) { ColourMap::Diverging } else { chosen }
}
