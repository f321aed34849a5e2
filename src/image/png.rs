//! PNG, by the `png` crate.
use std::io::{BufRead, Seek};

use ::png::{BitDepth, Decoder, Transformations};

use super::{Encoding, ImageFormatError, Picture, Pixel, check_size, pixels, room};
use crate::math::colour::linear_from_srgb;

pub(super) fn decode<P: Pixel>(mut file: impl BufRead + Seek, encoding: Encoding) -> Result<Picture<P>, ImageFormatError> {
    let (width, height) = claimed_size(&mut file)?;
    check_size(width.into(), height.into())?;
    file.rewind()?;
    let mut decoder = Decoder::new(file);
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(ImageFormatError::broken)?;
    // The rows of a picture in passes are not together before the last one.
    let in_passes = reader.info().interlaced;
    let whole = reader.output_buffer_size().ok_or_else(|| ImageFormatError::broken("the rows are too long"))?;
    let _room = room::<P>(width, height, if in_passes { whole as u64 } else { 0 })?;
    let mut radiance = pixels(width, height)?;
    let (colour, depth) = reader.output_color_type();
    let values = Values { channels: colour.samples(), linear: linear_values(depth, encoding) };
    if in_passes {
        let mut bytes = vec![0; whole];
        let info = reader.next_frame(&mut bytes).map_err(ImageFormatError::broken)?;
        values.append(&bytes[..info.buffer_size()], &mut radiance);
    } else {
        while let Some(row) = reader.next_row().map_err(ImageFormatError::broken)? {
            values.append(row.data(), &mut radiance);
        }
    }
    if radiance.len() != width as usize * height as usize {
        return Err(ImageFormatError::broken("the file ends within its pixels"));
    }
    Ok(Picture { width, height, radiance })
}

/// Width and height of the header chunk, which the standard puts first (PNG, third edition, sections 5.6 and 11.2.1).
fn claimed_size(file: &mut impl BufRead) -> Result<(u32, u32), ImageFormatError> {
    let mut start = [0; 24];
    file.read_exact(&mut start).map_err(|_| ImageFormatError::broken("the file ends within its header"))?;
    let number = |at: usize| u32::from_be_bytes([start[at], start[at + 1], start[at + 2], start[at + 3]]);
    if &start[12..16] != b"IHDR" {
        return Err(ImageFormatError::broken("the file does not begin with a header"));
    }
    Ok((number(16), number(20)))
}

/// The linear value of every sample value.
fn linear_values(depth: BitDepth, encoding: Encoding) -> Vec<f32> {
    let most = u32::from(if depth == BitDepth::Sixteen { u16::MAX } else { u8::MAX.into() });
    let linear = |sample: u32| {
        let x = f64::from(sample) / f64::from(most);
        (if encoding == Encoding::Srgb { linear_from_srgb(x) } else { x }) as f32
    };
    (0..=most).map(linear).collect()
}

/// Conversion of samples to linear light.
struct Values {
    channels: usize,
    /// One entry for every value of a sample: 256, or 65536 for samples of two bytes.
    linear: Vec<f32>,
}

impl Values {
    /// Decodes these bytes and appends their pixels.
    fn append<P: Pixel>(&self, bytes: &[u8], radiance: &mut Vec<P>) {
        match self.linear.len() {
            256 => {
                radiance.extend(bytes.chunks_exact(self.channels).map(|pixel| self.pixel::<P>(|channel| pixel[channel].into())));
            }
            _ => {
                radiance.extend(bytes.chunks_exact(2 * self.channels).map(|pixel| {
                    self.pixel::<P>(|channel| u16::from_be_bytes([pixel[2 * channel], pixel[2 * channel + 1]]).into())
                }));
            }
        }
    }

    /// With fewer than three channels, the first is grey.
    fn pixel<P: Pixel>(&self, sample: impl Fn(usize) -> usize) -> P {
        P::of([0, 1, 2].map(|channel| self.linear[sample(if self.channels < 3 { 0 } else { channel })]))
    }
}
