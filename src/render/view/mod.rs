//! Views besides radiance: noise, sample counts, z-scores, differences, and features of first hits.
mod field;
mod legend;
mod z_scores;

use serde::Serialize;

pub use self::{
    field::Field,
    legend::{Legend, Scale},
    z_scores::ZScoreHistogram,
};
use super::{colour_map::ColourMap, frame::Frame, tone::Display, tone::to_srgb, truth::Reference};
use crate::integrator::Features;

/// A quantity to display.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize)]
pub enum View {
    /// The image itself.
    #[default]
    Radiance,
    /// The standard error of each pixel.
    StandardError,
    /// The number of samples of each pixel.
    SampleCount,
    /// The deviation from the truth in standard errors.
    ZScore,
    /// The difference from another image.
    Difference,
    /// The normal of the first surface.
    Normals,
    /// The albedo of the first surface.
    Albedo,
    /// The distance of the first surface.
    Depth,
    /// The time that the first ray takes.
    HitCost,
    /// The material of the first surface.
    Materials,
}

impl View {
    /// The catalogue: view, name, and one sentence for the window.
    pub const ALL: [(View, &'static str, &'static str); 10] = [
        (View::Radiance, "Radiance", "The picture itself: L_o of the equation at every pixel, through exposure and tone map."),
        (
            View::StandardError,
            "Standard error",
            "How far the luminance of each pixel's mean is likely to be off at most, from the variances of its samples.",
        ),
        (View::SampleCount, "Sample count", "How many samples N each pixel has: more where they are adaptive, or in a region."),
        (
            View::ZScore,
            "Z-score",
            "(estimate - truth)/standard error: noise without structure if right, as wide as the unit normal where samples are independent and light is not rare.",
        ),
        (
            View::Difference,
            "Difference",
            "Radiance less that of the pinned picture, in parts of it. (A less B: the layout Difference, under Compare.)",
        ),
        (View::Normals, "Normals", "The shading normal n that a camera ray meets first: red is x, green y, blue z."),
        (View::Albedo, "Albedo", "The colour that the bsdf f has where a camera ray meets it first."),
        (View::Depth, "Depth", "The distance to x_M, the first surface along a camera ray, in metres."),
        (View::HitCost, "Hit cost", "How long it takes to find that first surface, in nanoseconds a ray, as measured."),
        (View::Materials, "Materials", "Which material a camera ray meets first."),
    ];

    /// The title in the window.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(view, _, _)| *view == self).map_or("", |(_, name, _)| name)
    }

    /// Whether it shows features of first hits, and not samples.
    pub fn shows_features(self) -> bool {
        matches!(self, View::Normals | View::Albedo | View::Depth | View::HitCost | View::Materials)
    }
}

/// The data of views. Missing data is shown as grey.
#[derive(Clone, Copy)]
pub struct Sources<'a> {
    /// The frame to show.
    pub frame: &'a Frame,
    /// Radiance to show in place of the frame's own, of the same length: a term of its series.
    pub radiance: Option<&'a [[f32; 3]]>,
    /// The truth to compare with.
    pub truth: Option<&'a Reference>,
    /// The pinned image of the difference.
    pub pinned: Option<&'a Frame>,
    /// The first surfaces of all pixels.
    pub features: Option<&'a Features>,
    /// The scale of another image beside this one, in place of its own.
    pub scale: Option<Scale>,
    /// Names by number, for the legend.
    pub materials: &'a [String],
}

/// Display settings of views.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct DisplaySettings {
    pub view: View,
    /// Colours of numbers.
    pub map: ColourMap,
    /// Exposure and tone map of radiance.
    pub display: Display,
}

/// Draws a view as 8-bit sRGB, row by row from the top left, and replaces the contents of `pixels`. Returns its legend and
/// values, except for radiance.
pub fn draw(settings: DisplaySettings, sources: &Sources, pixels: &mut Vec<[u8; 4]>) -> Option<(Legend, Field)> {
    if settings.view == View::Radiance {
        to_srgb(sources.radiance.unwrap_or(&sources.frame.radiance), settings.display, pixels);
        return None;
    }
    let field = Field::of(settings.view, sources);
    let legend = Legend::of(settings, sources, &field);
    pixels.clear();
    match &field {
        Field::Missing => pixels.resize(sources.frame.radiance.len(), [96, 96, 96, 255]),
        Field::Colours(colours) => pixels.extend(colours.iter().map(|[r, g, b]| [*r, *g, *b, 255])),
        Field::Numbers(numbers) => {
            let table = legend.scale.as_ref().map_or(settings.map, |scale| scale.map).table();
            let place = |x: f32| legend.scale.as_ref().map_or(0.0, |scale| scale.place(x));
            let colour = |x: &f32| if x.is_nan() { [96, 96, 96, 255] } else { table[(place(*x) * 255.0).round() as usize] };
            pixels.extend(numbers.iter().map(colour));
        }
    }
    Some((legend, field))
}
