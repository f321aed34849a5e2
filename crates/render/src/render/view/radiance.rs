//! The image itself, through exposure and tone map.
use super::{DisplaySettings, Field, Legend, Quantity, Sources, legend::false_colours};
use crate::render::tone::to_srgb;
use noisefall_base::declare::Word;

pub(super) struct Radiance;

impl Quantity for Radiance {
    const WORD: Word = Word {
        name: "radiance",
        title: "Radiance",
        doc: "The image itself: L_o of the equation at every pixel, after exposure and tone map.",
    };

    const SHOWS_LIGHT: bool = true;

    fn draw(settings: DisplaySettings, sources: &Sources, pixels: &mut Vec<[u8; 4]>) -> Option<(Legend, Field)> {
        to_srgb(sources.radiance.unwrap_or(&sources.frame.radiance), settings.display, pixels);
        false_colours("Luminance", settings.display).map(|legend| (legend, Field::Colours(Vec::new())))
    }

    fn field(_: &Sources) -> Field {
        Field::Missing
    }
}
