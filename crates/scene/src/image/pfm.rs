//! PFM: floating-point numbers, grey or in three channels, row by row from the bottom.
//!
//! P. Debevec, "PFM Portable FloatMap Image Format", 2001. The header is three words: `PF` or `Pf`, the size, and a factor whose sign is
//! negative if the numbers are little-endian.
use super::{ImageFormatError, Picture, Pixel, Source, check_size, length, pixels, room};
use noisefall_base::quote;

/// Longest word of a header, bytes.
const LONGEST_WORD: usize = 64;

pub(super) fn decode<P: Pixel>(file: &mut dyn Source) -> Result<Picture<P>, ImageFormatError> {
    let length = length(file)?;
    let channels = match word(file)?.0.as_str() {
        "PF" => 3,
        _ => 1,
    };
    let [width, height] = [side(file)?, side(file)?];
    let (word, end) = word(file)?;
    let scale = word.parse().ok().filter(|scale: &f32| scale.is_normal());
    let scale = scale.ok_or_else(|| ImageFormatError::broken(format!("{} is not a factor", quote::bytes(word.as_bytes()))))?;
    check_size(width.into(), height.into())?;
    let row_bytes = 4 * channels * u64::from(width);
    let left = length - file.stream_position()?;
    // Lines of some systems end in two characters.
    let is_wide_end = end == b'\r' && left == row_bytes * u64::from(height) + 1;
    if is_wide_end {
        file.read_exact(&mut [0])?;
    }
    if left < row_bytes * u64::from(height) {
        return Err(ImageFormatError::broken("the file ends within its pixels"));
    }
    let _room = room::<P>(width, height, row_bytes)?;
    let mut radiance = pixels(width as usize * height as usize)?;
    radiance.resize(width as usize * height as usize, P::default());
    let mut bytes = vec![0; row_bytes as usize];
    let number = |bytes: [u8; 4]| scale.abs() * if scale < 0.0 { f32::from_le_bytes(bytes) } else { f32::from_be_bytes(bytes) };
    for row in radiance.chunks_exact_mut(width as usize).rev() {
        file.read_exact(&mut bytes)?;
        let numbers = bytes.as_chunks().0;
        for (pixel, numbers) in row.iter_mut().zip(numbers.chunks_exact(channels as usize)) {
            let value = |channel: usize| number(numbers[channel.min(numbers.len() - 1)]);
            *pixel = P::of([value(0), value(1), value(2)]);
        }
    }
    Ok(Picture { width, height, radiance })
}

fn side(file: &mut dyn Source) -> Result<u32, ImageFormatError> {
    let (word, _) = word(file)?;
    word.parse().map_err(|_| ImageFormatError::broken(format!("{} is not a number of pixels", quote::bytes(word.as_bytes()))))
}

/// The next word of the header, and the white space after it.
fn word(file: &mut dyn Source) -> Result<(String, u8), ImageFormatError> {
    let mut word = Vec::new();
    loop {
        let mut byte = [0];
        file.read_exact(&mut byte).map_err(|_| ImageFormatError::broken("the file ends within its header"))?;
        match byte[0] {
            space if space.is_ascii_whitespace() && !word.is_empty() => {
                return Ok((String::from_utf8_lossy(&word).into_owned(), space));
            }
            space if space.is_ascii_whitespace() => {}
            _ if word.len() == LONGEST_WORD => return Err(ImageFormatError::broken("its header is not that of a PFM")),
            other => word.push(other),
        }
    }
}
