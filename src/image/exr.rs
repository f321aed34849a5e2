//! OpenEXR, by the `exr` crate.
use std::io::{BufRead, Seek};

use ::exr::{
    meta::MetaData,
    prelude::{ReadChannels, ReadLayers, read},
};

use super::{Flaw, Picture, check_size};

pub(super) fn decode(mut file: impl BufRead + Seek) -> Result<Picture, Flaw> {
    let headers = MetaData::read_from_buffered(&mut file, false).map_err(Flaw::broken)?.headers;
    for header in &headers {
        check_size(header.layer_size.width() as u64, header.layer_size.height() as u64)?;
    }
    file.rewind()?;
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| (size.width(), vec![[0f32; 3]; size.area()]),
            |(width, pixels), at, (r, g, b): (f32, f32, f32)| pixels[at.y() * *width + at.x()] = [r, g, b],
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(file)
        .map_err(Flaw::broken)?;
    let size = image.layer_data.size;
    let (_, radiance) = image.layer_data.channel_data.pixels;
    Ok(Picture { width: size.width() as u32, height: size.height() as u32, radiance })
}
