//! Pictures on disk: PNG (what the screen shows) and EXR (linear radiance), both with the settings that made them.
use std::{
    io::{BufWriter, Write},
    path::{Path, PathBuf},
};

use exr::prelude::{Image, Layer, LayerAttributes, SpecificChannels, Text, WritableImage, attribute::AttributeValue};

use super::{display::to_srgb, frame::Frame, tone::Display};
pub use crate::image::Picture;
use crate::image::{Encoding, PictureError};

/// Where the settings stand in a file.
pub const SETTINGS_KEY: &str = "noisefall";

/// Why a picture could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    #[error("{}: the name must end in .png (as shown) or .exr (linear)", .0.display())]
    Format(PathBuf),
    #[error("{}: there is no folder {}", path.display(), folder.display())]
    NoFolder { path: PathBuf, folder: PathBuf },
    #[error("{}: cannot be written: {reason}", path.display())]
    Write { path: PathBuf, reason: String },
    #[error(transparent)]
    Read(#[from] PictureError),
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
}

fn format(path: &Path) -> Result<Format, ImageError> {
    match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("png") => Ok(Format::Png),
        Some("exr") => Ok(Format::Exr),
        _ => Err(ImageError::Format(path.to_owned())),
    }
}

/// Whether a picture could be written there, as far as can be told before there is one.
pub fn check_target(path: &Path) -> Result<(), ImageError> {
    format(path)?;
    let path = &through_links(path);
    let folder = folder(path)?;
    let refused = |reason: String| Err(ImageError::Write { path: path.to_owned(), reason });
    match std::fs::metadata(path) {
        Ok(there) if there.is_dir() => return refused("it is a folder".to_owned()),
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => return refused(error.to_string()),
        _ => {}
    }
    // Made and removed again: a folder that cannot be written to is better known before an hour of rendering than after.
    temporary(path, &folder).map(drop)
}

/// What a symbolic link stands for in the end, there or not: a file that is renamed to the link itself would replace it.
fn through_links(path: &Path) -> PathBuf {
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(to) = std::fs::read_link(&path) else { break };
        path = path.parent().map_or_else(|| to.clone(), |folder| folder.join(&to));
    }
    path
}

/// The folder that the file will lie in, which must exist.
fn folder(path: &Path) -> Result<PathBuf, ImageError> {
    let parent = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = parent.unwrap_or_else(|| Path::new(".")).to_owned();
    if folder.is_dir() { Ok(folder) } else { Err(ImageError::NoFolder { path: path.to_owned(), folder }) }
}

/// Writes a frame as PNG or EXR, by the extension. The file appears whole or not at all. `settings` is any text.
pub fn save(frame: &Frame, display: Display, settings: &str, path: &Path) -> Result<(), ImageError> {
    let mut pixels = Vec::new();
    if format(path)? == Format::Png {
        to_srgb(&frame.radiance, display, &mut pixels);
    }
    save_shown(frame, &pixels, settings, path)
}

/// [`save`] with these pixels in a PNG: what the screen shows of the frame.
pub fn save_shown(frame: &Frame, pixels: &[[u8; 4]], settings: &str, path: &Path) -> Result<(), ImageError> {
    let format = format(path)?;
    let path = &through_links(path);
    let folder = folder(path)?;
    let failed = |reason: String| ImageError::Write { path: path.to_owned(), reason };
    let mut file = temporary(path, &folder)?;
    {
        let mut writer = BufWriter::new(file.as_file_mut());
        match format {
            Format::Png => write_png([frame.width, frame.height], pixels, settings, &mut writer),
            Format::Exr => write_exr(frame, settings, &mut writer),
        }
        .map_err(failed)?;
        writer.flush().map_err(|error| failed(error.to_string()))?;
    }
    file.as_file().sync_all().map_err(|error| failed(error.to_string()))?;
    file.persist(path).map_err(|error| failed(error.error.to_string()))?;
    Ok(())
}

/// A file beside the target that disappears unless it is renamed to it.
fn temporary(path: &Path, folder: &Path) -> Result<tempfile::NamedTempFile, ImageError> {
    crate::file::temporary(folder).map_err(|error| {
        // The crate adds the path of the temporary file, which says nothing to anybody.
        let reason = error.to_string();
        let why = reason.split(" at path ").next().unwrap_or_default();
        ImageError::Write { path: path.to_owned(), reason: why.to_owned() }
    })
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

fn write_exr(frame: &Frame, settings: &str, to: &mut impl Write) -> Result<(), String> {
    let size = (frame.width as usize, frame.height as usize);
    let channels = SpecificChannels::rgb(|at: exr::prelude::Vec2<usize>| {
        let [r, g, b] = frame.radiance[at.y() * size.0 + at.x()];
        (r, g, b)
    });
    let mut attributes = LayerAttributes::named("");
    attributes.layer_name = None;
    attributes.software_name = Some(Text::from("Noisefall"));
    let text = Text::new_or_none(settings).ok_or("the settings are not Latin-1 text, and EXR knows no other")?;
    attributes.other.insert(Text::from(SETTINGS_KEY), AttributeValue::Text(text));
    let layer = Layer::new(size, attributes, exr::prelude::Encoding::FAST_LOSSLESS, channels);
    // The format is written with seeks, which a buffer in memory allows whatever the target is.
    let mut bytes = std::io::Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).map_err(|error| error.to_string())?;
    to.write_all(bytes.get_ref()).map_err(|error| error.to_string())
}

/// Reads a picture; a PNG is taken as sRGB.
pub fn read(path: &Path) -> Result<Picture, ImageError> {
    Ok(crate::image::read(path, Encoding::Srgb)?)
}
