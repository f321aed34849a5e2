//! Images that exist in memory only: encoded PNG and EXR files.
use std::io::Cursor;

use exr::prelude::{Image, SpecificChannels, Vec2, WritableImage};

/// A PNG of linear greys, row by row from the top left.
pub fn png(width: u32, height: u32, pixels: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().ok()?;
    writer.write_image_data(pixels).ok()?;
    writer.finish().ok()?;
    Some(bytes)
}

/// An EXR of linear Rec. 709, row by row from the top left.
pub fn exr(width: u32, height: u32, pixels: &[[f32; 3]]) -> Option<Vec<u8>> {
    let (columns, rows) = (width as usize, height as usize);
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [r, g, b] = pixels[at.y() * columns + at.x()];
        (r, g, b)
    });
    let mut bytes = Vec::new();
    Image::from_channels((columns, rows), channels).write().to_buffered(Cursor::new(&mut bytes)).ok()?;
    Some(bytes)
}
