//! Images that exist in memory only: encoded PNG and EXR files.
use std::io::Cursor;

/// A PNG of display values or of linear numbers, row by row from the top left: grey with one channel, with opacity with four.
pub fn png<const CHANNELS: usize>(width: u32, height: u32, pixels: &[[u8; CHANNELS]]) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(match CHANNELS {
        1 => png::ColorType::Grayscale,
        4 => png::ColorType::Rgba,
        3 => png::ColorType::Rgb,
        _ => return None,
    });
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().ok()?;
    writer.write_image_data(pixels.as_flattened()).ok()?;
    writer.finish().ok()?;
    Some(bytes)
}

/// An EXR of linear Rec. 709, row by row from the top left.
pub fn exr(width: u32, height: u32, pixels: &[[f32; 3]]) -> Option<Vec<u8>> {
    use exr::prelude::{Image, SpecificChannels, WritableImage};
    let (columns, rows) = (width as usize, height as usize);
    let channels = SpecificChannels::rgb(|at: exr::prelude::Vec2<usize>| {
        let [r, g, b] = pixels[at.y() * columns + at.x()];
        (r, g, b)
    });
    let mut bytes = Vec::new();
    Image::from_channels((columns, rows), channels).write().to_buffered(Cursor::new(&mut bytes)).ok()?;
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_in_memory_have_their_signatures() {
        let pixels = [[0u8, 128, 255]; 6];
        assert!(png(3, 2, &pixels).is_some_and(|bytes| bytes.starts_with(b"\x89PNG")));
        assert!(png(2, 2, &[[255], [0], [0], [255]]).is_some() && png(1, 1, &[[0, 255]]).is_none());
        assert!(exr(3, 2, &[[0.5f32, 1.0, 20.0]; 6]).is_some_and(|bytes| bytes.starts_with(b"\x76\x2f\x31\x01")));
    }
}
