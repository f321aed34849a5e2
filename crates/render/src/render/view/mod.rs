//! Views: radiance, noise, sample counts, z-scores, differences, and features of first hits.
//!
//! A view is one file and one line of the catalogue below.
mod albedo;
mod denoised;
mod depth;
mod difference;
mod field;
mod hit_cost;
mod legend;
mod materials;
mod normals;
mod radiance;
mod sample_count;
mod standard_error;
mod z_score;
mod z_scores;

use serde::Serialize;

use self::legend::{part_below, round_up};
pub use self::{
    field::Field,
    legend::{Legend, Scale},
    z_scores::ZScoreHistogram,
};
use super::{colour_map::ColourMap, frame::Frame, reference::Reference, tone::Display};
use noisefall_base::declare::Word;
use noisefall_kernel::integrator::Features;

noisefall_base::declare::word_kinds! {
    /// A quantity to display.
    #[derive(Serialize)]
    pub enum View: Quantity, default Radiance {
        radiance::Radiance,
        standard_error::StandardError,
        sample_count::SampleCount,
        z_score::ZScore,
        difference::Difference,
        normals::Normals,
        albedo::Albedo,
        depth::Depth,
        hit_cost::HitCost,
        materials::Materials,
        denoised::Denoised,
    }
    in_view
}

impl View {
    /// Whether it shows features of first hits, and not samples.
    pub fn shows_features(self) -> bool {
        in_view!(self, V => V::SHOWS_FEATURES)
    }

    /// Whether it shows radiance, and so terms of its series too.
    pub fn shows_light(self) -> bool {
        in_view!(self, V => V::SHOWS_LIGHT)
    }

    /// Whether it shows the denoised image.
    pub fn is_denoised(self) -> bool {
        in_view!(self, V => V::IS_DENOISED)
    }

    /// The vector that it shows of the first surface of a pixel, and its name; `None` if it shows none.
    pub fn vector(self, features: &Features, index: usize) -> Option<(&'static str, [f32; 3])> {
        in_view!(self, V => V::vector(features, index))
    }

    /// Whether their histogram belongs to it.
    pub fn has_scores(self) -> bool {
        in_view!(self, V => V::HAS_SCORES)
    }
}

/// A kind of view.
trait Quantity {
    const WORD: Word;

    /// Whether it shows features of first hits, and not samples.
    const SHOWS_FEATURES: bool = false;

    /// Whether it shows radiance, and so terms of its series too.
    const SHOWS_LIGHT: bool = false;

    /// Whether it shows the denoised image, which stands in place of the radiance.
    const IS_DENOISED: bool = false;

    /// Whether the histogram of z-scores belongs to it.
    const HAS_SCORES: bool = false;

    /// Whether numbers have a sign: their colours run from one hue to another then.
    const IS_SIGNED: bool = false;

    /// Whether the scale is logarithmic.
    const IS_LOG: bool = false;

    /// Unit of the numbers.
    fn unit() -> &'static str {
        ""
    }

    /// The quantity, for the legend.
    fn title(_sources: &Sources) -> &'static str {
        Self::WORD.title
    }

    /// Unit of the numbers of these sources.
    fn unit_of(_sources: &Sources) -> &'static str {
        Self::unit()
    }

    /// Advice where its data is missing.
    fn missing() -> &'static str {
        "Rendering view…"
    }

    /// See [`View::vector`].
    fn vector(_features: &Features, _index: usize) -> Option<(&'static str, [f32; 3])> {
        None
    }

    /// The values, pixel by pixel.
    fn field(sources: &Sources) -> Field;

    /// The ends of the scale for these numbers.
    fn ends(numbers: &[f32]) -> [f32; 2] {
        [0.0, round_up(part_below(numbers, 1.0))]
    }

    /// Colours by name, for the legend.
    fn entries(_sources: &Sources) -> Vec<([u8; 3], String)> {
        Vec::new()
    }

    /// See [`draw`].
    fn draw(settings: DisplaySettings, sources: &Sources, pixels: &mut Vec<[u8; 4]>) -> Option<(Legend, Field)> {
        let field = Self::field(sources);
        let is_missing = matches!(field, Field::Missing);
        let title = if is_missing { Self::missing() } else { Self::title(sources) };
        let scale = match &field {
            Field::Numbers(numbers) => sources.scale.or_else(|| {
                let map = if Self::IS_SIGNED { ColourMap::Diverging } else { settings.map };
                Some(Scale { map, ends: Self::ends(numbers), log: Self::IS_LOG, unit: Self::unit_of(sources) })
            }),
            _ => None,
        };
        let legend = Legend { title: title.to_owned(), scale, entries: Self::entries(sources) };
        paint(&field, &legend, settings, sources, pixels);
        Some((legend, field))
    }
}

/// The data of views. Missing data is shown as grey.
#[derive(Clone, Copy)]
pub struct Sources<'a> {
    /// The frame to show.
    pub frame: &'a Frame,
    /// Radiance to show in place of the frame's own, of the same length: a term of its series, or the denoised image.
    pub radiance: Option<&'a [[f32; 3]]>,
    /// The truth to compare with.
    pub reference: Option<&'a Reference>,
    /// The image that the difference subtracts.
    pub pinned: Option<&'a Frame>,
    /// Whether the difference is that of the two sides of a comparison.
    pub is_comparison: bool,
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
    /// The quantity to display.
    pub view: View,
    /// Colours of numbers.
    pub map: ColourMap,
    /// Exposure and tone map of radiance.
    pub display: Display,
}

/// Draws a view as 8-bit sRGB, row by row from the top left, and replaces the contents of `pixels`. Returns its legend and
/// values; radiance has a legend in false colours only.
pub fn draw(settings: DisplaySettings, sources: &Sources, pixels: &mut Vec<[u8; 4]>) -> Option<(Legend, Field)> {
    in_view!(settings.view, V => V::draw(settings, sources, pixels))
}

fn paint(field: &Field, legend: &Legend, settings: DisplaySettings, sources: &Sources, pixels: &mut Vec<[u8; 4]>) {
    pixels.clear();
    match field {
        Field::Missing => pixels.resize(sources.frame.radiance.len(), [96, 96, 96, 255]),
        Field::Colours(colours) => pixels.extend(colours.iter().map(|[r, g, b]| [*r, *g, *b, 255])),
        Field::Numbers(numbers) => {
            let table = legend.scale.as_ref().map_or(settings.map, |scale| scale.map).table();
            let place = |x: f32| legend.scale.as_ref().map_or(0.0, |scale| scale.place(x));
            let colour = |x: &f32| if x.is_nan() { [96, 96, 96, 255] } else { table[(place(*x) * 255.0).round() as usize] };
            pixels.extend(numbers.iter().map(colour));
        }
    }
}
