//! The exact state of a film as sections of a render file: one of the film, and one of each tile.
use std::io::{Read, Seek};

use rayon::prelude::*;

use crate::{
    render::{
        adaptive::RATES,
        block::Block,
        estimate::Doubling,
        film::Film,
        region::Region,
        scatter::{Parts, Scatter},
        tile::Tile,
    },
    render_file::{Encode, Encoded, Fields, Reader, RenderFileError, Tag},
};

const FILM: Tag = Tag(*b"FILM");
const TILE: Tag = Tag(*b"TILE");
/// Bytes of a tile besides its pixels, at most; and of a pixel.
const BESIDES: usize = 2048;
const PIXEL: usize = 72;
/// Most samples of a pixel: far beyond what a render takes, and far from where counts overflow.
const MOST_SAMPLES: u32 = 1 << 30;

/// Encodes a film on the threads of the pool that this is called on.
pub fn encode(film: &Film) -> Vec<Encoded> {
    let tiles = film.tiles.par_iter().enumerate().map(|(place, tile)| encode_tile(place as u32, tile));
    let mut sections = vec![encode_film(film)];
    sections.extend(tiles.collect::<Vec<_>>());
    sections
}

fn encode_film(film: &Film) -> Encoded {
    Encoded::new(FILM, 64, |to| {
        film.resolution.encode(to);
        [film.is_noting, film.shares, film.is_piloted, film.focus.is_some()].map(u8::from).encode(to);
        let focus = film.focus.unwrap_or(Region { from: [0, 0], to: [0, 0] });
        [focus.from, focus.to].encode(to);
    })
}

fn encode_tile(place: u32, tile: &Tile) -> Encoded {
    // A film in the memory of an earlier one still has its numbers.
    let has_samples = tile.blocks.iter().any(|block| block.spp > 0);
    let pixels = if has_samples { tile.sum.len() } else { 0 };
    Encoded::new(TILE, BESIDES + PIXEL * pixels, |to| {
        [place, tile.spp].encode(to);
        tile.invalid.encode(to);
        tile.whole.numbers().encode(to);
        for block in &tile.blocks {
            [block.spp, block.doubled].encode(to);
            block.rate.encode(to);
            block.doublings.map(|doubling| [doubling.moved, doubling.variance]).encode(to);
            block.parts.numbers().encode(to);
        }
        u8::from(has_samples).encode(to);
        tile.sum[..pixels].encode(to);
        tile.sum_of_squares[..pixels].encode(to);
        tile.before[..pixels].encode(to);
        tile.earlier[..pixels].encode(to);
    })
}

/// Reads the film of an image of this size. Its memory is reserved already.
pub fn read<R: Read + Seek>(reader: &mut Reader<R>, resolution: [u32; 2]) -> Result<Film, RenderFileError> {
    // A film has memory for its samples only once it has some, but its tiles exist from the beginning.
    let pixels = resolution.map(u64::from).iter().product::<u64>();
    if reader.size() < pixels / 16 {
        return Err(RenderFileError::contents("it is too short for the size of its image"));
    }
    let mut film = Film::new(resolution);
    match reader.section()? {
        Some((FILM, payload)) => read_film(Fields::of(payload), &mut film)?,
        _ => return Err(RenderFileError::contents("the section `FILM` is missing")),
    }
    for place in 0..film.tiles.len() {
        match reader.section()? {
            Some((TILE, payload)) => read_tile(Fields::of(payload), place as u32, &mut film.tiles[place])?,
            _ => return Err(RenderFileError::contents(format!("tile {place} is missing"))),
        }
    }
    match reader.section()? {
        None => Ok(film),
        Some((tag, _)) => Err(RenderFileError::contents(format!("the section {tag} is not known"))),
    }
}

fn read_film(mut fields: Fields, film: &mut Film) -> Result<(), RenderFileError> {
    if fields.take::<[u32; 2]>()? != film.resolution {
        return Err(RenderFileError::contents("the film has another size than the image"));
    }
    let [is_noting, shares, is_piloted, has_focus] = fields.take::<[u8; 4]>()?.map(|flag| flag != 0);
    let [from, to] = fields.take::<[[u32; 2]; 2]>()?;
    (film.is_noting, film.shares, film.is_piloted) = (is_noting, shares, is_piloted);
    film.focus = has_focus.then_some(Region { from, to });
    fields.end()
}

fn read_tile(mut fields: Fields, place: u32, tile: &mut Tile) -> Result<(), RenderFileError> {
    if fields.take::<u32>()? != place {
        return Err(RenderFileError::contents(format!("tile {place} is not in its place")));
    }
    tile.spp = fields.take()?;
    tile.invalid = fields.take()?;
    tile.whole = Scatter::of_numbers(fields.take()?);
    for block in &mut tile.blocks {
        *block = read_block(&mut fields)?;
    }
    if fields.take::<u8>()? != 0 {
        let pixels = (tile.size[0] * tile.size[1]) as usize;
        tile.sum = fields.list(pixels)?;
        tile.sum_of_squares = fields.list(pixels)?;
        tile.before = fields.list(pixels)?;
        tile.earlier = fields.list(pixels)?;
    }
    fields.end()?;
    check(tile, place)
}

fn read_block(fields: &mut Fields) -> Result<Block, RenderFileError> {
    let [spp, doubled] = fields.take::<[u32; 2]>()?;
    let rate = fields.take::<i8>()?;
    let doublings = fields.take::<[[f64; 2]; 3]>()?.map(|[moved, variance]| Doubling { moved, variance });
    let parts = Parts::of_numbers(fields.take()?);
    Ok(Block { spp, doubled, rate, doublings, parts })
}

/// Checks what the renderer relies on, because a checksum can be right by intent.
fn check(tile: &Tile, place: u32) -> Result<(), RenderFileError> {
    let is_sound = |block: &Block| {
        let doubles = block.doubled == 0 || block.doubled.is_power_of_two();
        let most = block.doubled.saturating_mul(2).max(1);
        doubles && (block.doubled..=most.min(MOST_SAMPLES)).contains(&block.spp) && is_rate(block.rate)
    };
    let has_samples = tile.blocks.iter().any(|block| block.spp > 0);
    let agrees = match tile.is_adaptive() {
        true => tile.spp <= MOST_SAMPLES && tile.distance_to(tile.spp) == 0,
        false => tile.blocks.iter().all(|block| block.spp == tile.spp),
    };
    let is_radiance = |sums: &[[f64; 3]]| sums.iter().flatten().all(|x| *x >= 0.0 && x.is_finite());
    let are_means = |means: &[[f32; 3]]| means.iter().flatten().all(|x| *x >= 0.0 && x.is_finite());
    let is_whole = tile.blocks.iter().all(is_sound)
        && agrees
        && has_samples != tile.sum.is_empty()
        && is_radiance(&tile.sum)
        && is_radiance(&tile.sum_of_squares)
        && are_means(&tile.before)
        && are_means(&tile.earlier);
    if is_whole { Ok(()) } else { Err(RenderFileError::contents(format!("the numbers of tile {place} contradict each other"))) }
}

fn is_rate(rate: i8) -> bool {
    (RATES[0]..=RATES[1]).contains(&i32::from(rate))
}
