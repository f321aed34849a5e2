//! Images of reports as PNG.
use base64::{Engine, engine::general_purpose::STANDARD};

/// A PNG with 8 bits per channel, sRGB, row by row from the top left.
pub fn rgb_png([width, height]: [u32; 2], rgb: &[u8]) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().map_err(|error| error.to_string())?;
    writer.write_image_data(rgb).map_err(|error| error.to_string())?;
    writer.finish().map_err(|error| error.to_string())?;
    Ok(bytes)
}

/// A PNG as an SVG of its size, for documents that take figures in that form only.
pub fn svg(png: &[u8]) -> Result<Vec<u8>, String> {
    let reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().map_err(|error| error.to_string())?;
    let (width, height) = reader.info().size();
    let data = STANDARD.encode(png);
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\
         <image width=\"{width}\" height=\"{height}\" href=\"data:image/png;base64,{data}\"/></svg>"
    )
    .into_bytes())
}

/// A PNG as an element of a page.
pub fn img(png: &[u8]) -> String {
    format!("<img src=\"data:image/png;base64,{}\" alt=\"\">", STANDARD.encode(png))
}
