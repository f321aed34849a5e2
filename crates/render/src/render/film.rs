//! The film: the sums of an image's samples.
use rayon::prelude::*;

use super::{area::Area, region::Region, splats::SplatFilm, tile::Tile};
use noisefall_base::memory::{self, Reservation, TooMuch};
use noisefall_kernel::integrator::{TERMS, TILE};
use noisefall_scene::scene::PathReuse;

/// Sums of samples over all pixels, in tiles that each belong to one thread at a time.
pub struct Film {
    pub(super) resolution: [u32; 2],
    /// The tiles, row by row from the top left.
    pub tiles: Vec<Tile>,
    /// Whether all samples up to the next doubling are there, which must be recorded before there are more.
    pub(super) awaits_error_record: bool,
    /// Path reuse between pixels, which correlates their noise.
    pub(super) path_reuse: PathReuse,
    /// Whether a pilot has measured the noise.
    pub(super) is_piloted: bool,
    /// The region that gets all samples.
    pub(super) focus: Option<Region>,
    /// Radiance that light paths add to the pixels, if the estimator traces any.
    pub(super) splats: Option<SplatFilm>,
}

impl Film {
    /// An empty film. The render threads allocate its memory with the first sample, tile by tile.
    pub fn new(resolution: [u32; 2]) -> Film {
        let tiles = Area::tiles(resolution).map(|Area { origin, size }| Tile::new(origin, size)).collect();
        Film {
            resolution,
            tiles,
            awaits_error_record: false,
            path_reuse: PathReuse::Off,
            is_piloted: false,
            focus: None,
            splats: None,
        }
    }

    /// Reserves memory for an image of this size: the film, its frames, and saving one of them.
    pub fn reserve([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
        /// Bytes per pixel: sums, squares, two means and a threshold in the film; means and errors in up to two frames; display codes; and the
        /// file.
        const PIXEL: u64 = 76 + 2 * 20 + 4 + 24;
        memory::reserve(format_args!("images of {width} × {height} pixels"), PIXEL * u64::from(width) * u64::from(height))
    }

    /// Bytes of a film without its frames: sums, squares, means and thresholds.
    pub(super) fn kept_bytes([width, height]: [u32; 2]) -> u64 {
        76 * u64::from(width) * u64::from(height)
    }

    /// Reserves memory for a film without its frames.
    pub(super) fn reserve_kept(resolution: [u32; 2]) -> Result<Reservation, TooMuch> {
        let [width, height] = resolution;
        memory::reserve(format_args!("earlier images of {width} × {height} pixels"), Self::kept_bytes(resolution))
    }

    /// Reserves memory for the series by bounces of an image of this size.
    pub fn reserve_series([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
        /// Bytes per pixel: sums in the film, and means in two frames.
        const PIXEL: u64 = 3 * 12 * TERMS as u64;
        memory::reserve(format_args!("bounces of {width} × {height} pixels"), PIXEL * u64::from(width) * u64::from(height))
    }

    /// An empty film in the memory of this one, if its size is right.
    pub fn recycled(mut self, resolution: [u32; 2]) -> Film {
        if self.resolution != resolution {
            return Film::new(resolution);
        }
        self.tiles.iter_mut().for_each(Tile::forget);
        (self.awaits_error_record, self.path_reuse, self.is_piloted, self.focus, self.splats) =
            (false, PathReuse::Off, false, None, None);
        self
    }

    /// Starts to store the contribution of each number of bounces separately.
    pub(super) fn keep_series(&mut self) {
        self.tiles.iter_mut().for_each(Tile::keep_series);
    }

    pub(super) fn has_series(&self) -> bool {
        self.tiles.first().is_some_and(|tile| tile.series.is_some())
    }

    /// Samples per pixel of the tiles in a region; `None` if it lies outside.
    pub(super) fn spp_in(&self, region: &Region) -> Option<u32> {
        self.tiles.iter().filter(|tile| tile.lies_in(region)).map(|tile| tile.spp).min()
    }

    /// Samples per pixel; with adaptive sampling, an upper bound of the average.
    pub fn spp(&self) -> u32 {
        self.tiles.iter().map(|tile| tile.spp).min().unwrap_or(0)
    }

    /// Total number of samples.
    pub fn samples(&self) -> u64 {
        self.tiles.iter().map(Tile::samples).sum()
    }

    /// Whether sampling is adaptive.
    pub fn is_adaptive(&self) -> bool {
        self.tiles.iter().any(Tile::is_adaptive)
    }

    /// Samples that were dropped because they were negative or not finite.
    pub fn invalid_samples(&self) -> u64 {
        self.tiles.iter().map(|tile| tile.invalid).sum::<u64>() + self.splats.as_ref().map_or(0, SplatFilm::invalid)
    }

    /// Starts to sum the light of light paths.
    pub(super) fn keep_splats(&mut self) {
        let resolution = self.resolution;
        self.splats.get_or_insert_with(|| SplatFilm::new(resolution));
    }

    /// Tells the tiles what light paths have brought to their pixels: one path belongs to every sample of any pixel.
    pub(super) fn spread_splats(&mut self) {
        let paths = self.samples();
        if let Some(splats) = &self.splats {
            let tiles = self.tiles.par_iter_mut().enumerate();
            tiles.for_each(|(place, tile)| tile.splats = splats.estimates(place, paths));
        }
    }

    /// The tiles that get samples.
    pub(super) fn tiles_in_focus(&mut self) -> impl Iterator<Item = &mut Tile> {
        let focus = self.focus;
        self.tiles.iter_mut().filter(move |tile| focus.is_none_or(|region| tile.lies_in(&region)))
    }

    /// Rows of tiles from top to bottom.
    pub fn tile_rows(&self) -> impl Iterator<Item = &[Tile]> {
        self.tiles.chunks(self.resolution[0].div_ceil(TILE) as usize)
    }
}
