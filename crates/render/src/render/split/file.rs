//! Files of samples: render files of the kind `samples`.
use std::{
    fs::File,
    io::BufReader,
    path::{Path, PathBuf},
};

use super::{ranges::SampleRanges, section, sums::TileSums};
use crate::{
    render::{adaptive::RATES, area::Area, block::goal, exact_sum::MOST_VALUES},
    render_file::{Header, Kind, Reader, RenderFileError, Writer},
};
use noisefall_base::{
    file::{self, WriteError, open_regular},
    quote,
};

/// Error of reading a file of samples.
#[derive(Debug, thiserror::Error)]
#[error("{}: {error}", quote::path(path))]
pub struct SampleFileError {
    path: PathBuf,
    error: RenderFileError,
}

/// A file of samples, read tile by tile.
pub struct SampleFile {
    path: PathBuf,
    reader: Reader<BufReader<File>>,
    samples: SampleRanges,
}

/// Writes the sums of the tiles of an image.
pub fn write<'t>(path: &Path, header: &Header, tiles: impl Iterator<Item = &'t TileSums>) -> Result<(), WriteError> {
    file::replace_by(path, |to| {
        let mut writer = Writer::new(to, header)?;
        for (place, sums) in (0..).zip(tiles) {
            writer.section(&section::encode(place, sums))?;
        }
        writer.finish().map(drop)
    })
}

impl SampleFile {
    /// Opens a file, and checks its header.
    pub fn open(path: &Path) -> Result<SampleFile, SampleFileError> {
        let unreadable = |error| SampleFileError { path: path.to_owned(), error };
        let file = open_regular(path).map_err(|error| unreadable(error.into()))?;
        let reader = Reader::new(BufReader::new(file)).map_err(unreadable)?;
        let samples = samples(reader.header()).map_err(unreadable)?;
        Ok(SampleFile { path: path.to_owned(), reader, samples })
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the file's metadata about its image.
    pub fn header(&self) -> &Header {
        self.reader.header()
    }

    /// The samples that it has.
    pub fn samples(&self) -> &SampleRanges {
        &self.samples
    }

    /// Gives the sums of each tile to `take`, row by row from the top left.
    pub fn read<E: From<SampleFileError>>(mut self, mut take: impl FnMut(usize, TileSums) -> Result<(), E>) -> Result<(), E> {
        let unreadable = |error| SampleFileError { path: self.path.clone(), error };
        let counts = possible_counts(&self.samples, self.reader.header().settings.adaptive);
        let reader = &mut self.reader;
        for (place, area) in Area::tiles(reader.header().camera.resolution).enumerate() {
            let sums = match reader.section().map_err(unreadable)? {
                Some((section::TAG, payload)) => section::decode(payload, place as u32, area).map_err(unreadable)?,
                _ => return Err(unreadable(RenderFileError::contents(format!("tile {place} is missing"))).into()),
            };
            if let Some(count) = sums.counts.iter().find(|count| !counts.contains(&u64::from(**count))) {
                let claim =
                    format!("tile {place} has {count} samples of a pixel, and its header says the samples {}", self.samples);
                return Err(unreadable(RenderFileError::contents(claim)).into());
            }
            take(place, sums)?;
        }
        match reader.section().map_err(unreadable)? {
            None => Ok(()),
            Some((tag, _)) => Err(unreadable(RenderFileError::contents(format!("the section {tag} is not known"))).into()),
        }
    }
}

/// The numbers of samples that a block has with these samples of the average: adaptive sampling gives it one of several rates.
fn possible_counts(samples: &SampleRanges, is_adaptive: bool) -> Vec<u64> {
    let rates = if is_adaptive { RATES[0]..=RATES[1] } else { 0..=0 };
    let at =
        |rate: i32| samples.list().iter().map(|[start, end]| u64::from(goal(rate as i8, *end) - goal(rate as i8, *start))).sum();
    rates.map(at).collect()
}

/// The samples of a file with this header, if it can be used.
fn samples(header: &Header) -> Result<SampleRanges, RenderFileError> {
    if header.kind != Kind::Samples || header.image.is_none() {
        return Err(RenderFileError::contents("it holds a render to be continued (--resume), not samples to be joined"));
    }
    let camera = header.camera.check();
    camera.map_err(|error| RenderFileError::contents(format!("its camera cannot be used: {error}")))?;
    let samples = SampleRanges::of(&header.samples).filter(|samples| !samples.is_empty());
    let samples = samples.ok_or_else(|| RenderFileError::contents("its ranges of samples are invalid"))?;
    match samples.total() {
        0..=MOST_VALUES => Ok(samples),
        total => {
            Err(RenderFileError::contents(format!("it says that it has {total} samples of a pixel; {MOST_VALUES} are the most")))
        }
    }
}
