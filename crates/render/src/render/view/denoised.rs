//! The denoised image.
use super::{DisplaySettings, Field, Legend, Quantity, Sources, legend::false_colours};
use crate::render::{
    denoise::{LABEL, VIEW_TITLE},
    tone::to_srgb,
};
use noisefall_base::declare::Word;

pub(super) struct Denoised;

impl Quantity for Denoised {
    const WORD: Word = Word {
        name: "denoised",
        title: VIEW_TITLE,
        doc: "The image after non-local means over two halves of its samples (Rousselle et al. 2012): biased, not the solution of the equation.",
    };

    const IS_DENOISED: bool = true;

    fn missing() -> &'static str {
        "Denoising …: this is the image without it"
    }

    fn field(_: &Sources) -> Field {
        Field::Missing
    }

    fn draw(settings: DisplaySettings, sources: &Sources, pixels: &mut Vec<[u8; 4]>) -> Option<(Legend, Field)> {
        let plain = |title: &str| Legend { title: title.to_owned(), scale: None, entries: Vec::new() };
        let legend = |title: &str| false_colours(title, settings.display).unwrap_or_else(|| plain(title));
        let Some(radiance) = sources.radiance else {
            to_srgb(&sources.frame.radiance, settings.display, pixels);
            return Some((legend(Self::missing()), Field::Missing));
        };
        to_srgb(radiance, settings.display, pixels);
        Some((legend(LABEL), Field::Colours(Vec::new())))
    }
}
