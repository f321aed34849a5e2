//! Joins files of samples.
use std::path::{Path, PathBuf};

use super::{
    file::{SampleFile, SampleFileError},
    film::SampleFilm,
    ranges::SampleRanges,
    sums::{TileSums, TooManySamples},
};
use crate::{
    render::area::Area,
    render_file::{Counters, Header},
};
use noisefall_base::{
    memory::{Reservation, TooMuch},
    quote,
};

/// Why files cannot be joined.
#[derive(Debug, thiserror::Error)]
pub enum JoinError {
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] SampleFileError),
    /// A file is of another image.
    #[error("{} cannot be joined with {}: {difference}", quote::path(path), quote::path(first))]
    Foreign {
        /// The file.
        path: PathBuf,
        /// The first file.
        first: PathBuf,
        /// Description of the difference.
        difference: String,
    },
    /// Two files have the same samples.
    #[error("{} and {} both have the samples {samples}: leave one out", quote::path(path), quote::path(other))]
    Overlap {
        /// The file.
        path: PathBuf,
        /// The other file.
        other: PathBuf,
        /// The samples that both have.
        samples: SampleRanges,
    },
    /// The sums would overflow.
    #[error("{}: {error}", quote::path(path))]
    TooManySamples {
        /// The file.
        path: PathBuf,
        /// The limit.
        error: TooManySamples,
    },
    /// There is too little memory.
    #[error(transparent)]
    TooMuch(#[from] TooMuch),
}

/// The sums of all files so far. They take the memory of one film, however many files there are.
pub struct Join {
    header: Header,
    samples: SampleRanges,
    tiles: Vec<TileSums>,
    /// The files, and what each has.
    sources: Vec<(PathBuf, SampleRanges)>,
    _memory: Reservation,
}

impl Join {
    /// Begins with the image of a file, which is not added yet.
    pub fn begin(file: &SampleFile) -> Result<Join, JoinError> {
        let resolution = file.header().camera.resolution;
        let memory = SampleFilm::reserve(resolution)?;
        let header = Header { counters: Counters::default(), samples: Vec::new(), ..file.header().clone() };
        let tiles = Area::tiles(resolution).map(TileSums::new).collect();
        Ok(Join { header, samples: SampleRanges::default(), tiles, sources: Vec::new(), _memory: memory })
    }

    /// Enters a file before it is added, if it belongs to the image and has samples that are not there yet.
    pub fn enter(&mut self, file: &SampleFile) -> Result<(), JoinError> {
        let path = || file.path().to_owned();
        if let Some((first, _)) = self.sources.first()
            && let Some(difference) = file.header().difference(&self.header)
        {
            return Err(JoinError::Foreign { path: path(), first: first.clone(), difference });
        }
        let overlaps = self.sources.iter().map(|(other, samples)| (other, file.samples().overlap(samples)));
        if let Some((other, samples)) = { overlaps }.find(|(_, samples)| !samples.is_empty()) {
            return Err(JoinError::Overlap { path: path(), other: other.clone(), samples });
        }
        self.sources.push((path(), file.samples().clone()));
        Ok(())
    }

    /// Adds the sums of a file that was entered. After an error, those so far are useless.
    pub fn add(&mut self, file: SampleFile) -> Result<(), JoinError> {
        let (path, samples, counters) = (file.path().to_owned(), file.samples().clone(), file.header().counters);
        let tiles = &mut self.tiles;
        file.read(|place, sums| {
            tiles[place].merge(&sums).map_err(|error| JoinError::TooManySamples { path: path.clone(), error })
        })?;
        self.samples = self.samples.joined(&samples).unwrap_or_default();
        self.header.samples = self.samples.list().to_vec();
        self.header.counters = sum(&self.header.counters, &counters);
        Ok(())
    }

    /// Returns the files' metadata about their image.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The samples so far.
    pub fn samples(&self) -> &SampleRanges {
        &self.samples
    }

    /// The files, and what each has.
    pub fn sources(&self) -> &[(PathBuf, SampleRanges)] {
        &self.sources
    }

    /// Whether a file has been entered.
    pub fn has(&self, path: &Path) -> bool {
        self.sources.iter().any(|(source, _)| source == path)
    }

    /// The sums of the tiles, row by row from the top left.
    pub fn sums(&self) -> impl Iterator<Item = &TileSums> {
        self.tiles.iter()
    }

    /// Returns the sums of the tiles. Each tile is freed as soon as it is dropped.
    pub fn into_sums(self) -> impl Iterator<Item = TileSums> {
        self.tiles.into_iter()
    }
}

fn sum(a: &Counters, b: &Counters) -> Counters {
    Counters {
        seconds: a.seconds + b.seconds,
        rays: a.rays.saturating_add(b.rays),
        cut_paths: a.cut_paths.saturating_add(b.cut_paths),
        first_invalid: [a.first_invalid, b.first_invalid].into_iter().flatten().min(),
    }
}
