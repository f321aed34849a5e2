//! Radiance HDR: three mantissas of 8 bits with a common exponent, run-length encoded.
//!
//! G. Ward, "Real Pixels", Graphics Gems II, 1991, and the Radiance file format notes ("Image File Format"). Mantissas are used
//! without the half step that Radiance itself adds: black is then 0, and other readers agree.
//!
//! The `image` crate reads this format too, but it does not apply the exposure and has no limit for the length of a header line.
use std::io::{BufRead, Read};

use super::{ImageFormatError, Picture, Pixel, Source, check_size, check_unpacked, length, pixels, room};

/// Maximum length of a header line.
const LONGEST_LINE: u64 = 4096;
/// Widths with run-length encoded channels.
const PACKED_WIDTHS: std::ops::RangeInclusive<usize> = 8..=0x7fff;

type Rgbe = [u8; 4];

pub(super) fn decode<P: Pixel>(file: &mut dyn Source) -> Result<Picture<P>, ImageFormatError> {
    let length = length(file)?;
    let exposure = exposure(file)?;
    let layout = Layout::read(&text_line(file)?)?;
    let [width, height] = layout.size();
    check_size(width.into(), height.into())?;
    check_unpacked(width.into(), height.into(), length)?;
    // A line has a pixel or more, and old runs are of any length.
    if 4 * u64::from(layout.lines) > length {
        return Err(ImageFormatError::broken("the file ends within its pixels"));
    }
    let _room = room::<P>(width, height, 0)?;
    let count = width as usize * height as usize;
    let mut radiance = pixels(count)?;
    radiance.resize(count, P::default());
    let mut line = vec![[0; 4]; layout.length as usize];
    for number in 0..layout.lines {
        read_line(file, &mut line)?;
        for (at, rgbe) in (0..).zip(&line) {
            radiance[layout.pixel(number, at)] = P::of(linear(*rgbe, exposure));
        }
    }
    Ok(Picture { width, height, radiance })
}

/// How lines of pixels lie in the image.
struct Layout {
    lines: u32,
    /// Pixels of a line.
    length: u32,
    /// Whether lines are columns.
    are_columns: bool,
    /// Whether lines run from the end of their axis, and their pixels.
    is_reversed: [bool; 2],
}

impl Layout {
    /// Reads a line like `-Y 512 +X 1024`: lines from the top, pixels from the left. The first axis is that from line to line. Y points
    /// upwards, and X to the right.
    fn read(line: &str) -> Result<Layout, ImageFormatError> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let layout = || {
            let [first, lines, second, length] = words[..] else { return None };
            let axes = [first, second].map(str::as_bytes);
            let is_reversed = match axes {
                [[y @ (b'+' | b'-'), b'Y'], [x @ (b'+' | b'-'), b'X']] => [*y == b'+', *x == b'-'],
                [[x @ (b'+' | b'-'), b'X'], [y @ (b'+' | b'-'), b'Y']] => [*x == b'-', *y == b'+'],
                _ => return None,
            };
            let are_columns = axes[0][1] == b'X';
            Some(Layout { lines: lines.parse().ok()?, length: length.parse().ok()?, are_columns, is_reversed })
        };
        layout().ok_or_else(|| ImageFormatError::broken(format!("its size is `{line}`, not such as `-Y height +X width`")))
    }

    /// Width and height.
    fn size(&self) -> [u32; 2] {
        if self.are_columns { [self.lines, self.length] } else { [self.length, self.lines] }
    }

    /// Index of a pixel of a line.
    fn pixel(&self, line: u32, at: u32) -> usize {
        let [line, at] = [(line, self.lines, self.is_reversed[0]), (at, self.length, self.is_reversed[1])]
            .map(|(number, count, is_reversed)| if is_reversed { count - 1 - number } else { number } as usize);
        if self.are_columns { at * self.lines as usize + line } else { line * self.length as usize + at }
    }
}

