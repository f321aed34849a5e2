//! PNG, by the `png` crate.
use std::io::{BufRead, Seek};

use ::png::{BitDepth, Decoder, Transformations};

use super::{Encoding, Flaw, Picture, check_size};
use crate::math::colour::linear_from_srgb;

pub(super) fn decode(mut file: impl BufRead + Seek, encoding: Encoding) -> Result<Picture, Flaw> {
    let (width, height) = claimed_size(&mut file)?;
    check_size(width.into(), height.into())?;
    file.rewind()?;
    let mut decoder = Decoder::new(file);
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(Flaw::broken)?;
    let size = reader.output_buffer_size().ok_or_else(|| Flaw::broken("the rows are too long"))?;
    let mut bytes = vec![0; size];
    let info = reader.next_frame(&mut bytes).map_err(Flaw::broken)?;
    let bytes = &bytes[..info.buffer_size()];
    let channels = info.color_type.samples();
    let radiance = match info.bit_depth {
        BitDepth::Sixteen => {
            let samples: Vec<u16> = bytes.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
            pixels(&samples, channels, &linear_values(u16::MAX.into(), encoding))
        }
        _ => pixels(bytes, channels, &linear_values(u8::MAX.into(), encoding)),
    };
    Ok(Picture { width, height, radiance })
}

/// Width and height of the header chunk, which the standard puts first (PNG, third edition, sections 5.6 and 11.2.1).
fn claimed_size(file: &mut impl BufRead) -> Result<(u32, u32), Flaw> {
    let mut start = [0; 24];
    file.read_exact(&mut start).map_err(|_| Flaw::broken("the file ends within its header"))?;
    let number = |at: usize| u32::from_be_bytes([start[at], start[at + 1], start[at + 2], start[at + 3]]);
    if &start[12..16] != b"IHDR" {
        return Err(Flaw::broken("the file does not begin with a header"));
    }
    Ok((number(16), number(20)))
}

/// The linear value of every sample value.
fn linear_values(most: u32, encoding: Encoding) -> Vec<f32> {
    let linear = |sample: u32| {
        let x = f64::from(sample) / f64::from(most);
        (if encoding == Encoding::Srgb { linear_from_srgb(x) } else { x }) as f32
    };
    (0..=most).map(linear).collect()
}

fn pixels<T: Copy + Into<usize>>(samples: &[T], channels: usize, linear: &[f32]) -> Vec<[f32; 3]> {
    let value = |sample: T| linear[sample.into()];
    let pixel = |p: &[T]| if channels < 3 { [value(p[0]); 3] } else { [value(p[0]), value(p[1]), value(p[2])] };
    samples.chunks_exact(channels).map(pixel).collect()
}
