//! OpenEXR, by the `exr` crate.
mod channels;

use ::exr::{
    meta::{BlockDescription, MetaData, header::Header},
    prelude::{ReadChannels, ReadLayers, ReadSpecificChannel, Vec2, read},
};

use self::channels::{Channels, choose};
use super::{ImageFormatError, Picture, Pixel, Source, check_length, check_size, check_unpacked, length, room};

/// Blocks are decompressed in parallel, each in its own memory.
const UNPACKING: u64 = 32 << 20;

pub(super) fn decode<P: Pixel>(file: &mut dyn Source) -> Result<Picture<P>, ImageFormatError> {
    let length = length(file)?;
    let headers = MetaData::read_from_buffered(&mut *file, false).map_err(ImageFormatError::broken)?.headers;
    for header in &headers {
        check_size(header.layer_size.width() as u64, header.layer_size.height() as u64)?;
        check_tiles(header)?;
    }
    let sizes = headers.iter().map(|header| header.layer_size);
    let Some(largest) = sizes.max_by_key(|size| size.area()) else {
        return Err(ImageFormatError::broken("the file has no layers"));
    };
    check_length(largest.width() as u64, largest.height() as u64, length)?;
    check_unpacked(largest.width() as u64, largest.height() as u64, length)?;
    let channels = choose(&headers).map_err(ImageFormatError::broken)?;
    let _room = room::<P>(largest.width() as u32, largest.height() as u32, UNPACKING)?;
    file.rewind()?;
    let reader = || read().no_deep_data().largest_resolution_level();
    let create = |size: Vec2<usize>| (size.width(), vec![P::default(); size.area()]);
    let set = |(width, pixels): &mut (usize, Vec<P>), at: Vec2<usize>, rgb, opacity| {
        pixels[at.y() * *width + at.x()] = P::with_opacity(rgb, opacity);
    };
    let (size, (_, radiance)) = match channels {
        Channels::Grey { value, opacity } => {
            let channels = reader()
                .specific_channels()
                .required(value)
                .optional(opacity, 1.0)
                .collect_pixels(|size, _| create(size), move |pixels, at, (x, a): (f32, f32)| set(pixels, at, [x; 3], a));
            let layer = channels.first_valid_layer().all_attributes().from_buffered(file).map_err(ImageFormatError::broken)?;
            (layer.layer_data.size, layer.layer_data.channel_data.pixels)
        }
        Channels::Colour { red, green, blue, opacity } => {
            let channels = reader().specific_channels().required(red).required(green);
            let channels = channels.optional(blue, 0.0).optional(opacity, 1.0).collect_pixels(
                |size, _| create(size),
                move |pixels, at, (r, g, b, a): (f32, f32, f32, f32)| set(pixels, at, [r, g, b], a),
            );
            let layer = channels.first_valid_layer().all_attributes().from_buffered(file).map_err(ImageFormatError::broken)?;
            (layer.layer_data.size, layer.layer_data.channel_data.pixels)
        }
    };
    Ok(Picture { width: size.width() as u32, height: size.height() as u32, radiance })
}

/// Refuses tiles that are larger than their image and than usual tiles. The decoder takes the memory of a whole one.
fn check_tiles(header: &Header) -> Result<(), ImageFormatError> {
    /// Side of the largest tiles that images of any size have, in pixels.
    const USUAL: usize = 1024;
    let BlockDescription::Tiles(tiles) = header.blocks else { return Ok(()) };
    let ([width, height], size) = ([tiles.tile_size.width(), tiles.tile_size.height()], header.layer_size);
    if width > size.width().max(USUAL) || height > size.height().max(USUAL) {
        return Err(ImageFormatError::broken(format!("its tiles of {width} × {height} pixels are larger than the image")));
    }
    Ok(())
}