/// Reads the header up to its empty line, and returns the factor by which the values were multiplied.
fn exposure(file: &mut dyn Source) -> Result<f64, ImageFormatError> {
    let mut exposure = 1.0;
    loop {
        let line = text_line(file)?;
        if line.is_empty() {
            return Ok(exposure);
        }
        if let Some(format) = line.strip_prefix("FORMAT=")
            && format.trim() != "32-bit_rle_rgbe"
        {
            return Err(ImageFormatError::broken(format!("its pixels are `{format}`, not 32-bit_rle_rgbe")));
        }
        if let Some(factor) = line.strip_prefix("EXPOSURE=") {
            let factor = factor.trim().parse().ok().filter(|factor| f64::is_normal(*factor) && *factor > 0.0);
            exposure *= factor.ok_or_else(|| ImageFormatError::broken(format!("`{line}` is not a factor")))?;
        }
    }
}

fn text_line(file: &mut dyn Source) -> Result<String, ImageFormatError> {
    let mut line = Vec::new();
    file.take(LONGEST_LINE).read_until(b'\n', &mut line)?;
    if line.pop() != Some(b'\n') {
        return Err(ImageFormatError::broken("the file ends within its header"));
    }
    Ok(String::from_utf8_lossy(&line).trim_end().to_owned())
}

fn bytes<const N: usize>(file: &mut dyn Source) -> Result<[u8; N], ImageFormatError> {
    let mut bytes = [0; N];
    read(file, &mut bytes)?;
    Ok(bytes)
}

fn read(file: &mut dyn Source, bytes: &mut [u8]) -> Result<(), ImageFormatError> {
    file.read_exact(bytes).map_err(|_| ImageFormatError::broken("the file ends within its pixels"))
}

fn read_line(file: &mut dyn Source, row: &mut [Rgbe]) -> Result<(), ImageFormatError> {
    let first: Rgbe = bytes(file)?;
    match first {
        [2, 2, high, low] if high < 128 && PACKED_WIDTHS.contains(&row.len()) => {
            if usize::from(u16::from_be_bytes([high, low])) != row.len() {
                return Err(ImageFormatError::broken("a row has another width than the image"));
            }
            (0..4).try_for_each(|channel| read_channel(file, row, channel))
        }
        _ => read_pixels(file, first, row),
    }
}

/// Reads one run-length encoded channel of a row: a byte above 128 repeats the next byte; any other is the number of literal
/// bytes that follow.
fn read_channel(file: &mut dyn Source, row: &mut [Rgbe], channel: usize) -> Result<(), ImageFormatError> {
    let mut done = 0;
    while done < row.len() {
        let [count] = bytes(file)?;
        let (length, repeated) = if count > 128 { (count - 128, Some(bytes::<1>(file)?)) } else { (count, None) };
        let run = row.get_mut(done..done + usize::from(length)).filter(|run| !run.is_empty());
        let run = run.ok_or_else(|| ImageFormatError::broken("a run leaves its row"))?;
        let mut values = [0; 128];
        match repeated {
            Some([value]) => values.fill(value),
            None => read(file, &mut values[..run.len()])?,
        }
        run.iter_mut().zip(values).for_each(|(pixel, value)| pixel[channel] = value);
        done += usize::from(length);
    }
    Ok(())
}

/// Reads a row pixel by pixel; `first` has been read already. Mantissas 1, 1, 1 repeat the previous pixel; the exponent is the
/// count. Consecutive repetitions are the digits of one count in base 256.
fn read_pixels(file: &mut dyn Source, first: Rgbe, row: &mut [Rgbe]) -> Result<(), ImageFormatError> {
    let (mut done, mut digit, mut next) = (0usize, 0, first);
    loop {
        if let [1, 1, 1, count] = next {
            let last = done.checked_sub(1).map(|last| row[last]);
            let length = usize::from(count) << (8 * digit).min(24);
            let run = row.get_mut(done..done + length);
            let (Some(last), Some(run)) = (last, run) else { return Err(ImageFormatError::broken("a run leaves its row")) };
            run.fill(last);
            done += length;
            digit += 1;
        } else {
            row[done] = next;
            done += 1;
            digit = 0;
        }
        if done == row.len() {
            return Ok(());
        }
        next = bytes(file)?;
    }
}

/// m · 2^(e − 136), divided by the exposure; e = 0 is black.
fn linear([r, g, b, e]: Rgbe, exposure: f64) -> [f32; 3] {
    let scale = if e == 0 { 0.0 } else { f64::powi(2.0, i32::from(e) - 136) / exposure };
    [r, g, b].map(|m| (f64::from(m) * scale) as f32)
}
