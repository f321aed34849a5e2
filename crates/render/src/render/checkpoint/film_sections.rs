//! The exact state of a film as sections of a render file: one of the film, and one of each tile.
use std::io::{Read, Seek};

use rayon::prelude::*;

use crate::{
    render::{
        adaptive::RATES,
        block::Block,
        estimate::Doubling,
        exact_sum::ExactSums,
        film::Film,
        region::Region,
        scatter::{Scatter, VarianceParts},
        splats::{PLANES, SplatFilm, TileSplats},
        tile::Tile,
    },
    render_file::{Encode, Encoded, Fields, Reader, RenderFileError, Tag},
};
use noisefall_scene::scene::PathReuse;

const FILM: Tag = Tag(*b"FILM");
const TILE: Tag = Tag(*b"TILE");
/// Radiance that light paths add to a tile. Absent without such paths.
const SPLATS: Tag = Tag(*b"SPLT");
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
    if let Some(splats) = &film.splats {
        let tiles = (0..film.tiles.len()).into_par_iter();
        sections.extend(tiles.map(|place| encode_splats(splats, place)).collect::<Vec<_>>());
    }
    sections
}

fn encode_film(film: &Film) -> Encoded {
    Encoded::new(FILM, 64, |to| {
        film.resolution.encode(to);
        [u8::from(film.awaits_error_record), film.path_reuse as u8, u8::from(film.is_piloted), u8::from(film.focus.is_some())]
            .encode(to);
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

fn encode_splats(film: &SplatFilm, place: usize) -> Encoded {
    let TileSplats { sums, counts } = film.tile(place);
    Encoded::new(SPLATS, 32 + (17 * PLANES + 4) * counts.len(), |to| {
        (place as u32).encode(to);
        [film.batches(), film.invalid()].encode(to);
        counts.encode(to);
        let (high, low, bins) = sums.parts();
        high.encode(to);
        low.encode(to);
        to.extend(bins);
    })
}

/// Reads the sections of light paths, of which the first is already there.
fn read_splats<R: Read + Seek>(reader: &mut Reader<R>, first: &[u8], film: &mut Film) -> Result<(), RenderFileError> {
    let pixels = |tile: &Tile| (tile.size[0] * tile.size[1]) as usize;
    let (first_tile, counters) = read_tile_splats(first, 0, pixels(&film.tiles[0]))?;
    let mut tiles = vec![first_tile];
    for place in 1..film.tiles.len() {
        match reader.section()? {
            Some((SPLATS, payload)) => tiles.push(read_tile_splats(payload, place as u32, pixels(&film.tiles[place]))?.0),
            _ => return Err(RenderFileError::contents(format!("the light paths to tile {place} are missing"))),
        }
    }
    film.splats = Some(SplatFilm::of_tiles(film.resolution, tiles, counters));
    film.spread_splats();
    Ok(())
}

fn read_tile_splats(payload: &[u8], place: u32, pixels: usize) -> Result<(TileSplats, [u64; 2]), RenderFileError> {
    let mut fields = Fields::of(payload);
    if fields.take::<u32>()? != place {
        return Err(RenderFileError::contents(format!("the light paths to tile {place} are not in their place")));
    }
    let counters = fields.take()?;
    let counts: Vec<u32> = fields.list(pixels)?;
    let (high, low): (Vec<i64>, Vec<i64>) = (fields.list(PLANES * pixels)?, fields.list(PLANES * pixels)?);
    let bins: Vec<u8> = fields.list(PLANES * pixels)?;
    fields.end()?;
    let most = counts.iter().copied().max().unwrap_or(0).into();
    let sums = ExactSums::from_parts(high, low, &bins, most);
    let contradiction = || RenderFileError::contents(format!("the light paths to tile {place} contradict each other"));
    Ok((TileSplats { sums: sums.ok_or_else(contradiction)?, counts }, counters))
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
        Some((SPLATS, payload)) => {
            let first = payload.to_vec();
            read_splats(reader, &first, &mut film)?;
            match reader.section()? {
                None => Ok(film),
                Some((tag, _)) => Err(RenderFileError::contents(format!("the section {tag} is not known"))),
            }
        }
        Some((tag, _)) => Err(RenderFileError::contents(format!("the section {tag} is not known"))),
    }
}

fn read_film(mut fields: Fields, film: &mut Film) -> Result<(), RenderFileError> {
    if fields.take::<[u32; 2]>()? != film.resolution {
        return Err(RenderFileError::contents("the film has another size than the image"));
    }
    let flags = fields.take::<[u8; 4]>()?;
    let [awaits_error_record, _, is_piloted, has_focus] = flags.map(|flag| flag != 0);
    let [from, to] = fields.take::<[[u32; 2]; 2]>()?;
    (film.awaits_error_record, film.path_reuse, film.is_piloted) = (awaits_error_record, path_reuse_of(flags[1])?, is_piloted);
    film.focus = has_focus.then_some(Region { from, to });
    fields.end()
}

fn path_reuse_of(number: u8) -> Result<PathReuse, RenderFileError> {
    let of_number = PathReuse::ALL.into_iter().find(|path_reuse| *path_reuse as u8 == number);
    of_number.ok_or_else(|| RenderFileError::contents("the film has an unknown type of path reuse"))
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
    let parts = VarianceParts::of_numbers(fields.take()?);
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
