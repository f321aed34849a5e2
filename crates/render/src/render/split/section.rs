//! The sums of a tile as a section of a render file. All numbers are little-endian.
//!
//! | bytes | contents |
//! |---|---|
//! | 4 | number of the tile, row by row from the top left |
//! | 8 | samples that were invalid |
//! | 4 each | samples of each block of 8 × 8 pixels |
//! | 17 each | exact sums of the pixels: red, green, blue, and their squares, each row by row |
//! | 17 each | exact sums of the blocks: (r + g + b)², over samples and pixels |
//! | 17 each | exact sums of the sample's sum over pixels and channels, and of its square |
//! | 4 each | of light paths, if there are any, the number of values in the sums of each pixel |
//! | 17 each | exact sums of what they bring to each pixel: red, green, blue, and their squares |
//!
//! A list of sums is the multiples of the units of their bins, those of the bins below, and the bins: 8, 8 and 1 bytes each.
use super::sums::{PLANES, TileSums};
use crate::{
    render::{
        area::Area,
        exact_sum::{ExactSums, MOST_VALUES},
        splats::{PLANES as SPLAT_PLANES, TileSplats},
    },
    render_file::{Encode, Encoded, Fields, RenderFileError, Tag},
};

pub const TAG: Tag = Tag(*b"SUMS");

pub fn encode(place: u32, sums: &TileSums) -> Encoded {
    let of_splats = sums.splats.as_ref().map_or(0, |splats| (17 * PLANES + 4) * splats.counts.len());
    let bytes = of_splats + 17 * (PLANES * sums.area.pixels() + sums.area.blocks() + 2) + 4 * sums.area.blocks() + 12;
    Encoded::new(TAG, bytes, |to| {
        place.encode(to);
        sums.invalid.encode(to);
        sums.counts.encode(to);
        [&sums.pixels, &sums.blocks, &sums.whole].into_iter().for_each(|list| encode_list(list, to));
        if let Some(TileSplats { sums, counts }) = &sums.splats {
            counts.encode(to);
            encode_list(sums, to);
        }
    })
}

fn encode_list(list: &ExactSums, to: &mut Vec<u8>) {
    let (high, low, bins) = list.parts();
    high.encode(to);
    low.encode(to);
    to.extend(bins);
}

pub fn decode(payload: &[u8], place: u32, area: Area) -> Result<TileSums, RenderFileError> {
    let mut fields = Fields::of(payload);
    if fields.take::<u32>()? != place {
        return Err(RenderFileError::contents(format!("tile {place} is not in its place")));
    }
    let invalid = fields.take()?;
    let counts: Vec<u32> = fields.list(area.blocks())?;
    if counts.iter().any(|count| *count > MOST_VALUES) {
        return Err(RenderFileError::contents(format!("tile {place} has too many samples")));
    }
    let most = counts.iter().copied().max().unwrap_or(0).into();
    let mut list = |count: usize| decode_list(&mut fields, count, most, place);
    let (pixels, blocks, whole) = (list(PLANES * area.pixels())?, list(area.blocks())?, list(2)?);
    let mut sums = TileSums { area, pixels, blocks, whole, counts, invalid, splats: None };
    if !fields.is_empty() {
        let counts: Vec<u32> = fields.list(area.pixels())?;
        let most = counts.iter().copied().max().unwrap_or(0).into();
        let splats = decode_list(&mut fields, SPLAT_PLANES * area.pixels(), most, place)?;
        sums.splats = Some(TileSplats { sums: splats, counts });
    }
    fields.end().map(|()| sums)
}

/// Sums of at most `most` values.
fn decode_list(fields: &mut Fields, count: usize, most: u64, place: u32) -> Result<ExactSums, RenderFileError> {
    let (high, low): (Vec<i64>, Vec<i64>) = (fields.list(count)?, fields.list(count)?);
    let bins: Vec<u8> = fields.list(count)?;
    let sums = ExactSums::from_parts(high, low, &bins, most);
    sums.ok_or_else(|| RenderFileError::contents(format!("the numbers of tile {place} contradict each other")))
}
