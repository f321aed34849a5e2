//! Image files: PNG (as displayed) and EXR (linear radiance), both with the settings of the render.
use std::{
    io::Write,
    path::{Path, PathBuf},
};

use exr::prelude::{
    AnyChannel, AnyChannels, FlatSamples, Image, Layer, LayerAttributes, Text, WritableImage, attribute::AttributeValue,
};

pub use super::noise_layer::{Provenance, provenance};
use super::{frame::Frame, layers::Channel, noise_layer, tone::Display, tone::to_srgb};
use noisefall_base::file::{self, WriteError};
use noisefall_scene::image::{Encoding, PictureError};
pub use noisefall_scene::image::{Picture, SETTINGS_KEY};

/// Error of reading or writing an image.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The name has no known extension.
    #[error("{}: the name must end in .png (as shown) or .exr (linear), such as {}", .0.display(), as_png(.0))]
    Format(PathBuf),
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The image does not fit the format.
    #[error("the image cannot be encoded: {0}")]
    Encode(String),
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] PictureError),
    /// The image is to be a reference, but it is biased.
    #[error("{}: the image is denoised, and so biased; a reference must be a render without --denoise", .0.display())]
    Denoised(PathBuf),
}

/// The name of a PNG in place of that of another file.
fn as_png(path: &Path) -> String {
    Path::new(path.file_name().unwrap_or_default()).with_extension("png").display().to_string()
}

/// Format of an image file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// As displayed, sRGB.
    Png,
    /// Linear radiance.
    Exr,
}

impl Format {
    /// The format of a file name by its extension.
    pub fn of(path: &Path) -> Result<Format, ImageError> {
        let extension = path.extension().and_then(|extension| extension.to_str());
        extension.and_then(Format::named).ok_or_else(|| ImageError::Format(path.to_owned()))
    }

    /// Parses "png" or "exr", in upper or lower case.
    pub fn named(name: &str) -> Option<Format> {
        [Format::Png, Format::Exr].into_iter().find(|format| format.name().eq_ignore_ascii_case(name))
    }

    /// The extension, "png" or "exr".
    pub fn name(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Exr => "exr",
        }
    }
}

/// Checks whether an image can be written to this path, as far as this is known before there is one.
pub fn check_target(path: &Path) -> Result<(), ImageError> {
    Format::of(path)?;
    Ok(file::check(path)?)
}

/// Writes a frame as PNG or EXR, by the extension. The file appears whole or not at all. `settings` is any text.
pub fn save(frame: &Frame, display: Display, settings: &str, path: &Path) -> Result<(), ImageError> {
    Contents { frame, channels: &[], settings }.save(display, path)
}

/// The contents of an image file.
#[derive(Clone, Copy)]
pub struct Contents<'a> {
    /// The image.
    pub frame: &'a Frame,
    /// Further channels of an EXR, as many values each as the frame has pixels: see [`super::layers`].
    pub channels: &'a [Channel],
    /// Any text.
    pub settings: &'a str,
}

impl Contents<'_> {
    /// Writes a PNG or EXR, by the extension. The file appears whole or not at all.
    pub fn save(&self, display: Display, path: &Path) -> Result<(), ImageError> {
        let bytes = self.encode(display, Format::of(path)?)?;
        Ok(file::replace(path, &bytes)?)
    }

    /// [`Contents::save`] with these pixels in a PNG: the frame as displayed.
    pub fn save_shown(&self, pixels: &[[u8; 4]], path: &Path) -> Result<(), ImageError> {
        let bytes = self.encode_shown(pixels, Format::of(path)?)?;
        Ok(file::replace(path, &bytes)?)
    }

    /// The bytes of a file.
    pub fn encode(&self, display: Display, format: Format) -> Result<Vec<u8>, ImageError> {
        let mut pixels = Vec::new();
        if format == Format::Png {
            to_srgb(&self.frame.radiance, display, &mut pixels);
        }
        self.encode_shown(&pixels, format)
    }

    fn encode_shown(&self, pixels: &[[u8; 4]], format: Format) -> Result<Vec<u8>, ImageError> {
        let mut bytes = Vec::new();
        let encoded = match format {
            Format::Png => write_png([self.frame.width, self.frame.height], pixels, self.settings, &mut bytes),
            Format::Exr => write_exr(self, &mut bytes),
        };
        encoded.map(|()| bytes).map_err(ImageError::Encode)
    }
}

fn write_png([width, height]: [u32; 2], pixels: &[[u8; 4]], settings: &str, to: &mut impl Write) -> Result<(), String> {
    let rgb: Vec<u8> = pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
    let mut encoder = png::Encoder::new(to, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.add_itxt_chunk(SETTINGS_KEY.to_owned(), settings.to_owned()).map_err(|error| error.to_string())?;
    let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
    writer.write_image_data(&rgb).map_err(|error| error.to_string())?;
    writer.finish().map_err(|error| error.to_string())
}

fn write_exr(&Contents { frame, channels, settings }: &Contents, to: &mut Vec<u8>) -> Result<(), String> {
    let size = (frame.width as usize, frame.height as usize);
    let mut attributes = LayerAttributes::named("");
    attributes.layer_name = None;
    attributes.software_name = Some(Text::from("Noisefall"));
    let text = Text::new_or_none(settings).ok_or("the settings are not Latin-1 text, which is all that EXR can store")?;
    attributes.other.insert(Text::from(SETTINGS_KEY), AttributeValue::Text(text));
    let mut list = noise_layer::channels(frame);
    list.extend(channels.iter().map(|Channel { name, values }| AnyChannel::new(name.as_str(), FlatSamples::F32(values.clone()))));
    let channels = AnyChannels::sort(list.into());
    let layer = Layer::new(size, attributes, exr::prelude::Encoding::FAST_LOSSLESS, channels);
    let mut image = Image::from_layer(layer);
    noise_layer::add_figures(frame, &mut image.attributes);
    // The format is written with seeks, which a buffer in memory allows whatever the target is.
    image.write().to_buffered(std::io::Cursor::new(to)).map_err(|error| error.to_string())
}

/// Reads an image; a PNG is taken as sRGB.
pub fn read(path: &Path) -> Result<Picture, ImageError> {
    Ok(noisefall_scene::image::read(path, Encoding::Srgb)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use noisefall_base::file::faults::lose_nothing;

    #[test]
    fn a_disk_that_fails_at_any_moment_leaves_the_image_before() {
        let folder = tempfile::tempdir().expect("a folder");
        let frame = Frame { width: 2, height: 1, full_resolution: [2, 1], radiance: vec![[0.5; 3]; 2], ..Frame::default() };
        for name in ["a.png", "a.exr"] {
            let path = folder.path().join(name);
            std::fs::write(&path, "an earlier image").expect("it is written");
            let write = || save(&frame, Display::default(), "settings", &path).map_err(|error| error.to_string());
            lose_nothing(&path, &mut { write });
        }
    }
}
