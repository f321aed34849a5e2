//! The film: what a picture's samples add up to.
use super::{region::Region, tile::Tile};
use crate::{
    integrator::{TERMS, TILE},
    memory::{self, Reservation, TooMuch},
};

/// Sums of samples over all pixels, in tiles that each belong to one thread at a time.
pub struct Film {
    pub(super) resolution: [u32; 2],
    pub tiles: Vec<Tile>,
    /// All samples up to the next doubling are there, and it is to be noted before there are more.
    pub(super) is_noting: bool,
    /// Pixels share what their paths find, and so have noise in common.
    pub(super) shares: bool,
    /// It has been found out where noise is.
    pub(super) is_piloted: bool,
    /// Samples go here alone.
    pub(super) focus: Option<Region>,
}

impl Film {
    /// An empty film. Its memory is taken by the first sample, tile by tile on the threads that render.
    pub fn new(resolution: [u32; 2]) -> Film {
        let [width, height] = resolution;
        let corners = |side: u32| (0..side).step_by(TILE as usize);
        let tile = |x: u32, y: u32| Tile::new([x, y], [TILE.min(width - x), TILE.min(height - y)]);
        let tiles = corners(height).flat_map(|y| corners(width).map(move |x| tile(x, y))).collect();
        Film { resolution, tiles, is_noting: false, shares: false, is_piloted: false, focus: None }
    }

    /// Room for a picture of this size: the film, the frames that are made of it, and what saving one of them takes.
    pub fn reserve([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
        /// Of a pixel: sums, squares and means in the film; means and errors in a frame, of which there are two at times; its
        /// codes, and its file.
        const PIXEL: u64 = 60 + 2 * 20 + 4 + 24;
        memory::reserve(format_args!("pictures of {width} × {height} pixels"), PIXEL * u64::from(width) * u64::from(height))
    }

    /// Room for what each number of bounces adds to a picture of this size.
    pub(super) fn reserve_series([width, height]: [u32; 2]) -> Result<Reservation, TooMuch> {
        /// Sums in the film, and means in two frames.
        const PIXEL: u64 = 3 * 12 * TERMS as u64;
        memory::reserve(format_args!("bounces of {width} × {height} pixels"), PIXEL * u64::from(width) * u64::from(height))
    }

    /// An empty film in the memory of this one, if it has the right size.
    pub fn recycled(mut self, resolution: [u32; 2]) -> Film {
        if self.resolution != resolution {
            return Film::new(resolution);
        }
        self.tiles.iter_mut().for_each(Tile::forget);
        (self.is_noting, self.shares, self.is_piloted, self.focus) = (false, false, false, None);
        self
    }

    /// Keeps what each number of bounces adds apart from now on.
    pub(super) fn keep_series(&mut self) {
        self.tiles.iter_mut().for_each(Tile::keep_series);
    }

    pub(super) fn has_series(&self) -> bool {
        self.tiles.first().is_some_and(|tile| tile.series.is_some())
    }

    /// Samples a pixel of the tiles in a region; `None` where it lies outside.
    pub(super) fn spp_in(&self, region: &Region) -> Option<u32> {
        self.tiles.iter().filter(|tile| tile.lies_in(region)).map(|tile| tile.spp).min()
    }

    /// Samples a pixel: of every pixel, or on average at most where they are spread by noise.
    pub fn spp(&self) -> u32 {
        self.tiles.iter().map(|tile| tile.spp).min().unwrap_or(0)
    }

    /// Samples of all pixels together.
    pub fn samples(&self) -> u64 {
        self.tiles.iter().map(Tile::samples).sum()
    }

    /// Whether samples are spread by noise.
    pub fn is_adaptive(&self) -> bool {
        self.tiles.iter().any(Tile::is_adaptive)
    }

    pub fn invalid_samples(&self) -> u64 {
        self.tiles.iter().map(|tile| tile.invalid).sum()
    }

    /// The tiles that samples go to.
    pub(super) fn tiles_in_focus(&mut self) -> impl Iterator<Item = &mut Tile> {
        let focus = self.focus;
        self.tiles.iter_mut().filter(move |tile| focus.is_none_or(|region| tile.lies_in(&region)))
    }

    /// Rows of tiles from top to bottom.
    pub fn tile_rows(&self) -> impl Iterator<Item = &[Tile]> {
        self.tiles.chunks(self.resolution[0].div_ceil(TILE) as usize)
    }
}
