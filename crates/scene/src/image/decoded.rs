//! PNG, JPEG, TGA, WebP and BMP, by the `image` crate.
//!
//! The size in the header is checked, and the memory of the whole decoder is reserved, before any pixel is decoded.
use ::image::{
    ImageDecoder, Limits,
    codecs::{bmp::BmpDecoder, jpeg::JpegDecoder, png::PngDecoder, tga::TgaDecoder, webp::WebPDecoder},
};

use super::{
    Encoding, ImageFormatError, LONGEST_SIDE, Picture, Pixel, Source, check_length, check_size, check_unpacked, length, pixels,
    room,
};
use noisefall_base::{
    math::colour::linear_from_srgb,
    memory::{Reservation, reserve},
};

/// Name of the memory of a decoder in messages.
const BYTES: &str = "the bytes of an image";
/// Maximum memory for chunks of a PNG that are not pixels, such as the text of a scene.
const CHUNKS: u64 = 64 << 20;
/// Bytes per pixel that decoders keep besides the result: JPEG four components of two bytes, WebP two images of four bytes, TGA indices
/// of colours.
const JPEG: u64 = 8;
const WEBP: u64 = 8;
const TGA: u64 = 2;
/// Stands for the length of files that can hold any number of pixels. Its product with the densest pixels does not overflow.
const ANY_LENGTH: u64 = u32::MAX as u64;

pub(super) fn png<P: Pixel>(file: &mut dyn Source, encoding: Encoding) -> Result<Picture<P>, ImageFormatError> {
    let (width, height) = size_of_png(file)?;
    check_size(width.into(), height.into())?;
    let length = length(file)?;
    decode(PngDecoder::with_limits(file, limits(CHUNKS)).map_err(ImageFormatError::broken)?, [0, length, length], encoding)
}

pub(super) fn jpeg<P: Pixel>(file: &mut dyn Source, encoding: Encoding) -> Result<Picture<P>, ImageFormatError> {
    let (_file, length) = whole(file)?;
    decode(JpegDecoder::new(file).map_err(ImageFormatError::broken)?, [JPEG, length, length], encoding)
}

pub(super) fn tga<P: Pixel>(file: &mut dyn Source, encoding: Encoding) -> Result<Picture<P>, ImageFormatError> {
    let length = length(file)?;
    decode(TgaDecoder::new(file).map_err(ImageFormatError::broken)?, [TGA, length, length], encoding)
}

pub(super) fn webp<P: Pixel>(file: &mut dyn Source, encoding: Encoding) -> Result<Picture<P>, ImageFormatError> {
    let (_file, length) = whole(file)?;
    decode(WebPDecoder::new(file).map_err(ImageFormatError::broken)?, [WEBP, ANY_LENGTH, length], encoding)
}

pub(super) fn bmp<P: Pixel>(file: &mut dyn Source, encoding: Encoding) -> Result<Picture<P>, ImageFormatError> {
    let length = length(file)?;
    decode(BmpDecoder::new(file).map_err(ImageFormatError::broken)?, [0, length, length], encoding)
}

/// Decodes the pixels of a file whose header has been read. `besides`: bytes per pixel that the decoder takes for itself. `holds`: bytes
/// that bound the pixels it can hold at all. `length`: that of the file, bytes.
fn decode<P: Pixel>(
    mut decoder: impl ImageDecoder,
    [besides, holds, length]: [u64; 3],
    encoding: Encoding,
) -> Result<Picture<P>, ImageFormatError> {
    let (width, height) = decoder.dimensions();
    check_size(width.into(), height.into())?;
    check_length(width.into(), height.into(), holds)?;
    check_unpacked(width.into(), height.into(), length)?;
    let size = decoder.total_bytes() + besides * u64::from(width) * u64::from(height);
    let _room = room::<P>(width, height, 0)?;
    let _bytes = reserve(BYTES, size)?;
    decoder.set_limits(limits(size)).map_err(ImageFormatError::broken)?;
    let colour = decoder.color_type();
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(decoder.total_bytes() as usize).map_err(ImageFormatError::broken)?;
    bytes.resize(decoder.total_bytes() as usize, 0);
    decoder.read_image(&mut bytes).map_err(ImageFormatError::broken)?;
    let channels = usize::from(colour.channel_count());
    let radiance = match usize::from(colour.bytes_per_pixel()) / channels {
        1 => linear(bytes.iter().map(|sample| u16::from(*sample)), u8::MAX.into(), channels, encoding),
        2 => {
            let samples = bytes.chunks_exact(2).map(|sample| u16::from_ne_bytes([sample[0], sample[1]]));
            linear(samples, u16::MAX, channels, encoding)
        }
        _ => Err(ImageFormatError::broken(format!("its samples are {colour:?}"))),
    }?;
    Ok(Picture { width, height, radiance })
}

/// Converts samples from 0 to `most` to linear light. Of fewer than three channels, the first is grey. The last of two or four
/// channels is opacity, which is linear.
fn linear<P: Pixel>(
    mut samples: impl ExactSizeIterator<Item = u16>,
    most: u16,
    channels: usize,
    encoding: Encoding,
) -> Result<Vec<P>, ImageFormatError> {
    let value = |sample: u16| {
        let x = f64::from(sample) / f64::from(most);
        (if encoding == Encoding::Srgb { linear_from_srgb(x) } else { x }) as f32
    };
    let values: Vec<f32> = (0..=most).map(value).collect();
    let mut radiance = pixels(samples.len() / channels)?;
    while let Some(first) = samples.next() {
        let mut pixel = [first; 4];
        pixel[1..channels].fill_with(|| samples.next().unwrap_or_default());
        let rgb = if channels < 3 { [first; 3] } else { [first, pixel[1], pixel[2]] };
        let rgb = rgb.map(|sample| values[usize::from(sample)]);
        let opacity = || f32::from(pixel[channels - 1]) / f32::from(most);
        radiance.push(if P::HAS_OPACITY && channels.is_multiple_of(2) { P::with_opacity(rgb, opacity()) } else { P::of(rgb) });
    }
    Ok(radiance)
}

/// Reserves memory for a file that its decoder reads as a whole, into a buffer that grows by doubling; and the length of the file.
fn whole(file: &mut dyn Source) -> Result<(Reservation, u64), ImageFormatError> {
    let length = length(file)?;
    Ok((reserve(BYTES, 2 * length)?, length))
}

fn limits(bytes: u64) -> Limits {
    let mut limits = Limits::default();
    limits.max_image_width = Some(LONGEST_SIDE as u32);
    limits.max_image_height = Some(LONGEST_SIDE as u32);
    limits.max_alloc = Some(bytes);
    limits
}

/// Width and height of the header chunk, which the standard puts first (PNG, third edition, sections 5.6 and 11.2.1).
fn size_of_png(file: &mut dyn Source) -> Result<(u32, u32), ImageFormatError> {
    let mut start = [0; 24];
    file.read_exact(&mut start).map_err(|_| ImageFormatError::broken("the file ends within its header"))?;
    let number = |at: usize| u32::from_be_bytes([start[at], start[at + 1], start[at + 2], start[at + 3]]);
    if &start[12..16] != b"IHDR" {
        return Err(ImageFormatError::broken("the file does not begin with a header"));
    }
    Ok((number(16), number(20)))
}
